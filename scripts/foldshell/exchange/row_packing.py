"""Panels side by side in rows of a sheet: each turned so that the row becomes shortest.

A panel in a row meets only its neighbours, so the best turns of a given row follow from dynamic
programming over turns. Rows suit panels nearly as wide as the sheet, which leave a general
nesting library little to choose; what is placed is checked exactly by the caller.
"""

import itertools
from dataclasses import dataclass

import numpy as np

STEP_DEG, FINE_DEG, ROWS = 6.0, 0.1, 61
"""Turns tried, the finer ones among which those are found that just fit, and the heights at which
outlines are compared."""
TRIES = 60
"""Panels that are tried for a place in vain before a row is closed."""
MOST, STEPS = 7, 12
"""Most panels of a row that is filled by length, and the tries for it."""


@dataclass(frozen=True)
class _Turns:
    """A panel in every turn that fits the row: outlines (t, k, 2) m, left and right profile
    (t, ROWS) m, width (t,) m."""

    outline: np.ndarray
    left: np.ndarray
    right: np.ndarray
    width: np.ndarray


@dataclass(frozen=True)
class Row:
    """Panels of a row: keys, and the outline (k, 2) m of each where it lies."""

    keys: tuple[int, ...]
    outlines: tuple[np.ndarray, ...]


def list_turns(outline: np.ndarray, height: float) -> _Turns | None:
    """Return the turns of a convex outline (k, 2) that fit a row, at its bottom, middle and top;
    None where none fits."""
    fine = np.radians(np.arange(0, 360, FINE_DEG))
    reach = np.ptp(np.outer(np.sin(fine), outline[:, 0]) + np.outer(np.cos(fine), outline[:, 1]),
                   axis=1)  # fmt: skip
    fits = reach <= height
    if not fits.any():
        return None
    just = fine[fits & ~(np.roll(fits, 1) & np.roll(fits, -1))]
    along = np.roll(outline, -1, axis=0) - outline
    sides = -np.arctan2(along[:, 1], along[:, 0])
    near = np.radians([-0.4, 0, 0.4])
    angles = np.concatenate([np.radians(np.arange(0, 360, STEP_DEG)),
                             np.add.outer(just, near).ravel(), sides, sides + np.pi])  # fmt: skip
    turned = turn_outline(outline, angles)
    tall = turned[..., 1].max(axis=1)
    turned, room = turned[tall <= height], (height - tall)[tall <= height]
    placed = [turned + share * room[:, None, None] * [0.0, 1.0] for share in (0.0, 0.5, 1.0)]
    turned = np.concatenate(placed)
    left, right = _profiles(turned, np.linspace(0, height, ROWS))
    return _Turns(turned, left, right, turned[..., 0].max(axis=1))


def turn_outline(outline: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """Return an outline (k, 2) turned by angles (t,) rad, each with its lower left at 0."""
    cosine, sine = np.cos(angles)[:, None], np.sin(angles)[:, None]
    x, y = outline.T
    turned = np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)
    return turned - turned.min(axis=1, keepdims=True)


def _profiles(outlines: np.ndarray, heights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the least and largest x of outlines (t, k, 2) at heights (h,): (t, h), inf beside."""
    start, stop = outlines[..., None, :], np.roll(outlines, -1, axis=1)[..., None, :]
    rise = stop[..., 1] - start[..., 1]
    part = (heights - start[..., 1]) / np.where(rise == 0, 1, rise)
    x = start[..., 0] + part * (stop[..., 0] - start[..., 0])
    low, high = np.minimum(start[..., 1], stop[..., 1]), np.maximum(start[..., 1], stop[..., 1])
    inside = (heights >= low) & (heights <= high)
    return np.where(inside, x, np.inf).min(axis=1), np.where(inside, x, -np.inf).max(axis=1)


def _slides(first: _Turns, second: _Turns, gap: float) -> np.ndarray:
    """Return how far the second must lie right of the first, (t, u) m, turn by turn."""
    slide = np.full((len(first.width), len(second.width)), -np.inf)
    for row in range(ROWS):
        np.maximum(slide, first.right[:, row, None] - second.left[:, row], out=slide)
    return np.maximum(slide + gap, 0.0)


class RowPacker:
    """Fills rows of one length and height from a stock of panels, the hardest to place first."""

    def __init__(self, outlines: dict[int, np.ndarray], length: float, height: float, gap: float):
        self.length, self.gap = length, gap
        found = {key: list_turns(outline, height) for key, outline in outlines.items()}
        self.turns = {key: turns for key, turns in found.items() if turns is not None}
        self.oversize = [
            key for key, turns in found.items() if turns is None or turns.width.min() > length
        ]
        for key in self.oversize:
            self.turns.pop(key, None)
        self.area = {key: _area(outlines[key]) for key in self.turns}
        self.measures = {key: _measure(outlines[key]) for key in self.turns}
        self.alone = {key: self._measure_alone(key) for key in self.turns}

    def fill(self) -> list[Row]:
        """Fill rows until the stock is used up, by the better of two ways to share them out."""
        return min((self._fill_alike(), self._fill_by_length()), key=len)

    def _fill_alike(self) -> list[Row]:
        """Begin with the largest panel, and add of those most like it what still fits."""
        left, rows = set(self.turns), []
        while left:
            seed = max(left, key=lambda key: (self.area[key], -key))
            others = sorted(left - {seed}, key=lambda key: (self._differ(seed, key), key))
            rows.append(self._place(self._extend(seed, others)))
            left -= set(rows[-1].keys)
        return rows

    def _fill_by_length(self) -> list[Row]:
        """Fill rows with as many panels as go into one, long panels beside short ones; what is left
        over goes into rows with one less."""
        left, rows = set(self.turns), []
        for count in range(MOST, 0, -1):
            aside = set()
            while left:
                seed = max(left, key=lambda key: (self.alone[key][count - 1], -key))
                left.remove(seed)
                row = self._match(seed, left, count)
                if row is None:
                    aside.add(seed)
                else:
                    rows.append(row)
                    left -= set(row.keys)
            left = aside
        return rows

    def _match(self, seed: int, left: set[int], count: int) -> Row | None:
        """Return a row of a seed and others whose mean length in a row of their like is short
        enough, the longest such that fit; None where there are none."""
        own = {key: self.alone[key][count - 1] for key in left if self._alike(seed, key)}
        room = count * self.length - self.alone[seed][count - 1]
        room = room / (count - 1) if count > 1 else room
        stock = sorted((key for key in own if own[key] <= room), key=lambda key: (-own[key], key))
        if len(stock) < count - 1 or room < 0:
            return None
        last = len(stock) - count + 1
        for skip in sorted({round(last * k / STEPS) for k in range(STEPS + 1)}):
            keys = sorted([seed, *stock[skip : skip + count - 1]], key=self._lean)
            row = self._place(keys)
            if len(row.keys) == count:
                return row
        return None

    def _lean(self, key: int) -> tuple[float, int]:
        """Return how far a panel leans, m: neighbours in a row should lean alike."""
        measures = self.measures[key]
        return (float(measures[2] - measures[3]) if len(measures) == 4 else 0.0), key

    def _alike(self, one: int, other: int) -> bool:
        """Whether two panels lean to the same side."""
        first, second = self.measures[one], self.measures[other]
        if len(first) != len(second):
            return False
        return len(first) != 4 or (first[2] > first[3]) == (second[2] > second[3])

    def _measure_alone(self, key: int) -> list[float]:
        """Return the length of rows of 1, 2, ... such panels, m."""
        turns = self.turns[key]
        slide = _slides(turns, turns, self.gap)
        start, lengths = np.zeros(len(turns.width)), []
        for _ in range(MOST):
            lengths.append(float((start + turns.width).min()))
            start = (start[:, None] + slide).min(axis=0)
        return lengths

    def _differ(self, one: int, other: int) -> float:
        """Return how much the sides and diagonals of two panels differ, m."""
        first, second = self.measures[one], self.measures[other]
        return float(np.abs(first - second).sum()) if len(first) == len(second) else np.inf

    def _extend(self, seed: int, order: list[int]) -> list[int]:
        """Add to a row, one after the other, the first panels of an order that still fit it."""
        keys, start = [seed], np.zeros(len(self.turns[seed].width))
        tries = 0
        for key in order:
            if tries == TRIES:
                break
            turns = self.turns[key]
            after = start[:, None] + _slides(self.turns[keys[-1]], turns, self.gap)
            after = after.min(axis=0)
            fits = float((after + turns.width).min()) <= self.length
            if fits and len(self._place([*keys, key]).keys) > len(keys):
                keys.append(key)
                start, tries = after, 0
            else:
                tries += 1
        return keys

    def _best(self, keys: list[int]) -> tuple[list[np.ndarray], list[np.ndarray]]:
        """Return the least end (t,) of the row after each panel by its turn, and the turn before it
        that gives it."""
        turns = self.turns[keys[0]]
        start, ends, before = np.zeros(len(turns.width)), [turns.width], []
        for last, key in itertools.pairwise(keys):
            turns = self.turns[key]
            place = start[:, None] + _slides(self.turns[last], turns, self.gap)
            before.append(place.argmin(axis=0))
            start = place.min(axis=0)
            ends.append(start + turns.width)
        return ends, before

    def _place(self, keys: list[int]) -> Row:
        """Place a row; what would end beyond the sheet after exact placing stays in stock."""
        ends, before = self._best(keys)
        turn = [int(ends[-1].argmin())]
        for step in reversed(before):
            turn.insert(0, int(step[turn[0]]))
        placed, edge = [], 0.0
        for key, number in zip(keys, turn, strict=True):
            outline = self.turns[key].outline[number]
            shift = max((exact_slide(other, outline) + self.gap for other in placed), default=0.0)
            outline = outline + np.array([max(shift, 0.0), 0.0])
            edge = outline[:, 0].max()
            if edge > self.length + 1e-9 and placed:
                break
            placed.append(outline)
        return Row(tuple(keys[: len(placed)]), tuple(placed))


def _area(outline: np.ndarray) -> float:
    x, y = outline.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def _measure(outline: np.ndarray) -> np.ndarray:
    """Return the sums of opposite sides of a quadrilateral and its diagonals twice; half a turn
    changes nothing, a mirror does. Of other outlines the sides."""
    sides = np.linalg.norm(np.roll(outline, -1, axis=0) - outline, axis=1)
    if len(outline) != 4:
        return sides
    diagonals = np.linalg.norm(outline[2:] - outline[:2], axis=1)
    return np.concatenate([sides[:2] + sides[2:], 2 * diagonals])


def exact_slide(first: np.ndarray, second: np.ndarray) -> float:
    """Return how far right convex `second` (k, 2) must move to lie beside convex `first` (l, 2).

    The difference of both profiles is concave and linear between corners, so its maximum is at a
    corner's height.

    All in one unit of length.
    """
    low = max(first[:, 1].min(), second[:, 1].min())
    high = min(first[:, 1].max(), second[:, 1].max())
    if low >= high:
        return -np.inf
    heights = np.clip(np.concatenate([first[:, 1], second[:, 1]]), low, high)
    right = _profiles(first[None], heights)[1][0]
    left = _profiles(second[None], heights)[0][0]
    return float((right - left).max())
