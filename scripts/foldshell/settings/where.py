"""Where a support stands, as a text of the table: `zigzag=first`, `box ...`, `point ...`.

Terms with `&` between them hold what all of them name, with `|` what any of them names.
"""

import re
from dataclasses import dataclass

from foldshell.settings.regions import Region, read_numbers, read_region

BORDER, CORNERS, SIDE, LABEL = "border", "corners", "side", "label"
REGION, LEVEL, EDGES, VERTICES, POINT = "region", "z", "edges", "vertices", "point"
SIDES = ("x_min", "x_max", "y_min", "y_max")
FIRST, LAST = "first", "last"
WHERE_ALLOWED = (
    "border, corners, side=x_min (x_max, y_min, y_max, or the number of a side of the outline), a "
    "label such as zigzag=first, last or a number, `box x_min y_min x_max y_max`, `polygon x y, "
    "x y, x y`, `z low high`, `edges 3-4 4-5`, `vertices 3 4` or `point x y` (or x y z), joined by "
    "& and |,"
)
"""What the column may hold, for sentences about a text that is not allowed."""

_NAME = re.compile(r"[a-z][a-z0-9_]{0,31}")
_WHOLE = re.compile(r"0|[1-9][0-9]{0,8}")


@dataclass(frozen=True)
class Term:
    """One thing that a text names.

    `kind` is one of the words above; `name` that of a label or of a side; `place` first, last or a
    whole number as text; `numbers` are whole numbers of vertices, one or two of each thing, or the
    coordinates of points or levels in m.
    """

    kind: str
    name: str = ""
    place: str = ""
    numbers: tuple[tuple[float, ...], ...] = ()
    region: Region | None = None


Where = tuple[tuple[Term, ...], ...]
"""What any of the alternatives names, each of which is what all of its terms name."""


def read_where(text: str) -> Where:
    """Return what a text names; raises `ValueError` that says in some words what is wrong."""
    return tuple(
        tuple(_read_term(part.strip()) for part in alternative.split("&"))
        for alternative in text.split("|")
    )


def _read_term(text: str) -> Term:
    if not text:
        raise ValueError("a part of it is empty")
    if text in (BORDER, CORNERS):
        return Term(text)
    word, _, rest = text.partition(" ")
    if "=" in text:
        return _read_label(*(part.strip() for part in text.split("=", 1)))
    if word == "box" and len(rest.replace(",", " ").split()) == 6:
        raise ValueError("a box in plan has four numbers: add `& z low high` for its heights")
    if word in ("box", "polygon"):
        return Term(REGION, region=read_region(text))
    if word == LEVEL:
        low, high = read_numbers(rest.replace(",", " "), 2)
        if not low <= high:
            raise ValueError("the lower z comes first")
        return Term(LEVEL, numbers=((low, high),))
    if word == POINT:
        return Term(POINT, numbers=tuple(_read_point(part) for part in rest.split(",")))
    if word == VERTICES:
        return Term(VERTICES, numbers=tuple((_read_whole(one),) for one in _list_words(rest)))
    if word == EDGES:
        return Term(EDGES, numbers=tuple(_read_edge(one) for one in _list_words(rest)))
    raise ValueError(f"{word!r} is no word of it")


def _read_label(name: str, place: str) -> Term:
    if not _NAME.fullmatch(name):
        raise ValueError(f"{name!r} is no label")
    if name == SIDE:
        if place not in SIDES and not (_WHOLE.fullmatch(place) and place != "0"):
            raise ValueError(f"{place!r} is no side: {', '.join(SIDES)} or a number from 1")
        return Term(SIDE, place=place)
    if place not in (FIRST, LAST) and not _WHOLE.fullmatch(place):
        raise ValueError(f"{place!r} is neither first nor last nor a whole number from 0")
    return Term(LABEL, name, place)


def _read_point(text: str) -> tuple[float, ...]:
    return tuple(read_numbers(text, 3 if len(text.split()) == 3 else 2))


def _list_words(text: str) -> list[str]:
    words = text.replace(",", " ").split()
    if not words:
        raise ValueError("no number follows")
    return words


def _read_edge(text: str) -> tuple[int, int]:
    ends = tuple(_read_whole(part) for part in text.split("-"))
    if len(ends) != 2 or ends[0] == ends[1]:
        raise ValueError(f"{text!r} is no edge: two numbers of vertices with - between")
    return ends


def _read_whole(text: str) -> int:
    if not _WHOLE.fullmatch(text):
        raise ValueError(f"{text!r} is no whole number from 0")
    return int(text)
