"""Concrete against buckling factor and against panels, one chart for each exploration."""

from collections.abc import Callable, Sequence
from pathlib import Path

from foldshell.explore.answer import Searched, find_front
from foldshell.files.whole import atomic_path
from foldshell.records.rivals import FOUND, SMOOTH, TABLE

COLOURS = {FOUND: "#0072B2", TABLE: "#333333", SMOOTH: "#A8447F"}
WORDS = {FOUND: "found", TABLE: "rows of the table", SMOOTH: "smooth shell"}
MARKS = {FOUND: "o", TABLE: "s", SMOOTH: "^"}
FRONT = "#B35C00"
RESIZED = {FOUND: "best of the found", TABLE: "base in the table", SMOOTH: "smooth shell"}


def draw_factors(path: str | Path, searched: Sequence[Searched]) -> None:
    """Draw concrete against buckling factor (PNG): found designs with their front, the table's,
    and the best and the smooth shell sized for several factors."""
    _draw(path, searched, _draw_factors, "least buckling factor")


def draw_panels(path: str | Path, searched: Sequence[Searched]) -> None:
    """Draw concrete against panels (PNG), the smooth shell as a line: its panels are any number."""
    _draw(path, searched, _draw_panels, "panels")


def _draw(
    path: str | Path, searched: Sequence[Searched], fill: Callable[..., None], across: str
) -> None:
    from matplotlib.figure import Figure

    columns = min(len(searched), 3)
    rows = -(-len(searched) // columns)
    size = (4.2 * columns, 3.4 * rows + 0.5)
    figure = Figure(figsize=size, layout="constrained", dpi=120)
    for number, one in enumerate(searched, start=1):
        axes = figure.add_subplot(rows, columns, number)
        fill(axes, one)
        axes.set_title(one.title, fontsize=11)
        axes.set_xlabel(across)
        axes.set_ylabel("concrete [m³]")
        axes.set_ylim(bottom=0)
        axes.set_xlim(left=0)
        axes.grid(color="#dddddd")
    handles: dict[str, object] = {}
    for axes in figure.axes:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            handles.setdefault(label, handle)
    figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=columns,
                  fontsize=9)  # fmt: skip
    with atomic_path(path) as temporary:
        figure.savefig(temporary, format="png", metadata={"Software": None})


def _scatter(axes, one: Searched, kinds: Sequence[str], across: Callable) -> None:
    for kind in kinds:
        points = one.of(kind)
        axes.scatter([across(p) for p in points], [p.volume for p in points], s=20,
                     c=COLOURS[kind], marker=MARKS[kind], label=WORDS[kind], zorder=3)  # fmt: skip


def _draw_factors(axes, one: Searched) -> None:
    _scatter(axes, one, (FOUND, TABLE), lambda point: point.factor)
    front = find_front(one.of(FOUND), lambda point: point.factor)
    axes.plot([p.factor for p in front], [p.volume for p in front], color=FRONT, lw=1.2,
              label="front of the found")  # fmt: skip
    for kind, style in ((FOUND, "--"), (TABLE, ":"), (SMOOTH, "-")):
        rows = [row for row in one.resized_as(kind) if row.buckling_factor_min is not None]
        if not rows:
            continue
        label = RESIZED[kind]
        axes.plot([row.buckling_factor_min for row in rows], [row.volume_m3 for row in rows], style,
                  color=COLOURS[kind], marker=MARKS[kind], mfc="white", ms=6,
                  label=f"{label}, sized for given factors", zorder=4)  # fmt: skip


def _draw_panels(axes, one: Searched) -> None:
    _scatter(axes, one, (FOUND, TABLE), lambda point: point.panels)
    front = find_front(one.of(FOUND), lambda point: -point.panels)
    axes.plot([p.panels for p in front], [p.volume for p in front], color=FRONT, lw=1.2,
              label="front of the found")  # fmt: skip
    smooth = one.resized_as(SMOOTH)
    if smooth:
        axes.axhline(smooth[0].volume_m3, color=COLOURS[SMOOTH], lw=1.2,
                     label="smooth shell, any number of panels")  # fmt: skip
