"""Rule group: the sized panels in a few thickness classes, and the analysis of that design."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.records.analysis import read_analysis
from foldshell.records.iteration import read_iteration, write_classes
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.stage import Plain, read_stage
from foldshell.sizing.case import open_case
from foldshell.sizing.delivery import choose_delivered
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
    """Write classes.npz, then classes.json, from the one of the analyses that is delivered."""
    number = choose_delivered([read_analysis(path) for path in analysis_paths])
    state, given = read_iteration(analysis_paths[number]), read_stage(settings, *ANALYSED)
    found = analyse_classes(open_case(mesh_path, given), span_m, *state, classes)
    write_classes(json_path, arrays_path, *found)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.mesh,  # noqa: F821
            snakemake.input.analyses,  # noqa: F821
            snakemake.output.json,  # noqa: F821
            snakemake.output.arrays,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
