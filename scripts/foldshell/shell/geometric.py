"""Geometric stiffness: what membrane forces do to the stiffness of a displaced shell.

u^T K_g v = int N_ab d_a u . d_b v dA over all three displacement components, which is the part of
the Green-Lagrange strain energy that is linear in N. It does not see a rigid translation.
Slopes are taken along the two directions of the reference triangle, the same for all elements,
and N is pulled back to them.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from foldshell.files.threads import LARGE
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

    def __call__(self, vectors: np.ndarray) -> np.ndarray:
        """Return K_g of each case times vectors (size, k), (cases, size, k)."""
        return np.stack(list(self.each(vectors)))

    def each(self, vectors: np.ndarray) -> Iterator[np.ndarray]:
        """Return K_g of each case times vectors (size, k), one case after the other: less memory.

        In kN/m times the unit of the vectors.
        """
        mesh, count = self._mesh, vectors.shape[1]
        local = self._gather(vectors).reshape(len(mesh.nodes), 3 * count)[mesh.elements]
        for matrix in self._matrices:
            own = np.zeros(vectors.shape)
            self._scatter(np.matmul(matrix, local).reshape(-1, 3 * count), own)
            yield own

    def mix(self, vectors: np.ndarray, factors: np.ndarray) -> np.ndarray:
        """Return K_g of the combination (cases, k) of each column times it, (size, k).

        Factors without unit; vectors and results in any, and kN/m times it.
        """
        mesh, count = self._mesh, vectors.shape[1]
        moved = self._gather(vectors).reshape(-1, 3, count).swapaxes(1, 2).copy()
        cases, elements, nodes, _ = self._matrices.shape
        element, shares = np.empty((elements, nodes, 3, count)), factors.T.copy()
        for start in range(0, elements, CHUNK):
            part = slice(start, start + CHUNK)
            own = self._matrices[:, part].reshape(cases, -1)
            # one product for all is quicker, but ends in other digits
            mixed = shares @ own if len(vectors) >= LARGE else np.stack([s @ own for s in shares])
            local = moved[mesh.elements[part]].transpose(2, 0, 1, 3)
            pushed = np.matmul(mixed.reshape(count, -1, nodes, nodes), local)
            element[part] = pushed.transpose(1, 2, 3, 0)
        result = np.zeros(vectors.shape)
        self._scatter(element.reshape(-1, 3 * count), result)
        return result

    def _gather(self, vectors: np.ndarray) -> np.ndarray:
        full = np.zeros((3 * len(self._mesh.nodes), vectors.shape[1]))
        full[self._translations] = vectors[self._moving]
        return full

    def _scatter(self, pushed: np.ndarray, result: np.ndarray) -> None:
        total = self._mesh.node_sum.add(pushed).reshape(-1, result.shape[1])
        result[self._moving] = total[self._translations]


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
