"""Rule resize: the workbook of the next iteration from the analysis of this one."""

from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.files.errors import InputError
from foldshell.records.analysis_arrays import StepMemory
from foldshell.records.arrays import read_typed_arrays, write_typed_arrays
from foldshell.records.edits import recorded_workbook
from foldshell.records.iteration import read_iteration
from foldshell.settings.sizing import Sizing
from foldshell.settings.stage import Plain, read_stage
from foldshell.sizing.step import take_step
from foldshell.workbook.panels import Paths, ThicknessTable, choose_panels
from foldshell.workbook.thickness_summary import summarise_step
from foldshell.workbook.write_thickness import write_thickness


def main(
    json_path: str | Path,
    arrays_path: str | Path,
    workbook_path: str | Path,
    memory_path: str | Path,
    record_path: str | Path,
    *,
    design: str,
    zigzag: int,
    strip: int,
    folded: Paths = (),
    settings: Plain,
    previous_memory: str | Path | None = None,
) -> None:
    """Write thickness.xlsx, memory.npz and written.json of the iteration after `json_path`."""
    sizing = read_stage(settings, Sizing).sizing
    analysis, arrays = read_iteration(json_path, arrays_path)
    if not analysis.goes_on:
        raise InputError(f"{json_path}: verdict {analysis.verdict}: no step follows, start again")
    memory = read_typed_arrays(previous_memory, StepMemory) if previous_memory else None
    following = take_step(analysis, arrays, memory, sizing)
    new, old = following.thickness, arrays.thickness
    grid, used = choose_panels(zigzag, strip, folded), arrays.utilization(sizing.measure)
    table = ThicknessTable(grid, new, old, used, new / old - 1, following.note, following.limits)
    write_typed_arrays(memory_path, following.memory)
    summary = summarise_step(design, analysis, sizing)
    with recorded_workbook(workbook_path, record_path, new, following.limits) as temporary:
        write_thickness(temporary, table, summary, *sizing.bounds, sizing.utilization_max)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            *snakemake.input.analysis,  # noqa: F821
            snakemake.output.workbook,  # noqa: F821
            snakemake.output.memory,  # noqa: F821
            snakemake.output.record,  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            folded=snakemake.input.get("folded", ()),  # noqa: F821
            previous_memory=next(iter(snakemake.input.get("memory", ())), None),  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
