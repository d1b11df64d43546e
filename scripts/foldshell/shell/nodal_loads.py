"""Surface loads as nodal forces of the mesh."""

import numpy as np

from foldshell.shell.reference import reference_triangle
from foldshell.shell.stiffness import ShellOperators


def nodal_forces(operators: ShellOperators, surface: np.ndarray) -> np.ndarray:
    """Return int N^T q dA for uniform loads q (E, 3, c) kN/m2, as (dofs, c) kN."""
    mesh = operators.mesh
    shape = reference_triangle(mesh.order).load
    element = (operators.geometry.area[:, None] * shape)[:, :, None, None] * surface[:, None]
    forces = np.zeros((mesh.dof_count, surface.shape[2]))
    nodes = mesh.elements.ravel()
    for direction in range(3):
        for case in range(surface.shape[2]):
            values = element[:, :, direction, case].ravel()
            total = np.bincount(nodes, values, len(mesh.nodes))
            forces[direction : 3 * len(mesh.nodes) : 3, case] = total
    return forces
