"""Patch tests, rigid motions and invariances of the shell element.

Tolerances are 1e-9 of the largest term: round-off of matrices with entries of 1e3.
"""

import numpy as np
import pytest

from foldshell.shell.mesh import build_mesh, edge_polyline_nodes, rotation_dofs, translation_dofs
from foldshell.shell.reference import EDGES
from foldshell.shell.stiffness import build_operators
from foldshell.shell.stress import stress_resultants
from shell_cases import dense_stiffness, edge_rotations, folded_strip, random_rotation, skewed_patch

ORDERS = [1, 2, 3, 5]
NU = 0.3


def rigid_modes(mesh) -> np.ndarray:
    """Return the six rigid motions (dofs, 6): edge rotations follow the rotation vector."""
    modes = []
    for axis in range(3):
        move = np.zeros((len(mesh.nodes), 3))
        move[:, axis] = 1
        modes.append(np.concatenate([move.ravel(), np.zeros(mesh.edge_count * mesh.order)]))
    for axis in range(3):
        spin = np.eye(3)[axis]
        move = np.cross(spin, mesh.nodes)
        edges = edge_rotations(mesh, lambda x, spin=spin: np.broadcast_to(spin, x.shape))
        modes.append(np.concatenate([move.ravel(), edges.ravel()]))
    return np.array(modes).T


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_membrane_patch(order, seed):
    """A linear in-plane displacement gives its constant strain and balances inside."""
    mesh, frame = skewed_patch(seed, order)
    operators = build_operators(mesh, NU)
    gradient = np.array([[1.0, 0.4], [-0.7, 0.6]])
    local = (mesh.nodes @ frame.T)[:, :2] @ gradient.T
    displacement = np.zeros(mesh.dof_count)
    displacement[: 3 * len(mesh.nodes)] = (local @ frame[:2]).ravel()
    displacement[3 * len(mesh.nodes) :] = 0
    thickness = np.full(len(mesh.elements), 0.2)
    found = stress_resultants(operators, displacement[:, None], thickness, 7.0)
    strain = np.array([1.0, 0.6, 0.4 - 0.7])
    exact = 0.2 * 7.0 * operators.elasticity @ strain
    tensor = np.array([[exact[0], exact[2]], [exact[2], exact[1]]])
    axes = np.einsum("eax,bx->eab", operators.geometry.frame[:, :2], frame[:2])
    turned = np.einsum("eab,bc,edc->ead", axes, tensor, axes)
    force = found.force[:, :, :, 0]
    assert force[:, 0, 0] == pytest.approx(turned[:, 0, 0], abs=1e-9)
    assert force[:, 1, 0] == pytest.approx(turned[:, 1, 1], abs=1e-9)
    assert force[:, 2, 0] == pytest.approx(turned[:, 0, 1], abs=1e-9)
    assert force[:, :, 1:] == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("order", [2, 3, 5])
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_bending_patch(order, seed):
    """A quadratic deflection with its edge rotations gives its constant moment, and no jump."""
    mesh, frame = skewed_patch(seed, order)
    operators = build_operators(mesh, NU)
    hessian = np.array([[1.0, 0.35], [0.35, -0.8]])
    plane = lambda x: x @ frame[:2].T  # noqa: E731
    deflection = 0.5 * np.einsum("na,ab,nb->n", plane(mesh.nodes), hessian, plane(mesh.nodes))
    # a deflection w along the normal turns a material line by grad w x normal
    spin = lambda x: np.cross(plane(x) @ hessian @ frame[:2], frame[2])  # noqa: E731
    displacement = np.concatenate(
        [(deflection[:, None] * frame[2]).ravel(), edge_rotations(mesh, spin).ravel()]
    )
    thickness = np.full(len(mesh.elements), 0.2)
    found = stress_resultants(operators, displacement[:, None], thickness, 7.0)
    curvature = np.array([hessian[0, 0], hessian[1, 1], 2 * hessian[0, 1]])
    exact = 7.0 * 0.2**3 / 12 * operators.elasticity @ curvature
    tensor = np.array([[exact[0], exact[2]], [exact[2], exact[1]]])
    axes = np.einsum("eax,bx->eab", operators.geometry.frame[:, :2], frame[:2])
    turned = np.einsum("eab,bc,edc->ead", axes, tensor, axes)
    moment = found.moment[:, :, :, 0]
    assert moment[:, 0, 0] == pytest.approx(turned[:, 0, 0], abs=1e-11)
    assert moment[:, 1, 0] == pytest.approx(turned[:, 1, 1], abs=1e-11)
    assert moment[:, 2, 0] == pytest.approx(turned[:, 0, 1], abs=1e-11)
    assert moment[:, :, 1:] == pytest.approx(0, abs=1e-10)
    assert found.jump == pytest.approx(0, abs=1e-10)


@pytest.mark.parametrize("order", [2, 3, 5])
def test_patch_is_solved_exactly_from_its_boundary(order):
    """Prescribing a constant-strain, constant-curvature field on the border yields it inside."""
    mesh, frame = skewed_patch(7, order)
    operators = build_operators(mesh, NU)
    plane = lambda x: x @ frame[:2].T  # noqa: E731
    hessian = np.array([[0.5, -0.2], [-0.2, 0.9]])
    gradient = np.array([[0.3, -0.1], [0.2, -0.4]])
    deflection = 0.5 * np.einsum("na,ab,nb->n", plane(mesh.nodes), hessian, plane(mesh.nodes))
    move = deflection[:, None] * frame[2] + plane(mesh.nodes) @ gradient.T @ frame[:2]
    spin = lambda x: np.cross(plane(x) @ hessian @ frame[:2], frame[2])  # noqa: E731
    exact = np.concatenate([move.ravel(), edge_rotations(mesh, spin).ravel()])
    stiffness = dense_stiffness(operators, 0.2)
    border = np.bincount(mesh.element_edges.ravel(), minlength=mesh.edge_count) == 1
    ends = np.sort(mesh.corners[:, EDGES], axis=2).reshape(-1, 2)
    pairs = ends[border[mesh.element_edges.ravel()]]
    held = np.union1d(
        translation_dofs(edge_polyline_nodes(mesh, pairs)),
        rotation_dofs(mesh, np.flatnonzero(border)),
    )
    free = np.setdiff1d(np.arange(mesh.dof_count), held)
    found = exact.copy()
    found[free] = np.linalg.solve(
        stiffness[np.ix_(free, free)], -stiffness[np.ix_(free, held)] @ exact[held]
    )
    assert len(free) > 0
    assert found == pytest.approx(exact, abs=1e-9)


@pytest.mark.parametrize("order", [2, 3, 5])
@pytest.mark.parametrize("kind", ["flat", "folded"])
def test_six_zero_modes_and_they_are_the_rigid_motions(order, kind):
    mesh = skewed_patch(2, order)[0] if kind == "flat" else folded_strip(4, order - 1)
    stiffness = dense_stiffness(build_operators(mesh, NU), 0.2)
    values = np.linalg.eigvalsh(stiffness)
    assert np.abs(values[:6]).max() < 1e-11 * values[-1]
    assert values[6] > 1e-8 * values[-1]
    force = stiffness @ rigid_modes(mesh)
    assert np.abs(force).max() < 1e-10 * np.abs(stiffness).max() * np.abs(mesh.nodes).max()


def test_energy_does_not_depend_on_orientation_or_numbering():
    plain = folded_strip(0, 2)
    turn = random_rotation(3)
    rng = np.random.default_rng(1)
    renumber = rng.permutation(6)
    points = np.empty((6, 3))
    points[renumber] = plain.nodes[:6] @ turn
    facets = renumber[np.array([[1, 3, 0], [3, 2, 0], [5, 2, 3], [2, 5, 4]])]
    moved = build_mesh(points, facets, subdivisions=2)
    one = np.linalg.eigvalsh(dense_stiffness(build_operators(plain, NU), 0.1))
    two = np.linalg.eigvalsh(dense_stiffness(build_operators(moved, NU), 0.1))
    # eigenvalues depend on the basis of edge rotations only by signs, so they agree
    assert two == pytest.approx(one, abs=1e-10 * one[-1])


def test_thickness_scales_membrane_and_bending_apart():
    mesh = folded_strip(2, 2)
    operators = build_operators(mesh, NU)
    width = operators.membrane.shape[1]
    thin, thick = dense_stiffness(operators, 0.1), dense_stiffness(operators, 0.3)
    assert operators.bending.shape[1] > width
    bending = (thick - 3 * thin) / (0.3**3 - 3 * 0.1**3)
    membrane = (thick - 27 * thin) / (0.3 - 27 * 0.1)
    assert 0.2 * membrane + 0.2**3 * bending == pytest.approx(
        dense_stiffness(operators, 0.2), abs=1e-10
    )


def test_a_facet_without_area_is_refused():
    points = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0.0]])
    with pytest.raises(ValueError, match=r"facet 1 at .* has no area"):
        build_mesh(points, np.array([[0, 1, 3], [0, 1, 2]]))
