"""Rule crosscheck_opensees: a third opinion on some designs by OpenSees, where it is installed."""

import csv
from collections.abc import Sequence
from pathlib import Path

from crosscheck.errors import CrosscheckError, report_errors
from crosscheck.model import read_model
from crosscheck.opensees import list_opensees_values, list_rows, open_opensees
from crosscheck.primary import read_primary, read_reason
from crosscheck.reading import write_whole
from crosscheck.values import build_independent

ORDER = 2.0
"""Order in 1/n at which flat triangles settle."""


def main(
    model_paths: Sequence[str | Path],
    primary_paths: Sequence[str | Path],
    csv_path: str | Path,
    *,
    subdivisions: Sequence[int] = (4, 8),
) -> None:
    """Write one row per design, combination and quantity: both limits."""
    open_opensees()
    if not model_paths:
        raise CrosscheckError("designs: tags: no design has the tag 'supports' to be checked")
    rows = []
    for model_path, primary_path in zip(model_paths, primary_paths, strict=True):
        model = read_model(model_path)
        reason = read_reason(primary_path)
        if reason is not None:
            raise CrosscheckError(
                f"{model.design}: nothing to compare, its supports do not hold it ({reason}): "
                "allowed are designs with finite displacements"
            )
        primary = read_primary(primary_path, model.compared_combinations)
        runs = [list_opensees_values(model, n) for n in subdivisions]
        opensees = build_independent(subdivisions, runs, ORDER)
        rows += list_rows(model.design, primary, opensees, subdivisions)
    with write_whole(csv_path) as temporary, temporary.open("w", newline="") as stream:
        writer = csv.DictWriter(stream, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


if "snakemake" in globals():
    from foldshell.engine.job import run_job  # only notes what was read and written

    with report_errors(), run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.models,  # noqa: F821
            snakemake.input.primaries,  # noqa: F821
            snakemake.output.table,  # noqa: F821
        )
