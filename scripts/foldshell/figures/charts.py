"""Charts over several designs with matplotlib (Figs 6 and 8 of Tsiamis et al. 2018)."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from foldshell.figures.layout import TITLE_SIZE
from foldshell.figures.study_data import UTILIZATION_BIN, UTILIZATION_END, StudyDesign
from foldshell.files.whole import atomic_path
from foldshell.results.comparisons import Comparison, pair_supports, sort_into_columns

COLOURS = ("#0072B2", "#E69F00", "#009E73", "#CC79A7", "#000000")
STYLES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)))
HATCHES = ("", "///", "...", "xxx", "\\\\")
DISPLACEMENT_LIMIT = 240.0
DISPLACEMENT, VOLUME = "displacement_vertical_max_m", "volume_per_area_m"
LIMIT_COLOUR = "#BE0028"
RESOLUTION = 160
"""Dots per inch of the PNG files."""
TITLE_POINTS = 72 * TITLE_SIZE / RESOLUTION
"""Size of titles: as many pixels as those of the pictures of a design."""
BAR_LABEL_SHARE = 0.2
WHITE_BOX = {"facecolor": "white", "edgecolor": "none", "boxstyle": "square,pad=0.15"}
STYLE = {
    "font.size": 12,
    "font.family": "DejaVu Sans",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "hatch.linewidth": 0.6,
    "svg.hashsalt": "foldshell",
    "figure.dpi": RESOLUTION,
}


def draw_comparison(
    designs: Sequence[StudyDesign],
    comparison: Comparison,
    limit_span_over: float = DISPLACEMENT_LIMIT,
) -> Figure:
    """Return histogram of utilization, displacement and volume per area; one column per group."""
    columns = sort_into_columns(designs, comparison)
    with plt.rc_context(STYLE):
        if not columns:
            return draw_words(f"{comparison.title}: no design of this comparison in the study")
        designs = [design for members in columns.values() for design in members.values()]
        largest = {key: 1e3 * np.nanmax([d.number[key] for d in designs] + [0.0])
                   for key in (DISPLACEMENT, VOLUME)}  # fmt: skip
        series = list(dict.fromkeys(name for members in columns.values() for name in members))
        figure, axes = plt.subplots(
            3, len(columns), figsize=(10, 9.5), squeeze=False, sharey="row", layout="constrained"
        )
        for column, (name, members) in zip(axes.T, columns.items(), strict=True):
            column[0].set_title(name, fontsize=13)
            draw_histogram(column[0], members, series)
            draw_bars(column[1], DISPLACEMENT, members, series, largest[DISPLACEMENT])
            draw_limits(column[1], members, limit_span_over)
            draw_bars(column[2], VOLUME, members, series, largest[VOLUME])
        axes[0, 0].set_ylim(bottom=0)
        axes[0, 0].set_ylabel(f"share of area\n[% per {UTILIZATION_BIN:g}]")
        axes[1, 0].set_ylabel("vertical displacement,\ndown [mm]")
        axes[2, 0].set_ylabel("volume per mesh area\n[mm = L/m²]")
        handles, labels = _legend(axes.ravel())
        title = describe_states(designs)
        figure.legend(handles, labels, loc="outside lower center", ncols=min(len(labels), 6),
                      frameon=False, title=title)  # fmt: skip
        figure.suptitle(comparison.title, fontsize=TITLE_POINTS, fontweight="bold")
        return figure


def describe_states(designs: Iterable[StudyDesign]) -> str | None:
    """Return what the star on bars stands for, None where all designs converged."""
    states = sorted({design.state.replace("_", " ") for design in designs} - {"converged"})
    return f"* {' or '.join(states)}" if states else None


def draw_histogram(axes: Axes, members: Mapping[str, StudyDesign], series: Sequence[str]) -> None:
    """Draw the share of area in each bin of utilization as steps; 1 is marked."""
    edges = np.arange(round(UTILIZATION_END / UTILIZATION_BIN) + 2) * UTILIZATION_BIN
    for name, design in members.items():
        k = series.index(name)
        if design.share is not None:
            axes.stairs(100 * design.share, edges, color=COLOURS[k % 5], linestyle=STYLES[k % 5],
                        linewidth=2.0, label=name)  # fmt: skip
    axes.axvline(1.0, color=LIMIT_COLOUR, linewidth=1.5, label="limit: utilization 1")
    ticks = np.arange(0, UTILIZATION_END + 0.25, 0.5)
    axes.set_xticks(ticks, [f"{t:g}" if t < UTILIZATION_END else f"≥{t:g}" for t in ticks])
    axes.set_xlim(0, edges[-1])
    axes.set_xlabel("utilization [-]")


def draw_limits(axes: Axes, members: Mapping[str, StudyDesign], span_over: float) -> None:
    """Draw the limit of the displacement over the bar of each design."""
    for place, design in enumerate(members.values()):
        limit = 1e3 * design.number["span_m"] / span_over
        axes.plot([place - 0.45, place + 0.45], [limit, limit], color=LIMIT_COLOUR, linewidth=1.5,
                  linestyle="--", label=f"limit: span / {span_over:g}")  # fmt: skip


def draw_bars(
    axes: Axes,
    key: str,
    members: Mapping[str, StudyDesign],
    series: Sequence[str],
    largest: float,
) -> None:
    """Draw one bar per design, its value in mm, or its state where there is no value.

    A star marks designs whose loop did not converge. `largest` is the largest value of all
    columns: low bars have their value above them.
    """
    values = {name: 1e3 * design.number[key] for name, design in members.items()}
    for place, (name, value) in enumerate(values.items()):
        k = series.index(name) % 5
        if np.isfinite(value):
            light = COLOURS[k] + "B0"
            axes.bar(place, value, 0.8, color=light, edgecolor="black", hatch=HATCHES[k])
            mark = "" if members[name].state == "converged" else "*"
            inside = value > BAR_LABEL_SHARE * largest
            axes.annotate(f"{value:.3g}{mark}", (place, value / 2 if inside else value),
                          (0, 0 if inside else 3), textcoords="offset points", fontsize=11,
                          ha="center", va="center" if inside else "bottom",
                          bbox=WHITE_BOX if inside else None)  # fmt: skip
        else:
            axes.text(place, 0, f" {members[name].state.replace('_', ' ')}", rotation=90,
                      ha="center", va="bottom", fontsize=11)  # fmt: skip
    turned = max(len(name) for name in series) * len(series) > 24
    axes.set_xticks(range(len(values)), values, rotation=30 if turned else 0,
                    ha="right" if turned else "center", rotation_mode="anchor")  # fmt: skip
    axes.set_xlim(-0.6, len(series) - 0.4)
    axes.margins(y=0.12)


def draw_axes_comparison(designs: Sequence[StudyDesign]) -> Figure:
    """Return strong against weak axis (Fig. 8): zig-zag edges held against strip edges held."""
    pairs = pair_supports(designs)
    with plt.rc_context(STYLE):
        if not pairs:
            return draw_words("Strong and weak axis: no pair of designs to compare in the study")
        height = 2.2 + 0.36 * len(pairs)
        figure, axes = plt.subplots(1, 2, figsize=(10, height), sharey=True, layout="constrained")
        quantities = (
            (DISPLACEMENT, "vertical displacement, down [mm]"),
            (VOLUME, "volume per mesh area [mm = L/m²]"),
        )
        for one, (key, words) in zip(axes, quantities, strict=True):
            draw_dumbbells(one, pairs, key)
            one.set_xlabel(words)
            one.set_xlim(0, 1.08 * one.get_xlim()[1])
            one.margins(y=0.12)
        names = [f"{a.surface} {a.span_height} {a.density}" for a, _ in pairs]
        axes[0].set_yticks(range(len(pairs)), names)
        axes[0].invert_yaxis()
        handles, labels = _legend(axes)
        figure.legend(handles, labels, loc="outside lower center", ncols=2, frameon=False)
        figure.suptitle("Strong and weak axis", fontsize=TITLE_POINTS, fontweight="bold")
        return figure


def draw_dumbbells(axes: Axes, pairs: Sequence[tuple[StudyDesign, StudyDesign]], key: str) -> None:
    """Draw each pair's two values (mm) on one line; a missing one is left out."""
    rows = np.arange(len(pairs))
    values = 1e3 * np.array([[a.number[key], b.number[key]] for a, b in pairs])
    axes.hlines(rows, values.min(axis=1), values.max(axis=1), color="0.6", linewidth=2)
    axes.plot(values[:, 0], rows, "o", color=COLOURS[0], markersize=9,
              label="zig-zag edges supported")  # fmt: skip
    axes.plot(values[:, 1], rows, "D", color=COLOURS[1], markersize=8, markeredgecolor="black",
              label="strip edges supported")  # fmt: skip
    axes.grid(axis="x", color="0.85")
    axes.set_axisbelow(True)


def draw_words(words: str) -> Figure:
    """Return a figure that says why it shows nothing."""
    figure = plt.figure(figsize=(10, 2))
    figure.text(0.5, 0.5, words, ha="center", va="center")
    return figure


def save_figure(figure: Figure, paths: Sequence[str | Path]) -> None:
    """Write a figure to PNG or SVG files, by their suffix, without dates in them; close it."""
    with plt.rc_context(STYLE):
        for path in paths:
            kind = Path(path).suffix[1:]
            metadata = {"Date": None} if kind == "svg" else {"Software": None}
            with atomic_path(path) as temporary:
                figure.savefig(temporary, format=kind, metadata=metadata, dpi=RESOLUTION)
            figure.set_layout_engine("none")  # as found for the first file
    plt.close(figure)


def _legend(axes: Sequence[Axes]) -> tuple[list, list[str]]:
    """Return handles and labels of all axes, each label once, limits last."""
    found: dict[str, object] = {}
    for one in axes:
        for handle, label in zip(*one.get_legend_handles_labels(), strict=True):
            found.setdefault(label, handle)
    for label in [name for name in found if name.startswith("limit")]:
        found[label] = found.pop(label)
    return list(found.values()), list(found)
