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
    near: set[tuple[int, int, int]] = set()
    taken: set[tuple[int, int, int]] = set()
    kept = []
    for k in order:
        line = lines[k]
        if _boxes(line.points[line.start : line.start + 1], spacing)[0] in near:
            continue
        boxes = _boxes(line.points, spacing / 2)
        free = np.array([box not in taken for box in boxes])
        start, end = _run_about(free, line.start)
        part = line.points[start:end]
        if end - start > 1 and _length(part) >= SPACINGS_MIN * spacing:
            taken.update(boxes[start:end])
            near.update(_boxes(part, spacing, around=True))
            piece = line.start - start
            kept.append(PrincipalStressLine(part, line.force[start:end], line.family, piece))
    return kept


def _boxes(points: np.ndarray, side: float, around: bool = False) -> list[tuple[int, int, int]]:
    """Return the box of each point (n, 3) m, or these boxes with all that touch them."""
    boxes = np.floor(points / side).astype(int)
    if around:
        boxes = (boxes[:, None] + AROUND).reshape(-1, 3)
    return list(map(tuple, boxes.tolist()))


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
