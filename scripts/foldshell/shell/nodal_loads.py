"""Surface loads as nodal forces of the mesh, their resultants and moments."""

import numpy as np

from foldshell.shell.placed_loads import quadrature_table
from foldshell.shell.reference import reference_triangle
from foldshell.shell.stiffness import ShellOperators


def nodal_forces(operators: ShellOperators, surface: np.ndarray) -> np.ndarray:
    """Return int N^T q dA = sum of w N q for loads q, as (dofs, c) kN.

    Parameters
    ----------
    surface : (E, Q, 3, c) kN/m2 at the points of `quadrature_table`, or (E, 3, c) or (E, 1, 3, c)
        uniform over elements
    """
    mesh = operators.mesh
    surface = surface[:, None] if surface.ndim == 3 else surface
    if surface.shape[1] == 1:
        shape = reference_triangle(mesh.order).load
        element = (operators.geometry.area[:, None] * shape)[:, :, None, None] * surface
    else:
        weights, shape, _ = quadrature_table(mesh.order)
        flat = surface.reshape(*surface.shape[:2], -1)
        element = (shape * weights[:, None]).T @ (operators.geometry.area[:, None, None] * flat)
        element = element.reshape(*element.shape[:2], *surface.shape[2:])
    forces = np.zeros((mesh.dof_count, surface.shape[3]))
    nodes = mesh.elements.ravel()
    for direction in range(3):
        for case in range(surface.shape[3]):
            values = element[:, :, direction, case].ravel()
            total = np.bincount(nodes, values, len(mesh.nodes))
            forces[direction : 3 * len(mesh.nodes) : 3, case] = total
    return forces


def mean_loads(operators: ShellOperators, surface: np.ndarray) -> np.ndarray:
    """Return the mean of loads (E, Q, 3, c) kN/m2 over each element, (E, 3, c) kN/m2."""
    if surface.shape[1] == 1:
        return surface[:, 0]
    weights = quadrature_table(operators.mesh.order)[0]
    return np.einsum("q,eqxc->exc", weights, surface)


def sum_loads(operators: ShellOperators, surface: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return resultants (3, c) kN and moments (3, c) kNm about the origin of loads (E, Q, 3, c)."""
    mesh = operators.mesh
    resultant = np.einsum("e,exk->xk", operators.geometry.area, mean_loads(operators, surface))
    force = nodal_forces(operators, surface)[: 3 * len(mesh.nodes)].reshape(len(mesh.nodes), 3, -1)
    moment = np.cross(mesh.nodes[:, :, None], force, axis=1).sum(axis=0)
    return resultant, moment
