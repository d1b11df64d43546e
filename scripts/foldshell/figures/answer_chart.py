"""Concrete against buckling factor of explorations, one chart each."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.explore.answer import Searched
from foldshell.files.whole import atomic_path

COLOURS = {"found": "#0072B2", "table": "#333333", "smooth": "#A8447F"}
WORDS = {"found": "found", "table": "designs of the table", "smooth": "smooth shell"}
MARKS = {"found": "o", "table": "s", "smooth": "^"}


def draw_answer(path: str | Path, searched: Sequence[Searched]) -> None:
    """Draw the found designs with their front, the table's and the smooth shell (PNG)."""
    from matplotlib.figure import Figure

    columns = min(len(searched), 3)
    rows = -(-len(searched) // columns)
    figure = Figure(figsize=(4.2 * columns, 3.4 * rows), layout="constrained", dpi=120)
    for number, one in enumerate(searched, start=1):
        axes = figure.add_subplot(rows, columns, number)
        for kind, colour in COLOURS.items():
            points = one.of(kind)
            axes.scatter([p.volume for p in points], [p.factor for p in points], s=26, c=colour,
                         marker=MARKS[kind], label=WORDS[kind], zorder=3)  # fmt: skip
        front = one.front
        axes.step([p.volume for p in front], [p.factor for p in front], where="post",
                  color="#B35C00", label="front of the found")  # fmt: skip
        axes.set_title(one.name, fontsize=11)
        axes.set_xlabel("concrete [m³]")
        axes.set_ylabel("least buckling factor")
        axes.grid(color="#dddddd")
    figure.axes[0].legend(fontsize=8)
    with atomic_path(path) as temporary:
        figure.savefig(temporary, format="png", metadata={"Software": None})
