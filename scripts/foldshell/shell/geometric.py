"""Geometric stiffness: what membrane forces do to the stiffness of a displaced shell.

u^T K_g v = int N_ab d_a u . d_b v dA over all three displacement components, which is the part of
the Green-Lagrange strain energy that is linear in N. It does not see a rigid translation.
Slopes are taken along the two directions of the reference triangle, the same for all elements,
and N is pulled back to them.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from foldshell.shell.nodal import gather_forces
from foldshell.shell.reference import orthonormal_basis, reference_triangle, triangle_quadrature
from foldshell.shell.stiffness import ShellOperators

CHUNK = 32
"""Elements handled at once, so that temporary arrays stay in cache."""


@dataclass(frozen=True)
class GeometricTables:
    """Tables of one order that integrate products of degree 3(p - 1) exactly.

    `slope` (2Q, n) derivatives of the Lagrange functions at quadrature points, `psi` (Q, m) the
    weighted orthonormal functions there; `product` (3m, n(n+1)/2) the integrals of an orthonormal
    function times two derivatives: rr, ss, and rs with sr.
    """

    slope: np.ndarray
    psi: np.ndarray
    product: np.ndarray


@lru_cache(maxsize=8)
def geometric_tables(order: int) -> GeometricTables:
    """Tabulate the reference triangle of the given order."""
    points, weights = triangle_quadrature(3 * (order - 1))
    psi = orthonormal_basis(order - 1, points)
    slope = np.einsum("qm,kmn->kqn", psi, reference_triangle(order).gradient)
    weighted = psi * weights[:, None]
    i, j = np.tril_indices(slope.shape[2])
    r, s = slope
    pairs = np.stack([r[:, i] * r[:, j], s[:, i] * s[:, j], r[:, i] * s[:, j] + s[:, i] * r[:, j]])
    product = np.einsum("qm,kqp->kmp", weighted, pairs)
    nodes = slope.shape[2]
    return GeometricTables(slope.reshape(-1, nodes), weighted, product.reshape(-1, len(i)))


def apply_geometric(
    operators: ShellOperators, force: np.ndarray, displacement: np.ndarray
) -> np.ndarray:
    """Return K_g(N_c) u_c for each column c: N (E, 3, m, c) kN/m and u (dofs, c) to (dofs, c)."""
    mesh, columns = operators.mesh, displacement.shape[1]
    count, nodes = mesh.elements.shape
    square = _square_products(mesh.order)
    moved = displacement[: 3 * len(mesh.nodes)].reshape(-1, 3, columns).swapaxes(1, 2).copy()
    pulled = pull_back(operators, force).transpose(0, 3, 1, 2).reshape(count, columns, -1)
    element = np.empty((count, nodes, 3, columns))
    for start in range(0, count, CHUNK):
        part = slice(start, start + CHUNK)
        local = np.ascontiguousarray(moved[mesh.elements[part]].swapaxes(1, 2))
        matrices = pulled[part].reshape(-1, len(square)) @ square
        pushed = np.matmul(matrices.reshape(-1, columns, nodes, nodes), local)
        element[part] = pushed.transpose(0, 2, 3, 1)
    return gather_forces(mesh, element)


class GeometricProducts:
    """K_g of every case, kept as one matrix per element and case, which acts on x, y and z alike.

    The same as `apply_geometric` for forces that stay while vectors change.

    Parameters
    ----------
    operators : of the mesh
    force : (E, 3, m, c) kN/m
    dofs : (size,) degree of freedom of each row of the vectors; all others are zero
    """

    def __init__(self, operators: ShellOperators, force: np.ndarray, dofs: np.ndarray) -> None:
        self._mesh, self._matrices = operators.mesh, _element_matrices(operators, force)
        self._moving = np.flatnonzero(dofs < 3 * len(self._mesh.nodes))
        self._translations = dofs[self._moving]
        row = np.full(3 * len(self._mesh.nodes), -1)
        row[self._translations] = self._moving
        # row of each node displacement of an element among the vectors, and whether it has one
        place = row.reshape(-1, 3)[self._mesh.elements].reshape(len(self._mesh.elements), -1)
        self._place, self._moves = place, place >= 0

    def __call__(self, vectors: np.ndarray) -> np.ndarray:
        """Return K_g of each case times vectors (size, k), (cases, size, k).

        In kN/m times the unit of the vectors.
        """
        share, count = np.eye(len(self._matrices)), vectors.shape[1]
        return np.stack(
            [self.mix(vectors, np.repeat(one[:, None], count, axis=1)) for one in share]
        )

    def project(self, vectors: np.ndarray, chosen: slice) -> np.ndarray:
        """Return v_i^T K_g v_j of each case for all i and the chosen j, (cases, k, chosen).

        Vectors (k, size) stand in rows. Products stay within a chunk of elements: nothing of the
        size of the vectors is written. In kN/m times the square of the unit of the vectors.
        """
        count, few = len(vectors), len(range(*chosen.indices(len(vectors))))
        found = np.zeros((len(self._matrices), count, few))
        for start in range(0, len(self._place), CHUNK):
            part = slice(start, start + CHUNK)
            every = vectors[:, self._place[part].ravel()] * self._moves[part].ravel()
            local = every[chosen].T.reshape(len(self._place[part]), -1, 3 * few)
            for case, matrix in enumerate(self._matrices[:, part]):
                found[case] += every @ np.matmul(matrix, local).reshape(-1, few)
        return found

    def mix(self, vectors: np.ndarray, factors: np.ndarray) -> np.ndarray:
        """Return K_g of the combination (cases, k) of each column times it, (size, k).

        Factors without unit; vectors and results in any, and kN/m times it.
        """
        elements, count = self._mesh.elements, vectors.shape[1]
        moved = self._gather(vectors).reshape(len(self._mesh.nodes), -1)
        shares = np.tile(factors, 3)
        element = np.empty((*elements.shape, 3 * count))
        for start in range(0, len(elements), CHUNK):
            part = slice(start, start + CHUNK)
            local = moved[elements[part]]
            pushed = np.matmul(self._matrices[0, part], local * shares[0])
            for matrix, share in zip(self._matrices[1:, part], shares[1:], strict=True):
                pushed += np.matmul(matrix, local * share)
            element[part] = pushed
        result = np.zeros(vectors.shape)
        total = self._mesh.node_sum.add(element.reshape(-1, 3 * count)).reshape(-1, count)
        result[self._moving] = total[self._translations]
        return result

    def _gather(self, vectors: np.ndarray) -> np.ndarray:
        full = np.zeros((3 * len(self._mesh.nodes), vectors.shape[1]))
        full[self._translations] = vectors[self._moving]
        return full


def _element_matrices(operators: ShellOperators, force: np.ndarray) -> np.ndarray:
    """Return K_g of each column of N element by element, (c, E, n, n)."""
    nodes = operators.mesh.elements.shape[1]
    square = _square_products(operators.mesh.order)
    pulled = pull_back(operators, force).transpose(3, 0, 1, 2)
    return (pulled.reshape(-1, len(square)) @ square).reshape(*pulled.shape[:2], nodes, nodes)


@lru_cache(maxsize=8)
def _square_products(order: int) -> np.ndarray:
    """Return the table `product` for whole matrices (3m, n n) in place of lower triangles."""
    tables = geometric_tables(order)
    nodes = tables.slope.shape[1]
    i, j = np.divmod(np.arange(nodes**2), nodes)
    i, j = np.maximum(i, j), np.minimum(i, j)
    return tables.product[:, i * (i + 1) // 2 + j]


def pull_back(operators: ShellOperators, force: np.ndarray) -> np.ndarray:
    """Return area J^-1 N J^-T (E, 3, m, c): components rr, ss, rs of the reference directions."""
    inverse, area = operators.geometry.inverse, operators.geometry.area[:, None]
    x, y = inverse[:, :, 0], inverse[:, :, 1]
    rows = [
        np.stack([x[:, 0] ** 2, y[:, 0] ** 2, 2 * x[:, 0] * y[:, 0]], axis=1),
        np.stack([x[:, 1] ** 2, y[:, 1] ** 2, 2 * x[:, 1] * y[:, 1]], axis=1),
        np.stack([x[:, 0] * x[:, 1], y[:, 0] * y[:, 1], x[:, 0] * y[:, 1] + y[:, 0] * x[:, 1]], 1),
    ]
    transform = np.stack(rows, axis=1) * area[:, None]
    return np.matmul(transform, force.reshape(len(force), 3, -1)).reshape(force.shape)
