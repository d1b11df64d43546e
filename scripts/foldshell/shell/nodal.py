"""Sums of element values at nodes.

Done row by row with numpy alone: a sparse matrix of ones is no faster, and importing
`scipy.sparse` would take a third of the time of a small analysis.
"""

import numpy as np

from foldshell.shell.mesh import ShellMesh


def sum_at_nodes(mesh: ShellMesh, values: np.ndarray) -> np.ndarray:
    """Sum rows of element values (r, E, n) at the nodes, (r, N)."""
    numbers, count = mesh.elements.ravel(), len(mesh.nodes)
    total = np.empty((len(values), count))
    for row, own in enumerate(values.reshape(len(values), -1)):
        total[row] = np.bincount(numbers, own, count)
    return total


def gather_forces(mesh: ShellMesh, element: np.ndarray) -> np.ndarray:
    """Sum element node forces (3, c, E, n), x, y and z, into global ones (dofs, c)."""
    columns = element.shape[1]
    total = np.zeros((mesh.dof_count, columns))
    summed = sum_at_nodes(mesh, element.reshape(3 * columns, *element.shape[2:]))
    total[: 3 * len(mesh.nodes)] = summed.T.reshape(-1, columns)
    return total
