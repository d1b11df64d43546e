"""What of a sheet is seen from above: elements without the parts that others cover."""

import numpy as np

from foldshell.loads.pieces import Pieces, join_pieces, make_pieces, split_pieces

CHUNK = 256
"""Elements whose boxes are compared with those of all others at once."""


def subtract_covers(
    pieces: Pieces, corners: np.ndarray, facet: np.ndarray, above: np.ndarray, near: float
) -> Pieces:
    """Return the pieces without what elements of other facets cover, seen from above.

    Parameters
    ----------
    pieces : parts of elements
    corners : (E, 3, 3) m of all elements
    facet : (E,) facet of each
    above : (A,) elements that can cover others
    near : m, distance that counts as none
    """
    flat = _is_upright(corners, near)
    pieces = pieces.pick(~flat[pieces.owner])
    below, cover = _find_covers(corners, facet, np.unique(pieces.owner), above[~flat[above]], near)
    order = np.argsort(below, kind="stable")
    below, cover = below[order], cover[order]
    first = np.searchsorted(below, np.arange(len(corners)))
    count = np.bincount(below, minlength=len(corners))
    for number in range(int(count.max(initial=0))):
        touched = count[pieces.owner] > number
        hit = pieces.pick(touched)
        triangle = corners[cover[first[hit.owner] + number]]
        outside = _subtract(hit, corners, triangle, near)
        pieces = join_pieces([pieces.pick(~touched), outside])
    return pieces.pick(pieces.share > 1e-15)


def _is_upright(corners: np.ndarray, near: float) -> np.ndarray:
    """Whether elements have no area in plan."""
    twice = _turn(corners[:, 0], corners[:, 1], corners[:, 2])
    return np.abs(twice) <= near * np.ptp(corners[..., :2], axis=1).max(axis=1, initial=near)


def _find_covers(
    corners: np.ndarray, facet: np.ndarray, owner: np.ndarray, above: np.ndarray, near: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return pairs of elements: one below, and one of another facet that covers part of it."""
    pairs = [np.empty((2, 0), dtype=np.int64)]
    low, high = corners[..., :2].min(axis=1) + near, corners[..., :2].max(axis=1) - near
    for start in range(0, len(owner), CHUNK):
        own = owner[start : start + CHUNK, None]
        meet = (low[own] < high[above]).all(axis=2) & (high[own] > low[above]).all(axis=2)
        row, column = np.nonzero(meet & (facet[own] != facet[above]))
        pairs.append(np.stack([own[row, 0], above[column]]))
    below, cover = np.concatenate(pairs, axis=1)
    covers = _is_covered(corners, below, cover, near)
    return below[covers], cover[covers]


def _is_covered(
    corners: np.ndarray, below: np.ndarray, cover: np.ndarray, near: float
) -> np.ndarray:
    """Whether the second element of each pair lies above the first where they overlap in plan."""
    pieces = Pieces(np.arange(len(below)), make_pieces(below).corners)
    mine, triangle = corners[below], corners[cover]
    for line in _borders(triangle):
        distance = pieces.evaluate(_heights(mine, line))
        pieces, _ = split_pieces(pieces, distance, near)
    share = np.bincount(pieces.owner, pieces.share, len(below))
    middle = pieces.evaluate(mine).mean(axis=1) * pieces.share[:, None]
    centre = np.stack(
        [np.bincount(pieces.owner, column, len(below)) for column in middle.T], axis=1
    ).astype(float)  # counts of nothing are whole numbers
    overlap = share > 1e-12
    centre[overlap] /= share[overlap, None]
    height = _plane_height(triangle, centre)
    return overlap & (height > centre[:, 2] + 1e3 * near)


def _subtract(hit: Pieces, corners: np.ndarray, triangle: np.ndarray, near: float) -> Pieces:
    """Return pieces (T) without the plan of one triangle (T, 3, 3) each."""
    number, found = np.arange(len(hit)), []
    mine = corners[hit.owner]
    inside = Pieces(number, hit.corners)
    for line in _borders(triangle):
        distance = inside.evaluate(_heights(mine, line))
        inside, outside = split_pieces(inside, distance, near)
        found.append(outside)
    rest = join_pieces(found)
    return Pieces(hit.owner[rest.owner], rest.corners)


def _borders(triangle: np.ndarray) -> list[np.ndarray]:
    """Return the lines (T, 3) of the three sides in plan, a x + b y + c >= 0 inside."""
    sense = np.sign(_turn(triangle[:, 0], triangle[:, 1], triangle[:, 2]))[:, None]
    lines = []
    for k in range(3):
        a, b = triangle[:, k, :2], triangle[:, (k + 1) % 3, :2]
        inward = sense * np.stack([a[:, 1] - b[:, 1], b[:, 0] - a[:, 0]], axis=1)
        inward /= np.linalg.norm(inward, axis=1)[:, None]
        lines.append(np.column_stack([inward, -(inward * a).sum(axis=1)]))
    return lines


def _heights(mine: np.ndarray, line: np.ndarray) -> np.ndarray:
    """Return a x + b y + c of one line (T, 3) each at corners (T, 3, 3), (T, 3) m."""
    return np.einsum("tkx,tx->tk", mine[..., :2], line[:, :2]) + line[:, 2:]


def _plane_height(triangle: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Return z of the planes of triangles (T, 3, 3) at the plan of points (T, 3), (T,) m."""
    a = triangle[:, 0]
    normal = np.cross(triangle[:, 1] - a, triangle[:, 2] - a)
    move = ((point - a)[:, :2] * normal[:, :2]).sum(axis=1)
    return a[:, 2] - move / normal[:, 2]


def _turn(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    one, two = b - a, c - a
    return one[..., 0] * two[..., 1] - one[..., 1] * two[..., 0]
