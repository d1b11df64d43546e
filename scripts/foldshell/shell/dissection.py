"""Nested dissection by place: an order of little fill for large meshes.

The sheet is cut in two where the cut passes the fewest freedoms, each part again, and so on; what
lies on a cut comes after all that it parts (George 1973). Cuts pass between panels, so that they
run along folds: a cut by the places of elements passes through many panels along their diagonals,
and is twice as long.
"""

from dataclasses import dataclass

import numpy as np

LEAST_SHARE = 0.3
"""Of a part's elements that either side of a cut has."""

ROWS, BINS = 4, 60
"""Directions of rows that are looked for, and parts of half a turn in which they are counted."""

LEAF = 4
"""Units of a part, on the mean, that is cut no further."""


@dataclass(frozen=True)
class _Reach:
    """The units (k,) that touch each group that is not yet on a cut, group by group.

    `first` is where each of the `groups` (g,) begins.
    """

    unit: np.ndarray
    groups: np.ndarray
    first: np.ndarray

    def extremes(self, place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the least and the largest place (U,) among the units of each group (g,)."""
        own = place[self.unit]
        return np.minimum.reduceat(own, self.first), np.maximum.reduceat(own, self.first)

    def without(self, done: np.ndarray) -> "_Reach":
        """Leave out groups, (g,) bool."""
        length = np.diff(np.append(self.first, len(self.unit)))
        left = length[~done]
        first = np.concatenate([[0], np.cumsum(left)[:-1]]).astype(np.int64)
        return _Reach(self.unit[np.repeat(~done, length)], self.groups[~done], first)


def rank_by_dissection(
    groups: np.ndarray, size: np.ndarray, unit: np.ndarray, points: np.ndarray, within: np.ndarray
) -> np.ndarray:
    """Return the place (G,) of each group in an order by nested dissection.

    Parameters
    ----------
    groups : (E, 7) groups of each element, which all are joined with each other
    size : (G,) freedoms of a group
    unit : (E,) unit of each element that cuts leave whole, from 0 on
    points : (E, 3) m, the place of each element
    within : (G,) order of the groups of an uncut part, and of those on the same cut
    """
    count = np.maximum(np.bincount(unit), 1)
    centre = np.stack([np.bincount(unit, axis) / count for axis in points.T])
    reach = _find_reach(groups, unit)
    ways = _list_ways(centre, reach)
    part, levels = np.zeros(len(count), dtype=np.int64), 0
    own = np.zeros(len(size), dtype=np.int64), np.zeros(len(size), dtype=np.int64)
    while len(reach.groups) and len(count) > LEAF << levels:
        part = _cut_parts(part, reach, size, count, ways)
        levels += 1
        low, high = reach.extremes(part)
        parted = low != high
        # on a cut of this level: after the whole of the part that was cut
        own[0][reach.groups[parted]] = low[parted] >> 1
        own[1][reach.groups[parted]] = levels
        reach = reach.without(parted)
    rest = reach.extremes(part)[0] if len(reach.groups) else reach.groups
    own[0][reach.groups] = rest
    own[1][reach.groups] = levels + 1
    return _rank_from_tree(*own, levels, within)


def _rank_from_tree(
    part: np.ndarray, level: np.ndarray, levels: int, within: np.ndarray
) -> np.ndarray:
    """Return the place of groups that belong to parts of levels: a part after all it holds."""
    finer = levels + 1 - level
    end = ((part + 1) << finer) - 1
    order = np.lexsort([within, finer, end])
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return rank


def _find_reach(groups: np.ndarray, unit: np.ndarray) -> _Reach:
    """Return which units touch each group."""
    units = int(unit.max()) + 1
    keys = np.unique(groups.ravel() * units + np.repeat(unit, groups.shape[1]))
    group, own = np.divmod(keys, units)
    first = np.flatnonzero(np.diff(group, prepend=-1))
    return _Reach(own, group[first], first)


def _list_ways(centre: np.ndarray, reach: _Reach) -> np.ndarray:
    """Return coordinates (ways, U) m by which parts are cut: x, y, z, and across the rows of units.

    Rows run along the directions that are most frequent among lines from a unit (3, U) m to the
    next; a cut along a row passes no more sides than it must.
    """
    level = centre - centre.mean(axis=1, keepdims=True)
    plane = np.linalg.svd(level @ level.T)[0].T[:2] @ level
    length = np.diff(np.append(reach.first, len(reach.unit)))
    beside = reach.first[length == 2]
    lines = plane[:, reach.unit[beside + 1]] - plane[:, reach.unit[beside]]
    angle = np.arctan2(lines[1], lines[0]) % np.pi
    ways = list(centre)
    for _ in range(ROWS):
        if not len(angle):
            break
        often = np.bincount((angle / np.pi * BINS).astype(int) % BINS, minlength=BINS)
        middle = ((often + np.roll(often, -1)).argmax() + 1) * np.pi / BINS
        off = (angle - middle + np.pi / 2) % np.pi - np.pi / 2
        near = np.abs(off) <= 1.001 * np.pi / BINS
        turn = middle + off[near].mean()
        ways.append(np.cos(turn) * plane[1] - np.sin(turn) * plane[0])
        angle = angle[np.abs(off) > 3 * np.pi / BINS]
    return np.stack(ways)


def _cut_parts(
    part: np.ndarray, reach: _Reach, size: np.ndarray, count: np.ndarray, ways: np.ndarray
) -> np.ndarray:
    """Return the part (U,) of each unit after each part is cut across the best of the ways."""
    parts = int(part.max()) + 1
    ends = np.concatenate([[0], np.cumsum(np.bincount(part, minlength=parts))])
    least, cut = np.full(parts, np.inf), 2 * part
    for axis in ways:
        order = np.lexsort([axis, part])
        place = np.empty_like(order)
        place[order] = np.arange(len(order))
        cost = _price_cuts(order, place, part[order], ends, reach, size, count)
        best = np.minimum.reduceat(cost, ends[:-1])
        at = np.flatnonzero(cost == best[part[order]])
        where = np.empty(parts, dtype=np.int64)
        where[part[order][at[::-1]]] = at[::-1]
        better = best < least
        least = np.where(better, best, least)
        cut = np.where(better[part], 2 * part + (place >= where[part]), cut)
    return cut


def _price_cuts(order, place, part, ends, reach: _Reach, size, count) -> np.ndarray:
    """Return the freedoms on a cut before each unit of `order` (U,), over the product of the shares
    that it parts; infinite where it leaves too little on one side, and no other cut is left."""
    low, high = reach.extremes(place)
    weight, units = size[reach.groups], len(order)
    passed = np.bincount(low + 1, weight, units + 1) - np.bincount(high + 1, weight, units + 1)
    total = np.concatenate([[0], np.cumsum(count[order])])
    share = (total[:-1] - total[ends[part]]) / (total[ends[part + 1]] - total[ends[part]])
    allowed = (share >= LEAST_SHARE) & (share <= 1 - LEAST_SHARE)
    middle = (ends[:-1] + ends[1:]) // 2
    allowed[middle[np.diff(ends) > 1]] = True
    with np.errstate(divide="ignore", invalid="ignore"):
        cost = np.cumsum(passed)[:units] / (share * (1 - share))
    return np.where(allowed, cost, np.inf)
