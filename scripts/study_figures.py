"""Rule study_figures: charts over all designs of the study, and all designs on one page."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from foldshell.figures.charts import draw_axes_comparison, draw_comparison, save_figure
from foldshell.figures.contact_sheet import draw_sheets, make_tile
from foldshell.figures.drafts import read_limits, subject_of_design
from foldshell.figures.layout import save_png
from foldshell.figures.planarity_chart import draw_planarity_chart
from foldshell.figures.state import read_state
from foldshell.figures.study_data import COMPARISONS, add_fields, read_summary
from foldshell.study.errors import user_errors

CHARTS = (*COMPARISONS, "axes", "planarity_utilization")
FILES = ("shell/mesh.npz", "folded/folded.npz", "sizing/final.npz", "sizing/final.json")


def main(
    summary_path: str | Path,
    results: str | Path,
    charts: Mapping[str, Sequence[str | Path]],
    sheets: Mapping[str, str | Path],
    *,
    settings: Mapping[str, Any],
) -> None:
    """Write the charts (`CHARTS`; PNG or SVG by suffix) and the two sheets.

    `results` has a folder a design; `settings` are the plain parameters of stage `size`.
    """
    limits = read_limits(settings)
    designs, tiles = [], []
    for design in read_summary(summary_path):
        paths = [Path(results, design.name, file) for file in FILES]
        state = read_state(design.name, *paths, settings["combinations"])
        designs.append(add_fields(design, state))
        span = design.number["span_m"]
        tiles.append(make_tile(subject_of_design(state, settings, span, design.pattern)))
    for name, comparison in COMPARISONS.items():
        figure = draw_comparison(designs, comparison, limits.displacement_limit_span_over)
        save_figure(figure, charts[name])
    save_figure(draw_axes_comparison(designs), charts["axes"])
    save_figure(draw_planarity_chart(designs), charts["planarity_utilization"])
    for name, page in draw_sheets(tiles, limits.utilization_max).items():
        save_png(sheets[name], page)


if "snakemake" in globals():
    with user_errors():
        main(
            snakemake.input.summary,  # noqa: F821
            results=snakemake.params.results,  # noqa: F821
            charts={name: snakemake.output[name] for name in CHARTS},  # noqa: F821
            sheets={name: snakemake.output[f"all_{name}"] for name in ("thickness", "utilization")},  # noqa: F821
            settings=snakemake.params.settings,  # noqa: F821
        )
