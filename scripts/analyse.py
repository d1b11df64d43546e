"""Rule analyse: second-order shell analysis of one workbook of thicknesses, and the verdict."""

import sys
from dataclasses import replace
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.engine.progress import describe_iteration
from foldshell.records.edits import describe_reading, find_edited_panels, keep_edited
from foldshell.records.iteration import read_iteration, write_iteration
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
    before = read_iteration(*previous) if previous else (None, None)
    edited = find_edited_panels(workbook_path, thickness)
    task = IterationTask(iteration, span_m, thickness, *before, edited)
    record, arrays = open_case(mesh_path, given).run(task)
    decided = before[0].settings_hash if before[0] else settings_hash
    record = replace(record, **describe_reading(workbook_path, thickness, decided))
    write_iteration(json_path, arrays_path, record, arrays)
    sys.stderr.write(describe_iteration(design, record) + "\n")  # lines of jobs do not mix


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
