"""Rule all_designs: small multiples of all designs of the study, one page per field."""

from collections.abc import Mapping
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.figures.contact_sheet import draw_sheet, make_tile, pack_sheets, render_sheets
from foldshell.figures.layout import save_png
from foldshell.figures.study_data import read_states
from foldshell.files.whole import write_json
from foldshell.results.design_view import view_design
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.stage import Plain, read_stage


def main(
    summary_path: str | Path,
    results: str | Path,
    pages: Mapping[str, str | Path],
    tiles_path: str | Path,
    *,
    settings: Plain,
) -> None:
    """Write the pages `all_thickness` and `all_utilization`, and their views for the report.

    `results` has one folder per design; `settings` are the plain parameters of stage `size`.
    """
    given = read_stage(settings, *ANALYSED)
    tiles = [
        make_tile(view_design(state, given, design.number["span_m"], design.pattern))
        for design, state in read_states(summary_path, results, given.combinations)
    ]
    sheets = render_sheets(tiles, given.sizing.utilization_max)
    for name, sheet in sheets.items():
        save_png(pages[f"all_{name}"], draw_sheet(tiles, sheet))
    write_json(tiles_path, pack_sheets(sheets))


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        files = dict(snakemake.output.items())  # noqa: F821
        tiles_json = files.pop("tiles")
        main(
            snakemake.input.summary,  # noqa: F821
            snakemake.params.results,  # noqa: F821
            files,
            tiles_json,
            settings=snakemake.params.settings,  # noqa: F821
        )
