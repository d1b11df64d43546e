"""Rule analyse: second-order shell analysis of one workbook of thicknesses, and the verdict."""

import sys
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.engine.progress import describe_iteration
from foldshell.files.edits import describe_reading, keep_edited
from foldshell.files.whole import read_arrays, read_json, write_arrays, write_timed_json
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.stage import Plain, read_stage
from foldshell.sizing.case import open_case
from foldshell.sizing.iteration import IterationTask
from foldshell.workbook.panels import make_panel_grid
from foldshell.workbook.read_thickness import read_thickness


def main(
    mesh_path: str | Path,
    workbook_path: str | Path,
    json_path: str | Path,
    arrays_path: str | Path,
    *,
    design: str,
    iteration: int,
    span_m: float,
    zigzag: int,
    strip: int,
    settings: Plain,
    settings_hash: str,
    previous: tuple[str, str] | None = None,
) -> None:
    """Write analysis.npz, then analysis.json; `previous` names those of the iteration before."""
    given = read_stage(settings, *ANALYSED)
    keep_edited(workbook_path)
    bounds = given.sizing.least_thickness, given.sizing.largest_thickness
    thickness = read_thickness(workbook_path, make_panel_grid(zigzag, strip), *bounds)
    before = (read_json(previous[0]), read_arrays(previous[1])) if previous else ({}, {})
    task = IterationTask(iteration, span_m, thickness, *before)
    report, fields = open_case(mesh_path, given).run(task)
    decided = before[0].get("settings_hash", settings_hash)
    report |= describe_reading(workbook_path, thickness, decided)
    write_arrays(arrays_path, fields)
    write_timed_json(json_path, report)
    # One write a line, so that lines of parallel jobs do not mix.
    sys.stderr.write(describe_iteration(design, report) + "\n")


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.mesh,  # noqa: F821
            snakemake.input.workbook,  # noqa: F821
            snakemake.output.json,  # noqa: F821
            snakemake.output.arrays,  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            iteration=int(snakemake.wildcards.iteration),  # noqa: F821
            previous=tuple(snakemake.input.get("previous", ())) or None,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
