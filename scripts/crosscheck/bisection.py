"""A tree that halves the facets again and again across few shared unknowns."""

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix

Tree = int | tuple["Tree", "Tree"]
"""A facet, or two trees."""

BALANCE = 0.35
"""Least share of the facets on the smaller side of a cut."""


def bisect(place: np.ndarray, centres: np.ndarray) -> Tree:
    """Halve the facets with unknowns `place` (F, n), -1 for none, and `centres` (F, 3).

    The facets are put in line along each axis, by their centres and by those evened out among
    neighbours, which does away with the zig-zag of a folded sheet; the line is cut where least
    is shared.
    """
    shared = _count_shared(place, len(centres))
    even = centres
    for _ in range(2):
        weight = shared.astype(bool).astype(float) + _identity(len(centres))
        even = (weight @ even) / np.asarray(weight.sum(axis=1)).reshape(-1, 1)
    keys = np.hstack([centres, even])
    first, second = shared.nonzero()
    pairs = np.column_stack([first, second])[first < second]
    weight = np.asarray(shared[pairs[:, 0], pairs[:, 1]]).ravel()
    return _bisect(np.arange(len(centres)), pairs, weight, keys, np.empty(len(centres), int))


def _identity(size: int) -> csr_matrix:
    return csr_matrix((np.ones(size), np.arange(size), np.arange(size + 1)), (size, size))


def _count_shared(place: np.ndarray, count: int) -> csr_matrix:
    """Unknowns that two facets share, those of one edge only: (F, F)."""
    facet, _ = np.nonzero(place >= 0)
    equation = place[place >= 0]
    order = np.argsort(equation, kind="stable")
    facet, equation = facet[order], equation[order]
    start = np.flatnonzero(np.diff(equation, prepend=-1))
    pair = start[np.diff(start, append=len(equation)) == 2]
    rows, columns = facet[pair], facet[pair + 1]
    one = np.ones(2 * len(pair))
    ends = (np.concatenate([rows, columns]), np.concatenate([columns, rows]))
    return coo_matrix((one, ends), (count, count)).tocsr()


def _bisect(
    facets: np.ndarray, pairs: np.ndarray, weight: np.ndarray, keys: np.ndarray, rank: np.ndarray
) -> Tree:
    count = len(facets)
    if count == 1:
        return int(facets[0])
    if count == 2:
        first, second = facets[np.argsort(keys[facets, 0], kind="stable")].tolist()
        return first, second
    order = facets[np.argsort(keys[facets], axis=0, kind="stable")]
    best, cut, line = np.inf, count // 2, order[:, 0]
    least = max(1, round(BALANCE * count))
    for column in order.T if count > 2 else order.T[:1]:
        rank[column] = np.arange(count)
        low, high = np.sort(rank[pairs], axis=1).T
        step = np.bincount(low, weight, count) - np.bincount(high, weight, count)
        crossed = np.cumsum(step)[least - 1 : count - least]
        middle = np.abs(np.arange(least, count - least + 1) - count / 2)
        cost = crossed * (1 + middle / count) + 1e-9 * middle
        if cost.min() < best:
            best, cut, line = cost.min(), least + int(cost.argmin()), column
    rank[line] = np.arange(count)
    side = rank[pairs] < cut
    parts = []
    for half, of in ((line[:cut], side.all(axis=1)), (line[cut:], ~side.any(axis=1))):
        parts.append(_bisect(half, pairs[of], weight[of], keys, rank))
    return tuple(parts)
