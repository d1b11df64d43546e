"""Points, strips and shear of a plate against integrals by hand and a series."""

import numpy as np
import pytest

from foldshell.checks.concrete.envelope import find_envelope, take_means
from foldshell.checks.concrete.sampling import sample_strips, share_within
from foldshell.checks.concrete.transverse_shear import shear_coefficients
from foldshell.checks.strips import NO_EDGE, find_strips
from foldshell.shell.mesh import build_mesh
from foldshell.shell.reference import lattice_points, orthonormal_basis
from foldshell.shell.stiffness import build_operators
from foldshell.shell.stress import evaluate

TURN, _ = np.linalg.qr(np.random.default_rng(8).normal(size=(3, 3)))
TURN *= np.sign(np.linalg.det(TURN))


def make_operators(subdivisions=4):
    """One parallelogram of two facets, turned in space."""
    flat = np.array([[0.0, 0, 0], [3, 0, 0], [0.8, 2, 0], [3.8, 2, 0]]) @ TURN.T
    mesh = build_mesh(flat, np.array([[0, 1, 3], [0, 3, 2]]), np.array([0, 0]), subdivisions)
    return build_operators(mesh, 0.2)


def test_share_of_a_triangle_within_a_distance():
    """A triangle with distances 0, 0, 1: within w lies 1 - (1 - w)^2; with 0, 1, 1 it is w^2."""
    for width in (0.0, 0.3, 0.8, 1.0, 2.0):
        clipped = min(width, 1.0)
        found = share_within(np.array([0.0, 0, 1, 1, 0, 1]), width)
        assert found == pytest.approx([1 - (1 - clipped) ** 2, clipped**2])


@pytest.mark.parametrize("subdivisions", [2, 4, 8])
def test_means_of_strips_are_areas_whatever_the_mesh(subdivisions):
    """Rows sum to one, and the share of a facet that a strip weighs is that of the strip."""
    operators = make_operators(subdivisions)
    strips = find_strips(operators, 0.3, True)
    sampling = sample_strips(operators, strips, 0.3)
    sums = np.asarray(sampling.means.sum(axis=1)).ravel()
    assert sums == pytest.approx(np.ones(len(strips.panel)))
    q = len(sampling.points)
    size = np.repeat(operators.geometry.area / q, q)
    covered = np.asarray((sampling.means / sampling.means.max(axis=1).toarray()).sum(axis=1))
    assert (covered.ravel() * size.max() >= strips.area - 1e-9).all()
    assert (sampling.diagonal == (strips.edge == [0, 3]).all(axis=1)).all()


def test_bars_run_along_the_first_border_in_every_facet():
    operators = make_operators()
    strips = find_strips(operators, 0.3, True)
    sampling = sample_strips(operators, strips, 0.3)
    frame = operators.geometry.frame
    along = (
        np.cos(sampling.angle)[:, None] * frame[:, 0]
        + np.sin(sampling.angle)[:, None] * frame[:, 1]
    )
    assert along == pytest.approx(np.broadcast_to(TURN[:, 0], along.shape))


def test_envelope_names_row_and_combination():
    panel = np.array([0, 1, 0, 1, 2])
    means = np.zeros((5, 2, 1))
    means[2, 1], means[1, 0] = 3.0, 2.0
    means[4] = -1
    found = find_envelope(panel, means, 3)
    assert found.value[:, 0].tolist() == [3, 2, 0]
    assert found.row[:2, 0].tolist() == [2, 1]
    assert found.combination[:2, 0].tolist() == [1, 0]


def test_mean_of_a_constant_is_the_constant():
    operators = make_operators()
    strips = find_strips(operators, 0.3)
    sampling = sample_strips(operators, strips, 0.3)
    values = np.full((len(operators.geometry.area), len(sampling.points), 2, 3), 7.0)
    assert take_means(sampling, values) == pytest.approx(7.0)
    assert (strips.edge[strips.facet >= 0][:2] == NO_EDGE).all()


def test_shear_is_the_divergence_of_polynomial_moments():
    """m_xx = x^2 y, m_yy = y^3, m_xy = x y: v_x = 2 x y + x, v_y = y + 3 y^2, in each element's
    own axes; exact, since moments have degree 4 at n = 4: round-off."""
    operators = make_operators()
    mesh, order = operators.mesh, operators.mesh.order
    lattice = lattice_points(order - 1)
    inverse = np.linalg.inv(operators.geometry.inverse)
    x, y = np.einsum("exk,qk->xeq", inverse, lattice)
    values = np.stack([x * x * y, y**3, x * y], axis=1)
    basis = np.linalg.inv(orthonormal_basis(order - 1, lattice))
    moment = np.einsum("mq,esq->esm", basis, values)[..., None]
    found = evaluate(operators, shear_coefficients(operators, moment), lattice)[:, :, 0]
    assert found[..., 0] == pytest.approx(2 * x * y + x, abs=1e-10)
    assert found[..., 1] == pytest.approx(y + 3 * y * y, abs=1e-10)
    assert mesh.order == 5
