"""Regions of the plan as texts of a table: boxes and polygons, in m."""

import itertools
import math
import re
from dataclasses import dataclass

BOX, POLYGON = "box", "polygon"

REGION_ALLOWED = (
    "`box x_min y_min x_max y_max` or `polygon x y, x y, x y, ...` with finite numbers in m, with "
    "an area and without sides that cross"
)
"""What a text of a region may be, for sentences about one that is not."""

CORNERS_MAX = 1000
_NUMBER = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]{1,3})?")

Point = tuple[float, float]


@dataclass(frozen=True)
class Region:
    """A simple polygon in plan, its border included; `corners` in m, in either sense."""

    corners: tuple[Point, ...]


def read_region(text: str) -> Region:
    """Return the region of a text `box x_min y_min x_max y_max` or `polygon x y, x y, x y`, m.

    Raises `ValueError`, which says what is wrong in some words, for anything else: too few or too
    many numbers, numbers that are not finite, an empty area, sides that cross.
    """
    kind, _, rest = text.strip().partition(" ")
    if kind == BOX:
        low_x, low_y, high_x, high_y = read_numbers(rest.replace(",", " "), 4)
        if not (low_x < high_x and low_y < high_y):
            raise ValueError("the box is empty: the least x and y come first")
        return Region(((low_x, low_y), (high_x, low_y), (high_x, high_y), (low_x, high_y)))
    if kind != POLYGON:
        raise ValueError(f"{kind!r} is neither box nor polygon")
    corners = tuple(tuple(read_numbers(pair, 2)) for pair in rest.split(","))
    _check_polygon(corners)
    return Region(corners)


def read_numbers(text: str, count: int) -> list[float]:
    """Return so many plain finite numbers with blanks between; raises `ValueError` for others."""
    words = text.split()
    wrong = [word for word in words if not _NUMBER.fullmatch(word)]
    if wrong:
        raise ValueError(f"{wrong[0]!r} is no plain number")
    if len(words) != count:
        raise ValueError(f"{len(words)} numbers stand where {count} are due")
    numbers = [float(word) for word in words]
    if not all(math.isfinite(number) for number in numbers):
        raise ValueError("a number is not finite")
    return numbers


def _check_polygon(corners: tuple[Point, ...]) -> None:
    if not 3 <= len(corners) <= CORNERS_MAX:
        raise ValueError(f"{len(corners)} corners: 3 to {CORNERS_MAX} are due")
    if len(set(corners)) < len(corners):
        raise ValueError("a corner stands twice")
    sides = list(zip(corners, (*corners[1:], corners[0]), strict=True))
    area = sum(a[0] * b[1] - b[0] * a[1] for a, b in sides) / 2
    size = max(max(axis) - min(axis) for axis in zip(*corners, strict=True))
    if abs(area) <= 1e-12 * size**2:
        raise ValueError("the corners enclose no area")
    for (i, one), (k, other) in itertools.combinations(enumerate(sides), 2):
        beside = k - i == 1 or (i == 0 and k == len(sides) - 1)
        if not beside and _cross(*one, *other):
            raise ValueError(f"sides {i + 1} and {k + 1} of the polygon meet")


def _cross(a: Point, b: Point, c: Point, d: Point) -> bool:
    """Tell whether the segments a-b and c-d have a point in common."""
    sides = [_turn(a, b, c), _turn(a, b, d), _turn(c, d, a), _turn(c, d, b)]
    if sides[0] * sides[1] < 0 and sides[2] * sides[3] < 0:
        return True
    pairs = ((a, b, c), (a, b, d), (c, d, a), (c, d, b))
    return any(
        side == 0
        and min(p[0], q[0]) <= r[0] <= max(p[0], q[0])
        and min(p[1], q[1]) <= r[1] <= max(p[1], q[1])
        for side, (p, q, r) in zip(sides, pairs, strict=True)
    )


def _turn(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
