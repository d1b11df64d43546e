"""Patch tests and zero modes on skewed facets, turned in space.

Exact: fields that are linear (membrane) or quadratic with constant curvature (plate) belong to
the element's space, so inner nodes are in balance and strains are constant, to rounding.
"""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from crosscheck.discretisation import discretise
from crosscheck.element import build_plane_elasticity
from crosscheck.facet import condense_facets
from crosscheck.stress import compute_strains
from crosscheck.system import (
    Section,
    compute_element_matrices,
    join_fields,
    turn_stiffness,
)
from crosscheck_models import assemble_skeleton

TURN = Rotation.from_euler("zyx", [0.7, -0.4, 1.1]).as_matrix()
PLANE = np.array([[0, 0, 0], [2, 0.3, 0], [2.4, 1.9, 0], [-0.3, 1.5, 0], [0.9, 0.8, 0]])
FACETS = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])


def hold_nothing(mesh):
    return np.zeros((mesh.skeleton, 3), bool)


def build_patch(m, fold=0.0):
    vertices = PLANE.copy()
    vertices[4, 2] = fold
    return discretise(vertices @ TURN.T + [3, -2, 5], FACETS, hold_nothing, m)


def build_section(shear_factor=100.0):
    return Section(np.full(4, 0.4), 30e6, 0.2, shear_factor)


def sample_field(grid, displacement, slope):
    """Local nodal values of a field given in the patch's own axes: u (3,) and w's gradient."""
    at = (grid.mesh.nodes[grid.mesh.facet_nodes] - [3, -2, 5]) @ TURN
    axes = grid.axes @ TURN  # facet axes seen in the patch's axes
    moved = np.einsum("fij,frj->fri", axes, displacement(at))
    bend = -np.einsum("fij,frj->fri", axes[:, :2, :2], slope(at))
    return np.concatenate([moved, bend], axis=2)


def find_unbalance(grid, local):
    """Largest force on an inner node over the largest force inside an element."""
    inside = []
    for part, dofs in zip(
        compute_element_matrices(grid, build_section()), ([0, 1], [2, 3, 4]), strict=True
    ):
        at = local[:, grid.elements][..., dofs].reshape(*part.shape[:-1], 1)
        inside.append((part @ at).reshape(*part.shape[:-2], 9, len(dofs)))
    force = np.concatenate(inside, axis=-1)
    total = np.zeros((len(grid.mesh.nodes), 6))
    node = grid.mesh.facet_nodes[:, grid.elements]
    turn = np.swapaxes(grid.axes, 1, 2)[:, None, None, None]
    np.add.at(total, (node, slice(0, 3)), (turn @ force[..., :3, None])[..., 0])
    np.add.at(total, (node, slice(3, 5)), (turn[..., :2] @ force[..., 3:, None])[..., 0][..., :2])
    border = np.unique(
        grid.mesh.edge_nodes[[set(e.tolist()) <= {0, 1, 2, 3} for e in grid.mesh.edges]]
    )
    inner = np.setdiff1d(np.arange(len(total)), border)
    return np.abs(total[inner, :3]).max() / np.abs(force).max(), np.abs(
        total[inner, 3:]
    ).max() / np.abs(force).max()


@pytest.mark.parametrize("m", [1, 2, 3])
def test_membrane_patch(m):
    grid = build_patch(m)
    gradient = np.array([[1.0, 0.4, 0], [-0.2, 0.7, 0], [0, 0, 0]]) * 1e-3
    local = sample_field(grid, lambda x: x @ gradient.T, lambda x: 0 * x[..., :2])
    assert find_unbalance(grid, local)[0] < 1e-12
    strain, curvature = compute_strains(grid, local)
    axes = grid.axes[:, :2] @ TURN
    exact = np.einsum("fij,jk,flk->fil", axes, gradient, axes)
    exact = np.stack([exact[:, 0, 0], exact[:, 1, 1], exact[:, 0, 1] + exact[:, 1, 0]], axis=-1)
    np.testing.assert_allclose(
        strain, np.broadcast_to(exact[:, None, None, None], strain.shape), atol=1e-14
    )
    assert np.abs(curvature).max() == 0


@pytest.mark.parametrize("m", [1, 2, 3])
def test_bending_patch(m):
    grid = build_patch(m)
    bend = np.array([[0.8, 0.3], [0.3, -0.5]]) * 1e-3

    def deflection(x):
        w = np.einsum("...i,ij,...j->...", x[..., :2], bend, x[..., :2]) / 2
        return np.concatenate([np.zeros_like(x[..., :2]), w[..., None]], axis=-1)

    local = sample_field(grid, deflection, lambda x: x[..., :2] @ bend)
    assert max(find_unbalance(grid, local)) < 1e-9  # rounding of a stiff shear
    axes = (grid.axes[:, :2] @ TURN)[..., :2]
    exact = -np.einsum("fij,jk,flk->fil", axes, bend, axes)
    exact = np.stack([exact[:, 0, 0], exact[:, 1, 1], 2 * exact[:, 0, 1]], axis=-1)
    curvature = compute_strains(grid, local)[1]
    np.testing.assert_allclose(
        curvature, np.broadcast_to(exact[:, None, None, None], curvature.shape), atol=1e-13
    )


def condense_patch(grid, section):
    fields = [
        condense_facets(part, grid.mesh.reference)[0]
        for part in compute_element_matrices(grid, section)
    ]
    return turn_stiffness(join_fields(*fields), grid.turn)


@pytest.mark.parametrize("fold", [0.0, 0.6, 1e-3])
def test_a_free_patch_has_six_zero_modes(fold):
    """Flat, folded, and nearly flat: no mechanism beside the rigid motions, no false stiffness.

    Scaled by the diagonal, the seventh eigenvalue of these patches is above 1e-8.
    """
    grid = build_patch(2, fold)
    matrix = assemble_skeleton(condense_patch(grid, build_section()), grid.equations, grid.size)
    dense = matrix.toarray()
    root = np.sqrt(np.diag(dense))
    values = np.linalg.eigvalsh(dense / root[:, None] / root)
    assert np.abs(values[:6]).max() < 1e-11
    assert values[6] > 1e-9


def test_elasticity_of_plane_stress():
    stiff = build_plane_elasticity(0.25)
    np.testing.assert_allclose(
        np.linalg.inv(stiff), [[1, -0.25, 0], [-0.25, 1, 0], [0, 0, 2.5]], atol=1e-15
    )
