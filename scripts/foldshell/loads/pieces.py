"""Triangles cut by straight lines: the parts of elements on which a load acts.

A part is kept in the reference coordinates r, s of its element, whose corners are (0, 0), (1, 0)
and (0, 1): what is linear over the element is linear over the part.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

REFERENCE = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])


@dataclass(frozen=True)
class Pieces:
    """T triangles; `owner` (T,) is the element of each, `corners` (T, 3, 2) its r, s."""

    owner: np.ndarray
    corners: np.ndarray

    def __len__(self) -> int:
        """Return the number of triangles."""
        return len(self.owner)

    def pick(self, which: np.ndarray) -> Pieces:
        """Return those of a mask (T,) or of numbers."""
        return Pieces(self.owner[which], self.corners[which])

    @property
    def share(self) -> np.ndarray:
        """Area of each over that of its element, (T,) without unit."""
        a, b = (self.corners[:, k] - self.corners[:, 0] for k in (1, 2))
        return np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])

    def evaluate(self, values: np.ndarray) -> np.ndarray:
        """Return what is linear over elements at the corners of the pieces, (T, 3, ...).

        values (E, 3, ...) at the corners of the elements, in any unit.
        """
        own = values[self.owner]
        weight = barycentric(self.corners)
        return np.einsum("tkc,tc...->tk...", weight, own)


def barycentric(points: np.ndarray) -> np.ndarray:
    """Return the weights 1 - r - s, r, s (..., 3) of points (..., 2), without unit."""
    return np.concatenate([1 - points.sum(axis=-1, keepdims=True), points], axis=-1)


def make_pieces(owner: np.ndarray) -> Pieces:
    """Return whole elements as pieces, by their numbers (T,)."""
    return Pieces(owner, np.broadcast_to(REFERENCE, (len(owner), 3, 2)))


def join_pieces(parts: Iterable[Pieces]) -> Pieces:
    """Return several sets of pieces as one."""
    parts = list(parts)
    owner = np.concatenate([part.owner for part in parts] or [np.empty(0, dtype=np.int64)])
    return Pieces(owner, np.concatenate([np.empty((0, 3, 2)), *(part.corners for part in parts)]))


def split_pieces(pieces: Pieces, distance: np.ndarray, near: float) -> tuple[Pieces, Pieces]:
    """Return the parts where a linear function is positive, and those where it is negative.

    Parameters
    ----------
    distance : (T, 3) m at the corners of the pieces
    near : m, distances below it count as 0, so that lines along edges cut nothing off
    """
    distance = np.where(np.abs(distance) <= near, 0.0, distance)
    inside, outside = (distance >= 0).all(axis=1), (distance <= 0).all(axis=1)
    cut = ~(inside | outside)
    tips, bases, upward = _cut(pieces.pick(cut), distance[cut])
    positive = [pieces.pick(inside), tips.pick(upward), bases.pick(np.tile(~upward, 2))]
    negative = [pieces.pick(outside & ~inside), tips.pick(~upward), bases.pick(np.tile(upward, 2))]
    return join_pieces(positive), join_pieces(negative)


def _cut(pieces: Pieces, distance: np.ndarray) -> tuple[Pieces, Pieces, np.ndarray]:
    """Cut triangles that have corners on both sides: the tip with the corner that is alone on its
    side, two triangles for the rest, and whether the tip is on the positive side."""
    upward = (distance > 0).sum(axis=1) == 1
    alone = np.where(upward[:, None], distance > 0, distance < 0).argmax(axis=1)
    order = (alone[:, None] + np.arange(3)) % 3
    rows = np.arange(len(pieces))[:, None]
    corner, value = pieces.corners[rows, order], distance[rows, order]
    share = (value[:, :1] / (value[:, :1] - value[:, 1:]))[..., None]
    first, second = np.moveaxis(corner[:, :1] + share * (corner[:, 1:] - corner[:, :1]), 1, 0)
    tips = np.stack([corner[:, 0], first, second], axis=1)
    left = np.stack([first, corner[:, 1], corner[:, 2]], axis=1)
    right = np.stack([first, corner[:, 2], second], axis=1)
    both = Pieces(np.tile(pieces.owner, 2), np.concatenate([left, right]))
    return Pieces(pieces.owner, tips), both, upward
