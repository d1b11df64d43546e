"""Rule start: the workbook of thicknesses that the first analysis reads."""

from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.records.edits import recorded_workbook
from foldshell.settings.sizing import Sizing
from foldshell.settings.stage import Plain, read_stage
from foldshell.sizing.start import start_thicknesses
from foldshell.workbook.panels import Paths, ThicknessTable, choose_panels, mirror_panels
from foldshell.workbook.thickness_summary import summarise_start
from foldshell.workbook.write_thickness import write_thickness


def main(
    workbook_path: str | Path,
    record_path: str | Path,
    *,
    design: str,
    zigzag: int,
    strip: int,
    folded: Paths = (),
    settings: Plain,
    settings_hash: str,
) -> None:
    """Write sizing/00/thickness.xlsx with one thickness (m) for all panels."""
    sizing = read_stage(settings, Sizing).sizing
    least, largest = sizing.least_thickness, sizing.largest_thickness
    grid = choose_panels(zigzag, strip, folded)
    limits = mirror_panels(grid, sizing.symmetry)
    begin = start_thicknesses(len(grid.panel), sizing, limits)
    table = ThicknessTable(grid, begin, limits=limits)
    summary = summarise_start(design, least, largest, settings_hash)
    with recorded_workbook(workbook_path, record_path, begin, limits) as temporary:
        write_thickness(temporary, table, summary, least, largest)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.output.workbook,  # noqa: F821
            snakemake.output.record,  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            folded=snakemake.input.get("folded", ()),  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
