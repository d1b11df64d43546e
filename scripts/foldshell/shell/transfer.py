"""A field of one mesh on another one of the same elements and a higher order, exactly."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from foldshell.shell.mesh import ShellMesh
from foldshell.shell.reference import lagrange_basis, lattice_indices

if TYPE_CHECKING:
    from foldshell.shell.analysis import ShellModel


def transfer_modes(own: ShellModel, other: ShellModel, modes: np.ndarray) -> np.ndarray | None:
    """Return modes (free, c) of a model as modes of another (its free, c), None where the other
    mesh has other elements. Without unit.
    """
    if not has_same_elements(own.mesh, other.mesh):
        return None
    field = np.zeros((own.mesh.dof_count, modes.shape[1]))
    field[own.pattern.free] = modes
    return raise_order(own.mesh, other.mesh, field)[other.pattern.free]


def has_same_elements(own: ShellMesh, other: ShellMesh) -> bool:
    """Tell whether two meshes differ in their order alone."""
    pairs = ((own.element_edges, other.element_edges), (own.edge_signs, other.edge_signs),
             (own.facet, other.facet))  # fmt: skip
    return other.order >= own.order and all(np.array_equal(a, b) for a, b in pairs)


def raise_order(own: ShellMesh, other: ShellMesh, field: np.ndarray) -> np.ndarray:
    """Return a field (dofs, c) in m and rad on the mesh of higher order (its dofs, c).

    Displacements are the same polynomials at more points; rotations along an edge, coefficients of
    Legendre polynomials, get zeros for those of higher degree.
    """
    columns, more = field.shape[1], other.order - own.order
    points = lattice_indices(other.order)[:, 1:] / other.order
    shape = lagrange_basis(own.order, points)[0]
    moved = field[: 3 * len(own.nodes)].reshape(len(own.nodes), -1)
    total = np.zeros((other.dof_count, columns))
    places = np.empty((len(other.nodes), 3 * columns))
    places[other.elements] = np.matmul(shape, moved[own.elements])
    total[: 3 * len(other.nodes)] = places.reshape(-1, columns)
    turned = field[3 * len(own.nodes) :].reshape(own.edge_count, own.order, columns)
    padded = np.pad(turned, ((0, 0), (0, more), (0, 0)))
    total[3 * len(other.nodes) :] = padded.reshape(-1, columns)
    return total
