"""Planarity of panels against their utilization, over all folded designs."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from foldshell.figures.charts import LIMIT_COLOUR, STYLE, TITLE_POINTS, draw_words
from foldshell.figures.study_data import StudyDesign
from foldshell.results.comparisons import UNFOLDED, choose_panel_surfaces
from foldshell.results.correlation import rank_correlation

BINS = 10
"""Groups of equally many panels whose median is drawn."""


def draw_planarity_chart(designs: Sequence[StudyDesign]) -> Figure:
    """Return counts of panels over planarity and mean utilization; one column per surface.

    The paper left open whether the two are related. Above each column stand the rank correlation
    of all its panels, and the median of the correlations within single designs, which differences
    between designs do not disturb.
    """
    groups = {}
    for surface in choose_panel_surfaces(designs):
        panels = [d.panels for d in designs
                  if d.surface == surface and d.pattern not in UNFOLDED
                  and d.panels is not None]  # fmt: skip
        if panels:
            groups[surface] = panels
    with plt.rc_context(STYLE):
        if not groups:
            return draw_words("Planarity and utilization: no folded design with a utilization")
        figure, axes = plt.subplots(
            1, len(groups), figsize=(10, 5.2), squeeze=False, sharey=True, layout="constrained"
        )
        for one, (surface, panels) in zip(axes[0], groups.items(), strict=True):
            shown = draw_panels(one, np.concatenate(panels, axis=1))
            one.set_title(f"{surface}\n{describe_correlation(panels)}", fontsize=12)
        axes[0, 0].set_ylabel("mean utilization of the panel [-]")
        figure.colorbar(shown, ax=axes, label="panels", pad=0.01)
        handles, labels = axes[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", frameon=False)
        figure.suptitle("Planarity and utilization", fontsize=TITLE_POINTS, fontweight="bold")
        return figure


def draw_panels(axes: Axes, panels: np.ndarray):
    """Draw counts in hexagons and the medians of groups of equally many panels, (2, P)."""
    planarity, utilization = 100 * panels[0], panels[1]
    shown = axes.hexbin(planarity, utilization, gridsize=28, bins="log", mincnt=1,
                        cmap="cividis_r", linewidths=0.1)  # fmt: skip
    axes.plot(*group_medians(planarity, utilization), "o-", color=LIMIT_COLOUR, linewidth=2.5,
              markeredgecolor="white", label=f"medians of {BINS} groups")  # fmt: skip
    axes.set_xlabel("distance of diagonals /\ntheir mean length [%]")
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    return shown


def group_medians(first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the medians of both, (G,) each, in groups of equally many by rising `first`.

    first and second (N,) in any unit.
    """
    order = np.argsort(first, kind="stable")
    groups = [group for group in np.array_split(order, BINS) if len(group)]
    return (
        np.array([np.median(first[group]) for group in groups]),
        np.array([np.median(second[group]) for group in groups]),
    )


def describe_correlation(panels: Sequence[np.ndarray]) -> str:
    """Return the rank correlation of all panels, and the median over designs, as words.

    `panels` has (2, P) per design: planarity and utilization, both without unit.
    """
    pooled = rank_correlation(*np.concatenate(panels, axis=1))
    within = [value for one in panels if np.isfinite(value := rank_correlation(*one))]
    median = f"{np.median(within):+.2f}" if within else "none"
    return f"rank correlation {pooled:+.2f};\nwithin designs {median}"
