"""Rule all_designs: small multiples of all designs of the study, a page a field."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from foldshell.engine.job import run_job
from foldshell.figures.contact_sheet import draw_sheets, make_tile
from foldshell.figures.layout import save_png
from foldshell.figures.study_data import read_states
from foldshell.results.design_view import read_limits, view_design


def main(
    summary_path: str | Path,
    results: str | Path,
    sheets: Mapping[str, str | Path],
    *,
    settings: Mapping[str, Any],
) -> None:
    """Write the pages `all_thickness` and `all_utilization`.

    `results` has one folder per design; `settings` are the plain parameters of stage `size`.
    """
    tiles = [
        make_tile(view_design(state, settings, design.number["span_m"], design.pattern))
        for design, state in read_states(summary_path, results, settings["combinations"])
    ]
    for name, page in draw_sheets(tiles, read_limits(settings).utilization_max).items():
        save_png(sheets[f"all_{name}"], page)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.summary,  # noqa: F821
            snakemake.params.results,  # noqa: F821
            dict(snakemake.output.items()),  # noqa: F821
            settings=snakemake.params.settings,  # noqa: F821
        )
