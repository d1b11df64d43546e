"""Draw docs/images/map.svg and the table of rooms in docs/map.md from the tree as it is.

`PYTHONPATH=tests python docs/draw_map.py`, after a room or a rule has come or gone. A test fails
while picture or table are not those of the tree.
"""

import ast
from dataclasses import dataclass
from html import escape
from pathlib import Path

from rooms import LEAVES, LIBRARY, ROOMS

ROOT = Path(__file__).parents[1]
PICTURE, PAGE = ROOT / "docs/images/map.svg", ROOT / "docs/map.md"
START, END = "<!-- rooms: made by docs/draw_map.py -->", "<!-- end of rooms -->"
WIDTH = 1180
INK, SOFT, LINE = "#111827", "#4b5563", "#9ca3af"
BLUE, GREEN, SAND, ROSE = "#dbeafe", "#dcfce7", "#fef3c7", "#fce7f3"


@dataclass(frozen=True)
class Step:
    """A rule of the run: its name is that of its script; what it writes; which room it uses."""

    rule: str
    writes: str
    room: str


RUN = (
    Step("pattern", "crease_pattern.fold", "pattern"),
    Step("fold", "folded.npz, quality.json", "folding"),
    Step("mesh", "mesh.npz", "shell"),
    Step("start", "00/thickness.xlsx", "workbook"),
    Step("analyse", "NN/analysis.json", "shell, checks"),
    Step("resize", "NN+1/thickness.xlsx", "sizing"),
    Step("size", "final.json", "results"),
)
AFTER = (
    Step("group", "classes.json", "sizing"),
    Step("mesh_convergence", "mesh_convergence.json", "results"),
    Step("check", "engineering.json, .xlsx", "checks"),
    Step("neutral_model", "model.json", "exchange"),
    Step("compare", "comparison.json", "scripts/crosscheck/"),
    Step("draw", "figures/*.png, .vtu", "figures"),
    Step("page", "page.html", "report"),
    Step("export", "exports/*", "exchange"),
)
STUDY = (
    Step("summary", "summary.csv, .xlsx", "results"),
    Step("study_figures", "figures/*.png", "figures"),
    Step("claims", "claims.json, .md", "claims"),
    Step("report", "report.html", "report"),
    Step("archive", "archive/*.zip", "archive"),
)


def list_rooms() -> list[tuple[str, str]]:
    """Return name and first sentence of each room, from the floor up."""
    rooms = []
    for name in ROOMS:
        start = LIBRARY / name / "__init__.py"
        if start.exists():
            text = ast.get_docstring(ast.parse(start.read_text(encoding="utf-8"))) or ""
            rooms.append((name, text.split("\n\n")[0].replace("\n", " ")))
    return rooms


def write_table(rooms: list[tuple[str, str]]) -> str:
    """Return the table of rooms, the floor first, as Markdown."""
    rows = [f"| [`{name}/`](../scripts/foldshell/{name}) | {text} |" for name, text in rooms]
    return "\n".join([START, "| room | what it holds |", "|---|---|", *rows, END])


def draw_map(rooms: list[tuple[str, str]]) -> str:
    """Return the picture as SVG: a run from left to right, the rooms with the floor below."""
    lower, bottom = _draw_rooms(rooms)
    size = f'viewBox="0 0 {WIDTH} {bottom}" width="{WIDTH}" height="{bottom}"'
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} '
        'font-family="Segoe UI, DejaVu Sans, Arial, sans-serif">',
        "<title>Map of the code: rules of a run, rooms of the library</title>",
        '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" '
        f'markerHeight="7" orient="auto"><path d="M0 0L8 4L0 8z" fill="{SOFT}"/></marker></defs>',
        f'<rect width="{WIDTH}" height="{bottom}" fill="white"/>',
        *_draw_run(),
        *lower,
        "</svg>",
    ]
    return "\n".join(parts) + "\n"


def _draw_run() -> list[str]:
    parts = [
        _text(
            24,
            34,
            "A run: each box is a rule and its script, with what it writes and the room it uses",
            19,
            INK,
            True,
        )
    ]
    parts += [_text(24, 58, "config/config.yaml + config/designs.tsv, then for each design:", 14)]
    parts += _draw_row(RUN, 76, BLUE)
    loop = 24 + 4 * 162 + 73, 24 + 5 * 162 + 73
    parts += [
        f'<path d="M{loop[1]} 142 v16 H{loop[0]} v-14" fill="none" stroke="{SOFT}" '
        'marker-end="url(#tip)"/>',
        _text(loop[0] + 8, 175, "until Table 3 is met, one workbook per iteration", 13),
        _text(24, 204, "from the final state:", 14),
    ]
    parts += _draw_row(AFTER, 214, GREEN, arrows=False)
    parts += [_text(24, 306, "over all designs:", 14)]
    return parts + _draw_row(STUDY, 316, SAND, arrows=False)


def _draw_row(steps: tuple[Step, ...], top: int, colour: str, arrows: bool = True) -> list[str]:
    parts = []
    for number, step in enumerate(steps):
        left = 24 + number * 162
        parts += [
            _box(left, top, 146, 66, colour),
            _text(left + 8, top + 22, step.rule, 15 if len(step.rule) < 15 else 12.5, INK, True),
            _text(left + 8, top + 40, step.writes, 10.5),
            _text(left + 8, top + 56, step.room, 10.5),
        ]
        if arrows and number:
            parts.append(
                f'<path d="M{left - 16} {top + 33} h14" stroke="{SOFT}" marker-end="url(#tip)"/>'
            )
    return parts


def _draw_rooms(rooms: list[tuple[str, str]]) -> tuple[list[str], int]:
    """The rooms, and where they end."""
    title = "The library, scripts/foldshell/: a room imports only rooms below it"
    parts = [_text(24, 432, title, 19, INK, True)]
    leaves = [room for room in rooms if room[0] in LEAVES]
    stack = [room for room in rooms if room[0] not in LEAVES | {"engine"}][::-1]
    top, width = 450, 880 / max(len(leaves), 1)
    for number, (name, _) in enumerate(leaves):
        left = 24 + number * width
        parts += [
            _box(left, top, width - (number < len(leaves) - 1) * 6, 40, GREEN),
            _text(left + 10, top + 25, name, 14, INK, True),
        ]
    parts.append(_text(894, top + 25, "none imports another", 12, anchor="end"))
    for level, (name, text) in enumerate(stack):
        row = top + 46 + level * 30
        parts += [
            _box(24, row, 880, 28, BLUE),
            _text(34, row + 19, name, 14, INK, True),
            _text(132, row + 19, text, 12.5),
        ]
    bottom = top + 44 + 30 * len(stack)
    parts += _draw_side(top, bottom, "scripts/crosscheck/", SAND, CROSSCHECK, 0.0, 0.42)
    parts += _draw_side(top, bottom, "engine", ROSE, ENGINE, 0.5)
    return parts, bottom + 24


ENGINE = (
    "what knows Snakemake:", "jobs, forks, records,", "progress, timings;", "no room imports it;",
    "private names stand in", "rules/engine.smk alone",
)  # fmt: skip
CROSSCHECK = (
    "the independent code:", "own elements, loads,", "solver; imports nothing", "of the library",
)  # fmt: skip


def _draw_side(
    top: float, bottom: float, name: str, colour: str, words: tuple[str, ...],
    start: float, end: float = 1.0,
) -> list[str]:  # fmt: skip
    upper, lower = top + start * (bottom - top), top + end * (bottom - top)
    parts = [_box(924, upper, 232, lower - upper, colour)]
    parts += [_text(938, upper + 24, name, 14, INK, True)]
    return parts + [_text(938, upper + 46 + 18 * k, line, 12.5) for k, line in enumerate(words)]


def _box(left: float, top: float, width: float, height: float, colour: str) -> str:
    return (
        f'<rect x="{left:g}" y="{top:g}" width="{width:g}" height="{height:g}" rx="5" '
        f'fill="{colour}" stroke="{LINE}"/>'
    )


def _text(
    x: float, y: float, words: str, size: float, colour: str = SOFT, bold: bool = False,
    anchor: str = "start",
) -> str:  # fmt: skip
    weight = ' font-weight="600"' if bold else ""
    return (
        f'<text x="{x:g}" y="{y:g}" font-size="{size:g}" fill="{colour}"{weight} '
        f'text-anchor="{anchor}">{escape(words, quote=False)}</text>'
    )


def main() -> None:
    """Write the picture, and the table into the page."""
    rooms = list_rooms()
    PICTURE.write_text(draw_map(rooms), encoding="utf-8")
    page = PAGE.read_text(encoding="utf-8")
    before, after = page.split(START)[0], page.split(END)[1]
    PAGE.write_text(before + write_table(rooms) + after, encoding="utf-8")


if __name__ == "__main__":
    main()
