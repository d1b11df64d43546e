"""Strips beside folds: areas and means against integrals by hand on skewed and turned panels."""

import numpy as np
import pytest

from foldshell.checks.strips import (
    NO_EDGE,
    find_strips,
    largest_of_panels,
    spread_to_coefficients,
    strip_means,
    utilization_of_strips,
)
from foldshell.settings.material import Material
from foldshell.shell.element import element_geometry
from foldshell.shell.mesh import build_mesh
from foldshell.shell.reference import lattice_points, orthonormal_basis
from foldshell.shell.stiffness import build_operators
from foldshell.shell.stress import StressResultants

LENGTH, HEIGHT, SKEW, WIDTH = 3.0, 2.0, 0.7, 0.3
TURN, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
TURN *= np.sign(np.linalg.det(TURN))


def make_operators(subdivisions=4, turn=TURN):
    """Two parallelograms side by side in one plane, each of two facets, turned in space."""
    flat = np.array([[x + SKEW * y / HEIGHT, y, 0.0] for y in (0, HEIGHT) for x in (0, 3, 6)])
    facets = np.array([[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]])
    mesh = build_mesh(flat @ turn.T, facets, np.array([0, 0, 1, 1]), subdivisions)
    return build_operators(mesh, 0.2)


def coefficients_of(operators, function):
    """Coefficients (E, 3, m, 1), in the elements' axes, of a plane tensor field f(x, y) in the
    flat axes of the sheet before it was turned; components xx, yy, xy."""
    mesh, order = operators.mesh, operators.mesh.order - 1
    lattice = lattice_points(order)
    weight = np.column_stack([1 - lattice.sum(axis=1), lattice])
    place = np.einsum("qk,ekx->eqx", weight, mesh.nodes[mesh.corners]) @ TURN
    xx, yy, xy = function(place[..., 0], place[..., 1])
    tensor = np.stack([np.stack([xx, xy], -1), np.stack([xy, yy], -1)], -2)
    local = element_geometry(mesh).frame[:, :2] @ TURN[:, :2]
    own = np.einsum("eab,eqbc,edc->eqad", local, tensor, local)
    values = np.stack([own[..., 0, 0], own[..., 1, 1], own[..., 0, 1]], axis=1)
    return np.einsum("mq,esq->esm", np.linalg.inv(orthonormal_basis(order, lattice)), values)[
        ..., None
    ]


def in_flat_axes(strips, means):
    """Means (S, 3, 1) as tensors (S, 2, 2) in the flat axes."""
    own = strips.axes[:, :2] @ TURN[:, :2]
    xx, yy, xy = means[..., 0].T
    tensor = np.stack([np.stack([xx, xy], -1), np.stack([xy, yy], -1)], -2)
    return np.einsum("sab,sac,scd->sbd", own, tensor, own)


def row_of(strips, panel, *edge):
    return int(np.flatnonzero((strips.panel == panel) & (strips.edge == sorted(edge)).all(1))[0])


@pytest.mark.parametrize("subdivisions", [1, 2, 4, 8])
def test_a_strip_is_the_part_of_the_panel_within_its_width(subdivisions):
    strips = find_strips(make_operators(subdivisions), WIDTH)
    whole = strips.edge[:, 0] == NO_EDGE
    assert strips.area[whole] == pytest.approx(LENGTH * HEIGHT / 2)
    # four edges of each panel, the diagonal left out: length times width of a parallelogram
    assert np.count_nonzero(~whole) == 8 and not strips.diagonal.any()
    low, side = row_of(strips, 0, 0, 1), row_of(strips, 0, 1, 4)
    assert strips.area[low] == pytest.approx(LENGTH * WIDTH)
    assert strips.area[side] == pytest.approx(np.hypot(SKEW, HEIGHT) * WIDTH)
    assert {tuple(e) for e in strips.edge[~whole & (strips.panel == 0)]} == {
        (0, 1), (1, 4), (3, 4), (0, 3),
    }  # fmt: skip


def test_means_are_integrals_over_the_strip():
    """f = 1 + x y + y^2 over 0 < y < w, c y < x < L + c y with c = SKEW / HEIGHT."""
    operators = make_operators()
    strips = find_strips(operators, WIDTH)
    given = coefficients_of(operators, lambda x, y: (1 + x * y + y**2, 2 * x, 3 - y))
    found = in_flat_axes(strips, strip_means(strips, given))[row_of(strips, 0, 0, 1)]
    w, c = WIDTH, SKEW / HEIGHT
    x_y = LENGTH / 2 * w / 2 + c * w**2 / 3
    assert found[0, 0] == pytest.approx(1 + x_y + w**2 / 3, rel=1e-10)
    assert found[1, 1] == pytest.approx(2 * (LENGTH / 2 + c * w / 2), rel=1e-10)
    assert found[0, 1] == pytest.approx(3 - w / 2, rel=1e-10)


def test_a_fold_has_a_strip_in_each_of_its_panels():
    operators = make_operators()
    strips = find_strips(operators, WIDTH)
    given = coefficients_of(operators, lambda x, y: (x - SKEW / HEIGHT * y, 0 * x, 0 * x))
    found = in_flat_axes(strips, strip_means(strips, given))[:, 0, 0]
    inward = WIDTH / 2 * np.hypot(SKEW, HEIGHT) / HEIGHT
    assert found[row_of(strips, 0, 1, 4)] == pytest.approx(LENGTH - inward)
    assert found[row_of(strips, 1, 1, 4)] == pytest.approx(LENGTH + inward)


@pytest.mark.parametrize("width", [0.3, 1.1, 5.0])
def test_meshes_agree_on_polynomials_that_they_hold(width):
    """Facets of one and of four elements; a width beyond the panel is the panel."""
    values = []
    for subdivisions in (4, 8):
        operators = make_operators(subdivisions)
        strips = find_strips(operators, width, diagonals=True)
        given = coefficients_of(operators, lambda x, y: (x**3 * y, x - y**3, x**2 * y**2))
        values.append(in_flat_axes(strips, strip_means(strips, given)))
    assert strips.diagonal.sum() == 4
    assert values[0] == pytest.approx(values[1], rel=1e-9, abs=1e-12)
    if width == 5.0:
        assert strips.area[strips.edge[:, 0] >= 0] == pytest.approx(LENGTH * HEIGHT)


def test_spreading_is_the_transpose_of_the_means():
    operators = make_operators(2)
    strips = find_strips(operators, WIDTH)
    random = np.random.default_rng(1)
    count, functions = len(operators.dofs), strips.weights.shape[1]
    given = random.normal(size=(count, 3, functions, 2))
    pull = random.normal(size=(len(strips.panel), 3, 2))
    there = (strip_means(strips, given) * pull).sum()
    assert (spread_to_coefficients(strips, pull, count) * given).sum() == pytest.approx(there)


def test_utilization_is_the_criterion_of_the_means():
    """Uniaxial bending m on t: sigma = 6 m / t^2 at the surface, whatever the mean of its parts."""
    operators, thickness = make_operators(2), 0.1
    strips = find_strips(operators, WIDTH)
    bending = coefficients_of(operators, lambda x, y: (2.0 + 0 * x, 0 * x, 0 * x))
    given = StressResultants(0 * bending, bending, np.zeros((len(operators.dofs), 0, 1)))
    material = Material(strength=16_700.0)
    used = utilization_of_strips(strips, given, np.full(len(operators.dofs), thickness), material)
    assert used == pytest.approx(6 * 2 / thickness**2 / 16_700)
    assert largest_of_panels(strips, used).shape == (2, 1)
