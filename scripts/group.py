"""Rule group: the sized panels in a few thickness classes, and the analysis of that design."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from foldshell.engine.job import run_job
from foldshell.files.errors import InputError
from foldshell.files.whole import read_arrays, read_json, write_arrays, write_timed_json
from foldshell.sizing.case import open_case
from foldshell.sizing.grouping import analyse_classes


def main(
    mesh_path: str | Path,
    analysis_paths: Sequence[str | Path],
    json_path: str | Path,
    arrays_path: str | Path,
    *,
    span_m: float,
    classes: int,
    settings: Mapping[str, Any],
) -> None:
    """Write classes.npz, then classes.json, from the last of the analyses."""
    last = Path(analysis_paths[-1])
    try:
        report, arrays = read_json(last), read_arrays(last.with_suffix(".npz"))
    except (OSError, ValueError):
        raise InputError(
            f"{last}: cannot be read: delete this file and start again, it is computed anew"
        ) from None
    found, fields = analyse_classes(open_case(mesh_path, settings), span_m, report, arrays, classes)
    write_arrays(arrays_path, fields)
    write_timed_json(json_path, found)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.mesh,  # noqa: F821
            snakemake.input.analyses,  # noqa: F821
            snakemake.output.json,  # noqa: F821
            snakemake.output.arrays,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
