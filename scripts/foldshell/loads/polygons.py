"""Polygons as convex parts, by ears (Meisters 1975)."""

import numpy as np


def split_convex(corners: np.ndarray) -> list[np.ndarray]:
    """Return a simple polygon as convex parts (K, 2) m, counter-clockwise.

    corners (K, 2) m in either sense; one that is convex stays whole.
    """
    corners = np.asarray(corners, dtype=float)
    corners = corners - 0.0 if _signed_area(corners) > 0 else corners[::-1]
    before, after = np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0)
    if (_turn(before, corners, after) >= 0).all():
        return [corners]
    parts, rest = [], list(range(len(corners)))
    while len(rest) > 3:
        ear = _find_ear(corners, rest)
        trio = [rest[ear - 1], rest[ear], rest[(ear + 1) % len(rest)]]
        parts.append(corners[trio])
        rest.pop(ear)
    parts.append(corners[rest])
    return [part for part in parts if _signed_area(part) > 0]


def _find_ear(corners: np.ndarray, rest: list[int]) -> int:
    """Return the place of a corner that can be cut off."""
    flattest, flat = 0, np.inf
    for place in range(len(rest)):
        trio = [rest[place - 1], rest[place], rest[(place + 1) % len(rest)]]
        a, b, c = corners[trio]
        bend = _turn(a, b, c)
        if abs(bend) < flat:
            flattest, flat = place, abs(bend)
        others = corners[[k for k in rest if k not in trio]]
        if bend > 0 and not _inside(others, a, b, c).any():
            return place
    return flattest  # a corner on a straight side, which cuts nothing off


def _inside(points: np.ndarray, a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    pairs = ((a, b), (b, c), (c, a))
    return np.all([_turn(p, q, points) >= 0 for p, q in pairs], axis=0)


def _turn(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Return twice the signed area of triangles a, b, c (..., 2)."""
    one, two = b - a, c - a
    return one[..., 0] * two[..., 1] - one[..., 1] * two[..., 0]


def _signed_area(corners: np.ndarray) -> float:
    x, y = corners.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
