"""Geometric stiffness: what membrane forces do to the stiffness of a displaced shell.

u^T K_g v = int N_ab d_a u . d_b v dA over all three displacement components, which is the part of
the Green-Lagrange strain energy that is linear in N. It does not see a rigid translation.
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from foldshell.shell.reference import orthonormal_basis, reference_triangle, triangle_quadrature
from foldshell.shell.stiffness import ShellOperators
from foldshell.shell.stress import scatter

CHUNK = 512
"""Elements handled at once."""


@dataclass(frozen=True)
class GeometricOperator:
    """Slopes (E, Q, 2, n) of the Lagrange functions at quadrature points, psi (Q, m) there, and
    the products of quadrature weights and element areas (E, Q) m2."""

    operators: ShellOperators
    slope: np.ndarray
    psi: np.ndarray
    weight: np.ndarray


def geometric_operator(operators: ShellOperators) -> GeometricOperator:
    """Tabulate slopes at points that integrate all products of degree 3(p - 1) exactly."""
    order = operators.mesh.order
    points, weights = triangle_quadrature(3 * (order - 1))
    psi = orthonormal_basis(order - 1, points)
    reference = np.einsum("qm,kmn->qkn", psi, reference_triangle(order).gradient)
    slope = np.matmul(operators.geometry.inverse.transpose(0, 2, 1)[:, None], reference)
    return GeometricOperator(operators, slope, psi, operators.geometry.area[:, None] * weights)


def apply_geometric(
    geometric: GeometricOperator, force: np.ndarray, displacement: np.ndarray
) -> np.ndarray:
    """Return K_g(N_c) u_c for each column c: N (E, 3, m, c) kN/m and u (dofs, c) to (dofs, c)."""
    operators = geometric.operators
    count, nodes = operators.mesh.elements.shape
    columns = displacement.shape[1]
    dofs = operators.dofs[:, : 3 * nodes]
    element = np.empty((count, 3 * nodes, columns))
    for start in range(0, count, CHUNK):
        part = slice(start, start + CHUNK)
        slope = geometric.slope[part]
        size, points = slope.shape[:2]
        flat = slope.reshape(size, points * 2, nodes)
        local = displacement[dofs[part]].reshape(size, nodes, 3 * columns)
        gradient = np.matmul(flat, local).reshape(size, points, 2, 3, columns)
        at_points = np.einsum("qm,ecmk->eqck", geometric.psi, force[part], optimize=True)
        at_points *= geometric.weight[part][:, :, None, None]
        xx, yy, xy = (at_points[:, :, i, None] for i in range(3))
        flow = np.stack(
            [
                xx * gradient[:, :, 0] + xy * gradient[:, :, 1],
                xy * gradient[:, :, 0] + yy * gradient[:, :, 1],
            ],
            axis=2,
        )
        result = np.matmul(flat.transpose(0, 2, 1), flow.reshape(size, points * 2, -1))
        element[part] = result.reshape(size, 3 * nodes, columns)
    return scatter(operators, element)


def assemble_geometric(geometric: GeometricOperator, force: np.ndarray) -> list[csr_array]:
    """Return K_g of each column of N (E, 3, m, c): a matrix over nodes for x, y and z alike."""
    elements = geometric.operators.mesh.elements
    count, nodes = elements.shape
    size = len(geometric.operators.mesh.nodes)
    rows = np.repeat(elements, nodes, axis=1).ravel()
    columns = np.tile(elements, nodes).ravel()
    matrices = []
    for case in range(force.shape[3]):
        at_points = np.einsum("qm,ecm->eqc", geometric.psi, force[..., case], optimize=True)
        at_points *= geometric.weight[:, :, None]
        tensor = at_points[:, :, [[0, 2], [2, 1]]]
        flow = np.matmul(tensor, geometric.slope).reshape(count, -1, nodes)
        flat = geometric.slope.reshape(count, -1, nodes)
        values = np.matmul(flat.transpose(0, 2, 1), flow)
        matrices.append(csr_array((values.ravel(), (rows, columns)), shape=(size, size)))
    return matrices
