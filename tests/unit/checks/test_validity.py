"""Validity of a model: widths, radii and support runs against known ones, and each bound both ways.

Bounds and their sources stand in `foldshell.checks.validity`.
"""

from dataclasses import replace

import numpy as np
import pytest

from foldshell.checks.validity import (
    ModelState,
    find_support_runs,
    fit_radii,
    list_warnings,
    measure_form_radii,
    measure_widths,
)
from foldshell.pattern.miura import Miura, folded_vertices
from foldshell.shell.mesh import build_mesh
from shell_cases import random_rotation

P, S = 30, 6
GOOD = ModelState(
    thickness=np.full(P, 0.1),
    width=np.full(P, 2.0),
    radius=np.full(P, 20.0),
    span=28.0,
    displacement=0.1,
    reactions=np.ones((S, 3, 2)),
    nodes=np.arange(3.0 * S).reshape(S, 3),
    runs=np.repeat([0, 1], S // 2),
)


def _mesh(vertices, grid, seed=1, subdivisions=8):
    """Mesh of a sheet, turned in space, with renumbered vertices."""
    number = np.random.default_rng(seed).permutation(len(vertices))
    turned = np.empty_like(vertices)
    turned[number] = vertices @ random_rotation(seed)
    panel = np.arange(len(grid.facets)) // 2
    return build_mesh(turned, number[grid.facets], panel, subdivisions)


@pytest.mark.parametrize("subdivisions", [4, 8])
def test_width_of_a_panel_is_its_area_over_its_longest_side(subdivisions):
    """A parallelogram of sides 1.3 and 0.7 at 60 degrees: 0.7 sin 60, however it is folded.

    At n = 8 a facet has four elements, whose own corners must not count.
    """
    pattern = Miura(1.3, 0.7, np.radians(60), 5, 6)
    mesh = _mesh(folded_vertices(pattern, 0.7), pattern.grid, subdivisions=subdivisions)
    assert measure_widths(mesh) == pytest.approx(np.full(20, 0.7 * np.sin(np.radians(60))))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("slope", [0.0, 1.0])
def test_radius_of_a_cylinder_and_a_sphere(seed, slope):
    """Points 0.1 of the radius apart: a quadric over three of them errs by less than 3 %.

    Also where the surface is steep, on its side, and anywhere in space.
    """
    u, v = (w.ravel() for w in np.meshgrid(np.linspace(-0.5, 0.5, 11), np.linspace(-0.4, 0.4, 9)))
    cylinder = 7 * np.column_stack([np.sin(u + slope), v, np.cos(u + slope)])
    sphere = 7 * np.column_stack(
        [np.sin(u + slope) * np.cos(v), np.sin(v), np.cos(u + slope) * np.cos(v)]
    )
    for points in (cylinder, sphere):
        moved = points @ random_rotation(seed) + [100, -50, 3]
        assert fit_radii(moved) == pytest.approx(np.full(len(points), 7.0), rel=0.03)


def test_radius_of_a_large_form_is_found_by_a_tree():
    """1,189 points of a cylinder of 7 m, 0.03 of the radius apart: errors go with the square."""
    u, v = (w.ravel() for w in np.meshgrid(np.linspace(-0.6, 0.6, 41), np.linspace(-0.4, 0.4, 29)))
    points = 7 * np.column_stack([np.sin(u), v, np.cos(u)]) @ random_rotation(5)
    assert fit_radii(points) == pytest.approx(np.full(len(points), 7.0), rel=0.005)


def test_radius_of_a_saddle_is_that_of_its_sharper_curve():
    """z = x2 / 10 - y2 / 40 at its middle: 1 / (2/10) = 5 m."""
    x, y = (w.ravel() for w in np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 9)))
    points = np.column_stack([x, y, x**2 / 10 - y**2 / 40]) @ random_rotation(4)
    assert fit_radii(points)[40] == pytest.approx(5.0, rel=1e-6)


def test_a_folded_sheet_that_is_planar_has_no_radius():
    """Zig-zags rise and fall by 0.8 m, the middles of the panels lie in a plane."""
    pattern = Miura(1.3, 0.7, np.radians(60), 7, 8)
    mesh = _mesh(folded_vertices(pattern, 0.8), pattern.grid)
    assert measure_form_radii(mesh, 42).min() > 1e6


def test_panels_of_an_edge_beam_do_not_count_for_the_form():
    pattern = Miura(1.3, 0.7, np.radians(60), 7, 8)
    mesh = _mesh(folded_vertices(pattern, 0.8), pattern.grid)
    assert len(measure_form_radii(mesh, 30)) == 30
    assert np.isinf(measure_form_radii(mesh, 5)).all()  # too few to fit


def test_support_runs_are_what_hangs_together():
    """Two opposite borders of a sheet are two runs; all four are one."""
    pattern = Miura(1.0, 1.0, np.radians(60), 5, 6)
    grid = pattern.grid
    mesh = build_mesh(folded_vertices(pattern, 0.7), grid.facets, subdivisions=8)
    ends = grid.zigzag_index[mesh.node_pairs]
    sides = grid.strip_index[mesh.node_pairs]
    on_zigzags = ((ends == 0) | (ends == 4)).all(axis=1) & (ends[:, 0] == ends[:, 1])
    border = on_zigzags | ((sides == 0) | (sides == 5)).all(axis=1) & (sides[:, 0] == sides[:, 1])
    for edges, count in ((on_zigzags, 2), (border, 1)):
        supported = np.unique(mesh.pair_nodes[edges])
        runs = find_support_runs(mesh, supported)
        assert len(runs) == len(supported) and runs.max() + 1 == count
        if count == 2:  # the first zig-zag is all in one run
            ends_of_run = {int(r) for r in runs[mesh.nodes[supported][:, 1] < 1.5]}
            assert len(ends_of_run) == 1


def test_a_good_model_has_no_warning():
    assert list_warnings(GOOD) == []
    flat = replace(GOOD, radius=np.full(P, np.inf), displacement=None, reactions=None)
    assert list_warnings(flat) == []


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("thickness", 0.21, "1 of 30 panels are thicker than 1/10 of their width, worst panel 7"),
        ("thickness", 0.024, "1 of 30 panels are thinner than 1/80 of their width, worst panel 7"),
        ("radius", 1.9, "1 of 30 panels are thicker than 1/20 of the form's radius, worst panel 7"),
        ("width", 0.9, "thicker than 1/10"),
        ("width", 8.1, "thinner than 1/80"),
    ],
)
def test_each_bound_of_a_panel_is_named_with_the_worst_one(name, value, words):
    values = getattr(GOOD, name).copy()
    values[7] = value
    (sentence,) = list_warnings(replace(GOOD, **{name: values}))
    assert words in sentence and "\n" not in sentence


@pytest.mark.parametrize(
    ("name", "value"), [("thickness", 0.2), ("thickness", 0.025), ("radius", 2.0), ("width", 1.0)]
)
def test_a_bound_itself_is_allowed(name, value):
    assert list_warnings(replace(GOOD, **{name: np.full(P, value)})) == []


def test_a_stout_edge_beam_is_named():
    """0.8 m x 300 mm is named, 0.8 m x 80 mm is at the bound and is not."""
    beam = np.array([[0.08, 0.08], [0.8, 0.8]])
    assert list_warnings(replace(GOOD, edge_beam=beam)) == []
    beam[0, 1] = 0.3
    (sentence,) = list_warnings(replace(GOOD, edge_beam=beam))
    assert "1 of 2 panels of the edge beam are thicker than 1/10" in sentence


def test_large_displacements_are_named():
    assert list_warnings(replace(GOOD, displacement=28 / 50)) == []
    (sentence,) = list_warnings(replace(GOOD, displacement=0.6))
    assert "0.6 m is more than 1/50 of the span of 28 m" in sentence


def test_a_support_that_carries_nothing_is_named_by_its_place():
    """Of two runs the second carries round-off under every combination."""
    reactions = GOOD.reactions.copy()
    reactions[3:] = 1e-9
    (sentence,) = list_warnings(replace(GOOD, reactions=reactions))
    assert sentence == "the support about [12.0, 13.0, 14.0] m carries nothing"
    reactions[4, 2, 1] = 0.1
    assert list_warnings(replace(GOOD, reactions=reactions)) == []
