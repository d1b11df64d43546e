"""Where a load acts, as a text of the table of loads, and how its size varies there."""

import itertools
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from foldshell.settings.regions import Region, read_region

SIDES = ("x-", "x+", "y-", "y+")
ZONE_ALLOWED = (
    "all, box x y x y, polygon x y, x y, ..., side x-, x+, y- or y+ of the crown, zigzag i-j, "
    "strip i-j, panels i, j-k, point x y, or line x y, x y"
)
VARIATION_ALLOWED = "an axis x, y or z and places with factors, as `x -7:0, 0:1, 7:0`"
_RANGE = re.compile(r"([0-9]{1,6})(?:-([0-9]{1,6}))?")
_NUMBER = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]{1,3})?")
_PLACES_MAX = 100


@dataclass(frozen=True)
class Zone:
    """A part of the sheet.

    Attributes
    ----------
    kind : "all", "region" (a polygon in plan), "side" (of the crown), "zigzag" or "strip" (panels
        between two polylines), "panels", "point" or "line" (in plan)
    region : of a region
    side : one of `SIDES`
    lines : first and last polyline of a range
    panels : ranges of panel numbers, first and last each
    points : (x, y) m of a point or along a line
    """

    kind: str = "all"
    region: Region | None = None
    side: str = ""
    lines: tuple[int, int] = (0, 0)
    panels: tuple[tuple[int, int], ...] = ()
    points: tuple[tuple[float, float], ...] = ()


EVERYWHERE = Zone()


@dataclass(frozen=True)
class Variation:
    """A factor that is linear between places (m) along an axis, and constant beyond them."""

    axis: int
    places: tuple[float, ...]
    factors: tuple[float, ...] = field(default=())


def read_zone(text: str) -> Zone:
    """Return the zone of a text such as `side x-`; raises `ValueError` in some words."""
    kind, _, rest = text.strip().partition(" ")
    rest = rest.strip()
    if kind in ("", "all") and not rest:
        return EVERYWHERE
    if kind in ("box", "polygon"):
        return Zone("region", region=read_region(text))
    if kind == "side":
        if rest not in SIDES:
            raise ValueError(f"{rest!r} is no side of the crown: {', '.join(SIDES)} are")
        return Zone("side", side=rest)
    if kind in ("zigzag", "strip"):
        first, last = _read_range(rest)
        if first == last:
            raise ValueError(f"between polylines {first} and {last} lies no panel")
        return Zone(kind, lines=(first, last))
    if kind == "panels":
        return Zone("panels", panels=tuple(_read_range(part) for part in rest.split(",")))
    if kind in ("point", "line"):
        return _read_points(kind, rest)
    raise ValueError(f"{kind!r} is no zone")


def _read_range(text: str) -> tuple[int, int]:
    found = _RANGE.fullmatch(text.strip())
    if not found:
        raise ValueError(f"{text.strip()!r} is neither a number nor a range such as 3-8")
    first, last = int(found[1]), int(found[2] or found[1])
    if last < first:
        raise ValueError(f"{text.strip()!r}: the range runs backwards")
    return first, last


def _read_points(kind: str, text: str) -> Zone:
    points = tuple(_read_pair(part) for part in text.split(","))
    if kind == "point" and len(points) != 1:
        raise ValueError(f"a point is one pair of numbers, not {len(points)}")
    if kind == "line" and not 2 <= len(points) <= _PLACES_MAX:
        raise ValueError(f"a line has 2 to {_PLACES_MAX} points, not {len(points)}")
    if any(a == b for a, b in itertools.pairwise(points)):
        raise ValueError("a point of the line stands twice")
    return Zone(kind, points=points)


def _read_pair(text: str) -> tuple[float, float]:
    numbers = [read_number(word) for word in text.split()]
    if len(numbers) != 2:
        raise ValueError(f"{len(numbers)} numbers stand where x and y are due")
    return numbers[0], numbers[1]


def read_number(text: str) -> float:
    """Return a finite plain number; raises `ValueError`."""
    if not _NUMBER.fullmatch(text) or not math.isfinite(float(text)):
        raise ValueError(f"{text!r} is no plain finite number")
    return float(text)


def read_variation(text: str) -> Variation | None:
    """Return the variation of a text such as `x -7:0, 0:1, 7:0`, None for an empty one.

    Raises `ValueError`: the places rise, and one factor at least is not 0.
    """
    if not text.strip():
        return None
    axis, _, rest = text.strip().partition(" ")
    if axis not in ("x", "y", "z"):
        raise ValueError(f"{axis!r} is no axis")
    pairs = [part.split(":") for part in rest.split(",")]
    if any(len(pair) != 2 for pair in pairs) or not 2 <= len(pairs) <= _PLACES_MAX:
        raise ValueError(f"2 to {_PLACES_MAX} pairs place:factor are due")
    places = tuple(read_number(place.strip()) for place, _ in pairs)
    factors = tuple(read_number(factor.strip()) for _, factor in pairs)
    if any(b <= a for a, b in itertools.pairwise(places)):
        raise ValueError("the places do not rise")
    if not any(factors):
        raise ValueError("all factors are 0")
    return Variation("xyz".index(axis), places, factors)


def number_panels(zone: Zone, zigzag_count: int, strip_count: int) -> Zone:
    """Return the panels of a range of polylines, panel (i, j) being i (strip_count - 1) + j.

    Other zones stay. Raises `ValueError` for polylines or panels that the sheet has not.
    """
    across = strip_count - 1
    if zone.kind in ("zigzag", "strip"):
        first, last = zone.lines
        count = zigzag_count if zone.kind == "zigzag" else strip_count
        if last > count - 1:
            raise ValueError(f"{zone.kind} {last}: the sheet has polylines 0 to {count - 1}")
        if zone.kind == "zigzag":
            return Zone("panels", panels=((first * across, last * across - 1),))
        rows = range(zigzag_count - 1)
        return Zone("panels", panels=tuple((r * across + first, r * across + last - 1)
                                           for r in rows))  # fmt: skip
    _check_panels(zone.panels, (zigzag_count - 1) * across)
    return zone


def _check_panels(panels: Sequence[tuple[int, int]], count: int) -> None:
    for _, last in panels:
        if last >= count:
            raise ValueError(f"panel {last}: the sheet has panels 0 to {count - 1}")
