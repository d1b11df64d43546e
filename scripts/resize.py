"""Rule resize: the workbook of the next iteration from the analysis of this one."""

from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.files.edits import recorded_workbook
from foldshell.files.whole import read_arrays, read_json, write_arrays
from foldshell.settings.sizing import Sizing
from foldshell.settings.stage import Plain, read_stage
from foldshell.sizing.step import summarise_step, take_step
from foldshell.workbook.panels import ThicknessTable, make_panel_grid
from foldshell.workbook.write_thickness import write_thickness

LIMITS = ("least_thickness", "largest_thickness", "utilization_max")


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
    settings: Plain,
    previous_memory: str | Path | None = None,
) -> None:
    """Write thickness.xlsx, memory.npz and written.json of the iteration after `json_path`."""
    sizing = read_stage(settings, Sizing).sizing
    analysis, arrays = read_json(json_path), read_arrays(arrays_path)
    thickness, used = arrays["thickness"], arrays.get(f"utilization_{sizing.measure}")
    memory = read_arrays(previous_memory) if previous_memory else {}
    following = take_step(analysis, arrays, memory, sizing)
    new = following.thickness
    table = ThicknessTable(
        make_panel_grid(zigzag, strip), new, thickness, used, new / thickness - 1, following.note
    )
    summary = summarise_step(design, analysis, sizing)
    write_arrays(memory_path, following.memory)
    with recorded_workbook(workbook_path, record_path, new) as temporary:
        write_thickness(temporary, table, summary, *(getattr(sizing, name) for name in LIMITS))


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            *snakemake.input.analysis,  # noqa: F821
            snakemake.output.workbook,  # noqa: F821
            snakemake.output.memory,  # noqa: F821
            snakemake.output.record,  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            previous_memory=next(iter(snakemake.input.get("memory", ())), None),  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
