"""Rule analyse: second-order shell analysis of one workbook of thicknesses, and the verdict."""

from dataclasses import replace
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.engine.progress import describe_iteration, print_line
from foldshell.records.edits import describe_reading, find_edited_panels, keep_edited
from foldshell.records.iteration import read_iteration, write_iteration
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.stage import Plain, read_stage
from foldshell.sizing.case import open_case
from foldshell.sizing.iteration import IterationTask
from foldshell.workbook.panels import Paths, choose_panels
from foldshell.workbook.read_thickness import read_panel_input


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
    folded: Paths = (),
    settings: Plain,
    settings_hash: str,
    previous: tuple[str, str] | None = None,
) -> None:
    """Write analysis.npz, then analysis.json; `previous` names those of the iteration before."""
    given = read_stage(settings, *ANALYSED)
    keep_edited(workbook_path)
    read = read_panel_input(workbook_path, choose_panels(zigzag, strip, folded), given.sizing)
    before = read_iteration(*previous) if previous else (None, None)
    edited = find_edited_panels(workbook_path, read.thickness, read.limits)
    task = IterationTask(iteration, span_m, read.thickness, *before, edited, read.limits)
    record, arrays = open_case(mesh_path, given).run_in_loop(task)
    decided = getattr(before[0], "settings_hash", settings_hash)
    own = describe_reading(workbook_path, read.thickness, decided, read.limits)
    record = replace(record, **own)
    write_iteration(json_path, arrays_path, record, arrays)
    print_line(describe_iteration(design, record))


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.mesh,  # noqa: F821
            snakemake.input.workbook,  # noqa: F821
            *snakemake.output,  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            folded=snakemake.input.get("folded", ()),  # noqa: F821
            iteration=int(snakemake.wildcards.iteration),  # noqa: F821
            previous=tuple(snakemake.input.get("previous", ())) or None,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
