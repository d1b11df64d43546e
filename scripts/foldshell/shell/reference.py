"""Polynomials on the reference triangle (0,0), (1,0), (0,1), tabulated once for each order.

Three bases meet in the element of `element.py`:

- Lagrange of degree p on the lattice of equidistant nodes, for displacements;
- an orthonormal basis of degree p - 1 (Dubiner 1991), for strains, curvatures and forces;
- Legendre polynomials of degree up to p - 1 on an edge, for the rotation about it.

Jacobi polynomials are made here, not by `scipy.special`: importing that takes longer than the
tables do, in each of the several hundred jobs of a study.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

EDGES = np.array([[0, 1], [1, 2], [2, 0]])
"""Corners of the three edges, counter-clockwise."""


@dataclass(frozen=True)
class ReferenceTriangle:
    """Tables for one order p; n = (p+1)(p+2)/2 nodes, m = p(p+1)/2 strain functions.

    `gradient` (2, m, n) and `hessian` (3, m, n; rr, ss, rs) hold the derivatives of each
    Lagrange function as coefficients of the orthonormal basis: exact, since both are of
    degree p - 1 at most. `edge_gradient` (3, 2, m, n) and `edge_rotation` (3, m, p) are the
    integrals over an edge of unit length of an orthonormal function times a derivative, or
    times a Legendre polynomial. `edge_slope` (3, 2, p, n) holds the derivatives on an edge as
    coefficients of Legendre polynomials scaled to mean square one. `load` (n,) are means over the
    triangle.
    """

    order: int
    lattice: np.ndarray
    gradient: np.ndarray
    hessian: np.ndarray
    edge_gradient: np.ndarray
    edge_rotation: np.ndarray
    edge_slope: np.ndarray
    load: np.ndarray


@lru_cache(maxsize=8)
def reference_triangle(order: int) -> ReferenceTriangle:
    """Tabulate the reference triangle of the given order (1 to 8)."""
    if not 1 <= order <= 8:
        raise ValueError(f"element order {order}: allowed are 1 to 8")
    lattice = lattice_points(order)
    points, weights = triangle_quadrature(2 * order)
    psi = orthonormal_basis(order - 1, points)
    values, first, second = lagrange_basis(order, points)
    project = psi.T * weights
    xi, edge_weights = edge_quadrature(2 * order)
    legendre = edge_basis(order, xi)
    edge_gradient, edge_rotation, edge_slope = [], [], []
    unit_legendre = legendre * np.sqrt(2 * np.arange(order) + 1)
    for a, b in EDGES:
        corner = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
        on_edge = (1 - xi)[:, None] * corner[a] + xi[:, None] * corner[b]
        edge_psi = orthonormal_basis(order - 1, on_edge).T * edge_weights
        slopes = lagrange_basis(order, on_edge)[1]
        edge_gradient.append(np.einsum("mq,kqn->kmn", edge_psi, slopes))
        edge_slope.append(np.einsum("q,qj,kqn->kjn", edge_weights, unit_legendre, slopes))
        edge_rotation.append(edge_psi @ legendre)
    return ReferenceTriangle(
        order=order,
        lattice=lattice,
        gradient=np.einsum("mq,kqn->kmn", project, first),
        hessian=np.einsum("mq,kqn->kmn", project, second),
        edge_gradient=np.array(edge_gradient),
        edge_rotation=np.array(edge_rotation),
        edge_slope=np.array(edge_slope),
        load=weights @ values,
    )


def lattice_indices(order: int) -> np.ndarray:
    """Return the barycentric indices (n, 3) of the lattice nodes, each row summing to `order`."""
    return np.array([(order - r - s, r, s) for s in range(order + 1) for r in range(order + 1 - s)])


def lattice_points(order: int) -> np.ndarray:
    """Return the lattice nodes (n, 2) of the reference triangle.

    Coordinates r, s run from 0 to 1, without unit.
    """
    return lattice_indices(order)[:, 1:] / order


def triangle_quadrature(degree: int) -> tuple[np.ndarray, np.ndarray]:
    """Return points (q, 2) and weights (q,), summing to one, exact to `degree`.

    Conical product of Gauss-Legendre and Gauss-Jacobi (Stroud 1971): any degree, all weights
    positive.
    """
    count = degree // 2 + 1
    x, wx = np.polynomial.legendre.leggauss(count)
    y, wy = gauss_jacobi(count)
    s = np.repeat((1 + y) / 2, count)
    r = np.tile((1 + x) / 2, count) * (1 - s)
    weights = np.outer(wy, wx).ravel()
    return np.column_stack([r, s]), weights / weights.sum()


def gauss_jacobi(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the Gauss points in (-1, 1) and weights for int (1 - y) f(y) dy, both (count,).

    Eigenvalues of the recurrence of the Jacobi polynomials (1, 0) (Golub & Welsch 1969).
    """
    k = np.arange(1, count)
    diagonal = -1 / ((2 * np.arange(count) + 1) * (2 * np.arange(count) + 3))
    beside = np.sqrt(k * (k + 1)) / (2 * k + 1)
    points, vectors = np.linalg.eigh(np.diag(diagonal) + np.diag(beside, -1))
    return points, 2 * vectors[0] ** 2


def jacobi(degree: int, alpha: int, x: np.ndarray) -> np.ndarray:
    """Return the Jacobi polynomial P^(alpha, 0) of a degree at x (Abramowitz & Stegun 22.7.1).

    Without unit.
    """
    before, current = np.zeros_like(x), np.ones_like(x)
    for n in range(degree):
        if n == 0:
            following = (alpha + (alpha + 2) * x) / 2
        else:
            c = 2 * n + alpha
            following = (c + 1) * ((c + 2) * c * x + alpha**2) * current
            following -= 2 * (n + alpha) * n * (c + 2) * before
            following /= 2 * (n + 1) * (n + alpha + 1) * c
        before, current = current, following
    return current


def edge_quadrature(degree: int) -> tuple[np.ndarray, np.ndarray]:
    """Return Gauss points in (0, 1) and weights summing to one, exact to `degree`."""
    x, w = np.polynomial.legendre.leggauss(degree // 2 + 1)
    return (1 + x) / 2, w / 2


def edge_basis(order: int, xi: np.ndarray) -> np.ndarray:
    """Return the `order` lowest Legendre polynomials (q, order) at `xi` in [0, 1]."""
    return np.polynomial.legendre.legvander(2 * xi - 1, order - 1)


def orthonormal_basis(degree: int, points: np.ndarray) -> np.ndarray:
    """Return the Dubiner basis (q, m), of mean square one over the triangle, at points (q, 2)."""
    r, s = points.T
    top = 1 - s
    safe = np.where(top > 1e-14, top, 1.0)
    a = np.where(top > 1e-14, 2 * r / safe - 1, -1.0)
    b = 2 * s - 1
    columns = []
    for i in range(degree + 1):
        for j in range(degree + 1 - i):
            scale = np.sqrt((2 * i + 1) * (i + j + 1))
            columns.append(scale * jacobi(i, 0, a) * top**i * jacobi(j, 2 * i + 1, b))
    return np.column_stack(columns)


def lagrange_basis(order: int, points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return values (q, n), first (2, q, n) and second (3, q, n; rr, ss, rs) derivatives.

    points (q, 2) are r, s from 0 to 1; no units.
    """
    points, lattice = points.astype(np.longdouble), lattice_points(order).astype(np.longdouble)
    to_monomials = _monomials(order, lattice, 0, 0)
    # monomials are ill-conditioned: Newton's step brings the inverse to extended precision
    to_nodal = np.linalg.inv(to_monomials.astype(float)).astype(np.longdouble)
    to_nodal = to_nodal @ (2 * np.eye(len(to_nodal)) - to_monomials @ to_nodal)
    table = {
        (i, j): (_monomials(order, points, i, j) @ to_nodal).astype(float)
        for i, j in ((0, 0), (1, 0), (0, 1), (2, 0), (0, 2), (1, 1))
    }
    return (
        table[0, 0],
        np.array([table[1, 0], table[0, 1]]),
        np.array([table[2, 0], table[0, 2], table[1, 1]]),
    )


def _monomials(order: int, points: np.ndarray, dr: int, ds: int) -> np.ndarray:
    """Return the (dr, ds) derivative of all monomials of total degree <= order, (q, n)."""
    powers = np.array([(i, j) for i in range(order + 1) for j in range(order + 1 - i)])
    in_r = _power_derivatives(points[:, 0], order, dr)
    in_s = _power_derivatives(points[:, 1], order, ds)
    return in_r[:, powers[:, 0]] * in_s[:, powers[:, 1]]


def _power_derivatives(x: np.ndarray, order: int, times: int) -> np.ndarray:
    """Return the derivatives (q, order + 1) of x^0 to x^order."""
    power = np.arange(order + 1)
    factor = np.ones(order + 1)
    for k in range(times):
        factor = factor * (power - k)
    return factor * x[:, None] ** np.maximum(power - times, 0)
