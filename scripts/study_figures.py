"""Rules study_figures and panel_figures: charts over all designs of the study."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.figures.charts import draw_axes_comparison, draw_comparison, save_figure
from foldshell.figures.planarity_chart import draw_planarity_chart
from foldshell.figures.study_data import add_fields, read_states
from foldshell.results.comparisons import COMPARISONS
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.stage import Plain, read_stage

OTHERS = {"axes": draw_axes_comparison, "planarity_utilization": draw_planarity_chart}
CHARTS = (*COMPARISONS, *OTHERS)


def main(
    summary_path: str | Path,
    results: str | Path,
    charts: Mapping[str, Sequence[str | Path]],
    *,
    settings: Plain,
) -> None:
    """Write the named charts (of `CHARTS`; PNG or SVG by suffix).

    `results` has one folder per design; `settings` are the plain parameters of stage `size`.
    """
    given = read_stage(settings, *ANALYSED)
    states = read_states(summary_path, results, given.combinations)
    designs = [add_fields(design, state) for design, state in states]
    for name, paths in charts.items():
        if name in COMPARISONS:
            limit = given.sizing.displacement_limit_span_over
            figure = draw_comparison(designs, COMPARISONS[name], limit)
        else:
            figure = OTHERS[name](designs)
        save_figure(figure, paths)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.summary,  # noqa: F821
            results=snakemake.params.results,  # noqa: F821
            charts=dict(snakemake.output.items()),  # noqa: F821
            settings=snakemake.params.settings,  # noqa: F821
        )
