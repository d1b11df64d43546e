"""Principal stress lines kept apart: none starts or goes on close to a stronger one.

Source: Jobard and Lefer, Creating evenly-spaced streamlines of arbitrary density (1997).
"""

from dataclasses import dataclass

import numpy as np

SPACINGS_MIN = 3.0
"""Least length of a line, in spacings."""
AROUND = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3), axis=-1).reshape(-1, 3)
"""Steps (27, 3) from a box to those that touch it."""


@dataclass(frozen=True)
class PrincipalStressLine:
    """Points (n, 3) m of one line and the force (n,) kN/m at them; family 0 or 1 at its start,
    which is the point `start`."""

    points: np.ndarray
    force: np.ndarray
    family: int
    start: int = 0

    @property
    def strength(self) -> float:
        """Integral of the force along the line, kN."""
        sides = np.linalg.norm(np.diff(self.points, axis=0), axis=1)
        return float(np.abs((self.force[:-1] + self.force[1:]) / 2) @ sides)


def thin_out(lines: list[PrincipalStressLine], spacing: float) -> list[PrincipalStressLine]:
    """Keep lines, strongest first, whose start is `spacing` m from all kept before, in a piece
    about their start up to where they come within half of that of one of them."""
    order = sorted(range(len(lines)), key=lambda k: (-lines[k].strength, k))
    if not lines:
        return []
    every = np.concatenate([line.points for line in lines])
    near, taken = _Grid(every, spacing), _Grid(every, spacing / 2)
    kept = []
    for k in order:
        line = lines[k]
        if near.holds(line.points[line.start : line.start + 1])[0]:
            continue
        start, end = _run_about(~taken.holds(line.points), line.start)
        part = line.points[start:end]
        if end - start > 1 and _length(part) >= SPACINGS_MIN * spacing:
            taken.mark(part)
            near.mark(part, around=True)
            piece = line.start - start
            kept.append(PrincipalStressLine(part, line.force[start:end], line.family, piece))
    return kept


class _Grid:
    """Boxes of a given side, m, some of them marked, about all points (n, 3) m that may come."""

    def __init__(self, points: np.ndarray, side: float) -> None:
        low, high = (np.floor(end / side) for end in (points.min(axis=0), points.max(axis=0)))
        self._side, self._low = side, low.astype(int) - 1
        self._marked = np.zeros((high - low).astype(int) + 3, dtype=bool)

    def holds(self, points: np.ndarray) -> np.ndarray:
        """Tell of each point (n, 3) m whether its box is marked."""
        return self._marked[tuple(self._boxes(points).T)]

    def mark(self, points: np.ndarray, around: bool = False) -> None:
        """Mark the boxes of points (n, 3) m, or these with all that touch them."""
        boxes = self._boxes(points)
        if around:
            boxes = (boxes[:, None] + AROUND).reshape(-1, 3)
        self._marked[tuple(boxes.T)] = True

    def _boxes(self, points: np.ndarray) -> np.ndarray:
        return np.floor(points / self._side).astype(int) - self._low


def split_lines(lines: list[PrincipalStressLine]) -> tuple[np.ndarray, np.ndarray]:
    """Return all segments (S, 2, 3) m of lines and the mean force (S,) kN/m on each."""
    segments = [np.stack([line.points[:-1], line.points[1:]], axis=1) for line in lines]
    force = [(line.force[:-1] + line.force[1:]) / 2 for line in lines]
    if not segments:
        return np.empty((0, 2, 3)), np.empty(0)
    return np.concatenate(segments), np.concatenate(force)


def _length(points: np.ndarray) -> float:
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def _run_about(flags: np.ndarray, place: int) -> tuple[int, int]:
    """Return start and end of the run of True that holds a place; the place itself is taken."""
    lost = np.flatnonzero(~flags)
    before, after = lost[lost < place], lost[lost > place]
    start = int(before[-1]) + 1 if len(before) else 0
    return start, int(after[0]) if len(after) else len(flags)
