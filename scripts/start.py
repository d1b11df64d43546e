"""Rule start: the workbook of thicknesses that the first analysis reads."""

from pathlib import Path

import numpy as np

from foldshell.engine.job import run_job
from foldshell.files.edits import recorded_workbook
from foldshell.workbook.panels import ThicknessTable, make_panel_grid
from foldshell.workbook.write_thickness import write_thickness


def main(
    workbook_path: str | Path,
    record_path: str | Path,
    *,
    design: str,
    zigzag: int,
    strip: int,
    start_thickness: float,
    least_thickness: float,
    largest_thickness: float,
    settings_hash: str,
) -> None:
    """Write sizing/00/thickness.xlsx with one thickness (m) for all panels."""
    grid = make_panel_grid(zigzag, strip)
    table = ThicknessTable(grid, np.full(len(grid.panel), start_thickness))
    summary = {
        "design": design,
        "iteration": 0,
        "verdict": "not analysed yet",
        "least_thickness_m": least_thickness,
        "largest_thickness_m": largest_thickness,
        "settings_hash": settings_hash,
    }
    with recorded_workbook(workbook_path, record_path) as temporary:
        write_thickness(temporary, table, summary, least_thickness, largest_thickness)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.output.workbook,  # noqa: F821
            snakemake.output.record,  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
