"""Polygons in convex parts: areas add up, no part overlaps another."""

import numpy as np
import pytest
import shapely

from foldshell.loads.pieces import make_pieces, split_pieces
from foldshell.loads.polygons import split_convex

STAR = np.array([[0, 0], [4, 1], [8, 0], [7, 4], [8, 8], [4, 7], [0, 8], [3, 4.5]], dtype=float)
COMB = np.array([[0, 0], [9, 0], [9, 5], [8, 5], [8, 1], [5, 1], [5, 5], [4, 5], [4, 1], [1, 1],
                 [1, 5], [0, 5]], dtype=float)  # fmt: skip
STRAIGHT = np.array([[0, 0], [1, 0], [2, 0], [3, 0], [3, 1], [1.5, 0.4], [0, 1]], dtype=float)


TURNED = [[0.6, 0.8], [-0.8, 0.6]]


@pytest.mark.parametrize("corners", [STAR, COMB, STRAIGHT, STAR[:3], COMB @ TURNED])
@pytest.mark.parametrize("sense", [1, -1])
def test_parts_are_convex_and_cover_the_polygon(corners, sense):
    parts = [shapely.Polygon(part) for part in split_convex(corners[::sense])]
    whole = shapely.Polygon(corners)
    assert all(part.area == pytest.approx(part.convex_hull.area) for part in parts)
    assert sum(part.area for part in parts) == pytest.approx(whole.area, rel=1e-12)
    assert shapely.union_all(parts).symmetric_difference(whole).area < 1e-9


def test_a_convex_polygon_stays_whole():
    assert len(split_convex(np.array([[0, 0], [2, 0], [2, 1], [0, 1.0]]))) == 1


def test_both_sides_of_a_cut_are_the_whole():
    """Random linear functions on random triangles, corners on the line too."""
    rng = np.random.default_rng(3)
    pieces = make_pieces(np.arange(500))
    distance = rng.normal(size=(500, 3))
    distance[rng.random((500, 3)) < 0.2] = 0
    inside, outside = split_pieces(pieces, distance, 1e-12)
    both = sum(np.bincount(part.owner, part.share, 500) for part in (inside, outside))
    assert both == pytest.approx(np.ones(500), abs=1e-13)
    for part, sign in ((inside, 1), (outside, -1)):
        assert (sign * part.evaluate(distance) >= -1e-12).all()
