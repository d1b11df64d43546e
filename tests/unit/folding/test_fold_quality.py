"""Quality measures on sheets whose answer is known."""

import math

import numpy as np
import pytest

from folding_cases import skewed_sheet
from foldshell.folding.intersections import find_intersections
from foldshell.folding.quality import (
    count_flipped,
    find_convex,
    measure_coverage,
    measure_edge_ratio,
    measure_planarity,
)
from foldshell.pattern.angles import measure_folds
from foldshell.pattern.miura import Miura, folded_vertices


def test_planarity_of_a_warped_square():
    """Unit square, one corner lifted by h: diagonals' lines lie h / sqrt(4 + h2/2...) apart."""
    height = 0.2
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, height], [0, 1, 0.0]])
    # Lines (0,0,0)+s(1,1,h) and (1,0,0)+t(-1,1,0): normal (-h, -h, 2), distance h/sqrt(4+2h2).
    exact = height / math.sqrt(4 + 2 * height**2)
    mean = (math.sqrt(2 + height**2) + math.sqrt(2)) / 2
    quads = np.array([[0, 1, 2, 3]])
    assert measure_planarity(corners, quads)[0] == pytest.approx(exact / mean, rel=1e-14)


def test_flipped_folds_are_counted():
    pattern = Miura(1.0, 1.2, 1.0, 5, 6)
    vertices = folded_vertices(pattern, 0.7)
    grid = pattern.grid
    assert count_flipped(measure_folds(vertices, grid), grid) == 0
    upside_down = vertices * [1, 1, -1]
    creases = np.isin(grid.assignments, ["M", "V"]).sum()
    assert count_flipped(measure_folds(upside_down, grid), grid) == creases
    vertices[2 * 6 + 2, 2] += 1.2  # one valley vertex pushed above its neighbours
    assert 0 < count_flipped(measure_folds(vertices, grid), grid) < creases


def test_intersections_are_found_in_any_pose():
    """Two crossing triangles, one touching, one apart; turned, moved and renumbered."""
    points = np.array(
        [[0, 0, 0], [2, 0, 0], [0, 2, 0],  # base
         [0.5, 0.5, -1], [0.5, 0.5, 1], [3, 3, 0.5],  # pierces the base
         [2, 2, 1], [3, 2, 1], [2, 3, 1.0]]  # apart
    )  # fmt: skip
    facets = np.array([[0, 1, 2], [3, 4, 5], [6, 7, 8]])
    rng = np.random.default_rng(5)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    order = rng.permutation(9)
    place = np.argsort(order)
    moved = (points @ turn.T + 3.0)[order]
    pairs = find_intersections(moved, place[facets][[2, 0, 1]])
    assert [sorted(pair) for pair in pairs.tolist()] == [[1, 2]]


def test_miura_path_never_cuts_itself_and_a_pushed_vertex_does():
    pattern = Miura(1.0, 1.2, 1.0, 6, 7)
    for angle in (0.0, 0.4, 1.2, 1.5):
        vertices = folded_vertices(pattern, angle)
        assert len(find_intersections(vertices, pattern.grid.facets)) == 0
    vertices = folded_vertices(pattern, 1.2)
    vertices[2 * 7 + 3] += [0.1, 1.5 * (vertices[7, 1] - vertices[0, 1]), 0.7]
    assert len(find_intersections(vertices, pattern.grid.facets)) > 0


def test_facets_that_share_a_vertex_can_cut_each_other():
    points = np.array([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0.5, 0.6, -1], [0.6, 0.5, 1.0]])
    assert len(find_intersections(points, np.array([[0, 1, 2], [0, 3, 4]]))) == 1


def test_coverage_of_a_part_of_the_plan():
    """Two facets over x in [-2, 1] of a plan of side 4: three quarters, to one sample row."""
    corners = np.array([[-3, -3, 0], [1, -3, 5], [1, 3, 2], [-3, 3, 0.0]])
    facets = np.array([[0, 1, 2], [0, 3, 2]])  # the second one seen from below
    assert measure_coverage(corners, facets, 4.0) == pytest.approx(0.75, abs=1 / 200)


def test_convexity_and_edge_ratio():
    points = np.array([[0, 0, 0], [4, 0, 0], [4, 1, 0], [0, 1, 0], [0.5, 0.4, 0.0]])
    quads = np.array([[0, 1, 2, 3], [0, 1, 4, 3]])
    assert find_convex(points, quads).tolist() == [True, False]
    assert measure_edge_ratio(points, quads[:1])[0] == pytest.approx(4)
    turned = points @ np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    assert find_convex(turned, quads).tolist() == [True, False]


def test_hinge_angles_do_not_depend_on_the_pose():
    sheet, vertices = skewed_sheet()
    turn, _ = np.linalg.qr(np.random.default_rng(9).normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    folds = measure_folds(vertices, sheet.grid)
    assert np.abs(folds).max() > 0.5
    assert measure_folds(vertices @ turn.T + 2, sheet.grid) == pytest.approx(folds, abs=1e-12)
