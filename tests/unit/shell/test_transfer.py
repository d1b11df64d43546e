"""Fields carried to a mesh of higher order."""

import numpy as np
import pytest

from foldshell.shell.analysis import build_model
from foldshell.shell.assembly import assemble_stiffness
from foldshell.shell.mesh import build_mesh
from foldshell.shell.nodal_loads import nodal_forces
from foldshell.shell.stiffness import build_operators
from foldshell.shell.transfer import has_same_elements, raise_order, transfer_modes

POINTS = np.array([[0, 0, 0], [2, 0.3, 0.1], [2.2, 1.5, 0.8], [0.1, 1.2, -0.4], [1.1, 2.6, 0.2]])
FACETS = np.array([[0, 1, 2], [0, 2, 3], [3, 2, 4]])


def folded_mesh(order, subdivisions=4):
    return build_mesh(POINTS, FACETS, subdivisions=subdivisions, order=order)


@pytest.mark.parametrize("subdivisions", [4, 8])
def test_a_polynomial_field_is_itself_at_more_points(subdivisions):
    """Displacements that are a polynomial of degree 4 in x, y, z, skewed facets, two elements."""
    low, high = folded_mesh(4, subdivisions), folded_mesh(7, subdivisions)
    assert has_same_elements(low, high)

    def place(mesh):
        x, y, z = mesh.nodes.T
        values = np.stack([x**4 - y * z**2, x * y * z + 1, (x - 2 * z) ** 3], axis=1)
        field = np.zeros((mesh.dof_count, 1))
        field[: 3 * len(mesh.nodes), 0] = values.ravel()
        return field

    moved = raise_order(low, high, place(low))
    count = 3 * len(high.nodes)
    assert moved[:count] == pytest.approx(place(high)[:count], abs=1e-9)


def test_the_energy_of_a_field_stays():
    """u^T K u under a uniform load, to the mesh error of moments: rotations are carried too, or
    slopes would jump at edges and the energy be many times as high."""
    low, high = folded_mesh(4), folded_mesh(6)
    energies, field = [], None
    for mesh in (low, high):
        model = build_model(mesh, np.array([0, 1, 3]), 0.2)
        if field is None:
            down = np.tile([[[0.0], [0.0], [-1.0]]], (len(mesh.elements), 1, 1))[:, None]
            force = nodal_forces(model.operators, down)[model.pattern.dofs]
            field = np.zeros((mesh.dof_count, 1))
            field[model.pattern.dofs] = solve(model, force)
        else:
            field = raise_order(low, mesh, field)
        own = field[model.pattern.dofs][:, 0]
        energies.append(own @ multiply(model, own))
    assert energies[1] == pytest.approx(energies[0], rel=0.1)


def values_of(model):
    thickness = np.full(len(model.mesh.elements), 0.1)
    return assemble_stiffness(model.operators, model.pattern, thickness, 1.0)


def solve(model, force):
    from foldshell.shell.linear_solver import factorise

    return factorise(model.pattern, values_of(model)).solve(force)


def multiply(model, vector):
    from scipy.sparse import csc_array, tril

    pattern, size = model.pattern, model.pattern.size
    lower = csc_array((values_of(model), pattern.indices, pattern.indptr), (size, size))
    return (lower + tril(lower, -1).T) @ vector


def test_meshes_of_other_elements_have_nothing_to_carry():
    one, other = (build_model(folded_mesh(5, n), np.array([0, 1, 3]), 0.2) for n in (4, 8))
    modes = np.ones((one.pattern.size, 2))
    assert transfer_modes(one, other, modes) is None
    assert build_operators(one.mesh, 0.2).mesh is one.mesh
