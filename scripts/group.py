"""Rule group: the sized panels in a few thickness classes, and the analysis of that design."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.files.errors import InputError
from foldshell.files.whole import read_arrays, read_json, write_arrays, write_timed_json
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.stage import Plain, read_stage
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
    settings: Plain,
) -> None:
    """Write classes.npz, then classes.json, from the last of the analyses."""
    last = Path(analysis_paths[-1])
    try:
        report, arrays = read_json(last), read_arrays(last.with_suffix(".npz"))
    except (OSError, ValueError):
        raise InputError(
            f"{last}: cannot be read: delete this file and start again, it is computed anew"
        ) from None
    given = read_stage(settings, *ANALYSED)
    case = open_case(mesh_path, given)
    found, fields = analyse_classes(case, span_m, report, arrays, classes)
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
