"""The tree of halves that guides the elimination: complete, balanced, few unknowns shared."""

import numpy as np
import pytest

from crosscheck.bisection import bisect


def zigzag_strip(columns, rows, sway):
    """Unknowns and centres of a grid of squares whose columns sway, one unknown per edge."""
    number = {}
    place, centres = [], []
    for i in range(columns):
        for j in range(rows):
            sides = [(i, j, 0), (i, j, 1), (i + 1, j, 0), (i, j + 1, 1)]
            place.append([number.setdefault(side, len(number)) for side in sides])
            centres.append([i + sway * (j % 2), j, 0.0])
    return np.array(place), np.array(centres)


def flatten(tree):
    return [tree] if isinstance(tree, int) else flatten(tree[0]) + flatten(tree[1])


def depth(tree):
    return 0 if isinstance(tree, int) else 1 + max(depth(half) for half in tree)


@pytest.mark.parametrize(("columns", "rows"), [(1, 1), (1, 2), (3, 1), (12, 7)])
def test_every_facet_stands_in_the_tree_once(columns, rows):
    place, centres = zigzag_strip(columns, rows, 0.4)
    tree = bisect(place, centres)
    assert sorted(flatten(tree)) == list(range(columns * rows))
    # halves of 35 % at least: the larger one is 65 % of what it is cut from
    assert depth(tree) <= np.ceil(np.log(max(columns * rows, 2)) / np.log(1 / 0.65)) + 1


def test_a_zigzag_is_cut_straight():
    """Columns that sway by two and a half squares, 20 x 8: the shortest cut shares 8 edges.

    A cut at the median of the centres runs along the sway and shares more.
    """
    place, centres = zigzag_strip(20, 8, 2.5)
    first, second = (set(place[flatten(half)].ravel()) for half in bisect(place, centres))
    assert len(first & second) == 8
    order = np.argsort(centres[:, 0], kind="stable")
    plain = [set(place[half].ravel()) for half in (order[:80], order[80:])]
    assert len(plain[0] & plain[1]) > 16


def test_parts_without_contact_are_allowed():
    tree = bisect(np.array([[0, 1], [2, -1], [3, 4]]), np.zeros((3, 3)))
    assert sorted(flatten(tree)) == [0, 1, 2]
