"""The nine-node flat shell element: biquadratic membrane, MITC9 plate.

Local coordinates (x, y) lie in the facet. Membrane unknowns (u, v), plate unknowns
(w, bx, by), where u = z bx and v = z by through the thickness.
Sources: Bathe, Finite Element Procedures (2014), ch. 5; Bucalem and Bathe, Int. J. Numer.
Methods Eng. 36 (1993) 3729-3754 for the tying of transverse shear.
"""

from dataclasses import dataclass

import numpy as np

GAUSS = np.sqrt(0.6) * np.array([-1.0, 0.0, 1.0])
GAUSS_WEIGHT = np.array([5.0, 8.0, 5.0]) / 9
TIE = np.array([-1.0, 1.0]) / np.sqrt(3.0)


def _lagrange(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Quadratic Lagrange polynomials at -1, 0, 1 and their derivatives: (points, 3) each."""
    value = np.stack([x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2], axis=-1)
    slope = np.stack([x - 0.5, -2 * x, x + 0.5], axis=-1)
    return value, slope


def evaluate_shape(r: np.ndarray, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Biquadratic shape functions (g, 9), r fastest, and their derivatives (g, 9, 2).

    r and s (g,) are coordinates in the square from -1 to 1, without unit.
    """
    value_r, slope_r = _lagrange(r)
    value_s, slope_s = _lagrange(s)
    shape = (value_s[:, :, None] * value_r[:, None, :]).reshape(len(r), 9)
    by_r = (value_s[:, :, None] * slope_r[:, None, :]).reshape(len(r), 9)
    by_s = (slope_s[:, :, None] * value_r[:, None, :]).reshape(len(r), 9)
    return shape, np.stack([by_r, by_s], axis=-1)


def build_grid(points_r: np.ndarray, points_s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """All pairs of two point rows (p,) and (q,), r fastest: r and s (p q,) in the unit square."""
    s, r = np.meshgrid(points_s, points_r, indexing="ij")
    return r.ravel(), s.ravel()


@dataclass(frozen=True)
class Quadrature:
    """Shape values and derivatives at the 3 x 3 Gauss points of a batch of elements."""

    shape: np.ndarray  # (9, 9) point, node
    gradient: np.ndarray  # (..., 9, 2, 9) point, x|y, node
    area: np.ndarray  # (..., 9) weight times Jacobian, m2
    inverse: np.ndarray  # (..., 9, 2, 2) d(r, s)/d(x, y), index [local, natural]


def integrate_elements(xy: np.ndarray) -> Quadrature:
    """Map the Gauss points to elements with node coordinates `xy` (..., 9, 2) in m."""
    r, s = build_grid(GAUSS, GAUSS)
    shape, slope = evaluate_shape(r, s)
    jacobian = np.einsum("gan,...ax->...gnx", slope, xy, optimize=True)  # dx/dr
    (a, b), (c, d) = np.moveaxis(jacobian, (-2, -1), (0, 1))
    determinant = a * d - b * c
    inverse = np.empty_like(jacobian)  # [x, natural]
    inverse[..., 0, 0], inverse[..., 0, 1] = d, -b
    inverse[..., 1, 0], inverse[..., 1, 1] = -c, a
    inverse /= determinant[..., None, None]
    gradient = inverse @ np.swapaxes(slope, -1, -2)
    weight = np.outer(GAUSS_WEIGHT, GAUSS_WEIGHT).ravel()
    return Quadrature(shape, gradient, weight * determinant, inverse)


def build_plane_elasticity(poisson: float) -> np.ndarray:
    """Plane-stress elasticity for unit modulus, on (xx, yy, xy): shape (3, 3)."""
    nu = poisson
    return np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]]) / (1 - nu * nu)


def compute_plane_stiffness(quadrature: Quadrature, poisson: float) -> np.ndarray:
    """K = integral of B^T D B for unit modulus and thickness: (..., 18, 18), node-major (u, v).

    The same matrix, times E t^3 / 12, is the curvature part in (bx, by).
    """
    gx, gy = np.moveaxis(quadrature.gradient, -2, 0)
    strain = np.zeros((*gx.shape[:-2], 9, 3, 9, 2))  # point, component, node, dof
    strain[..., 0, :, 0] = gx
    strain[..., 1, :, 1] = gy
    strain[..., 2, :, 0] = gy
    strain[..., 2, :, 1] = gx
    root = np.linalg.cholesky(build_plane_elasticity(poisson)).T
    strain = strain.reshape(*gx.shape[:-2], 9, 3, 18)
    weighted = root @ strain * np.sqrt(quadrature.area)[..., None, None]
    weighted = weighted.reshape(*gx.shape[:-2], 27, 18)
    return np.swapaxes(weighted, -1, -2) @ weighted


def _tie_shear(xy: np.ndarray, direction: int) -> tuple[np.ndarray, np.ndarray]:
    """Natural shear along r (0) or s (1) at its six tying points, and their weights.

    Returns the operator (..., 6, 9, 3) on (w, bx, by) and the interpolation (9 points, 6).
    """
    r, s = build_grid(TIE, GAUSS) if direction == 0 else build_grid(GAUSS, TIE)
    shape, slope = evaluate_shape(r, s)
    tangent = np.einsum("ta,...ax->...tx", slope[..., direction], xy, optimize=True)
    operator = np.empty((*xy.shape[:-2], 6, 9, 3))
    operator[..., 0] = slope[..., direction]
    operator[..., 1:] = shape[:, :, None] * tangent[..., :, None, :]
    at_r, at_s = build_grid(GAUSS, GAUSS)
    along, across = (at_r, at_s) if direction == 0 else (at_s, at_r)
    linear = np.stack([1 - along / TIE[1], 1 + along / TIE[1]], axis=-1) / 2
    quadratic = _lagrange(across / GAUSS[2])[0]
    if direction == 0:
        weights = quadratic[:, :, None] * linear[:, None, :]
    else:
        weights = linear[:, :, None] * quadratic[:, None, :]
    return operator, weights.reshape(9, 6)


def compute_shear_operator(xy: np.ndarray, quadrature: Quadrature) -> np.ndarray:
    """Transverse shear strain (xz, yz) at the Gauss points: (..., 9, 2, 9, 3) on (w, bx, by).

    xy (..., 9, 2) m; strains per m of w and per rad of b, so 1/m and 1.
    """
    natural = []
    for direction in (0, 1):
        operator, weights = _tie_shear(xy, direction)
        flat = operator.reshape(*xy.shape[:-2], 6, 27)
        natural.append(weights @ flat)
    natural = np.stack(natural, axis=-2)  # (..., 9, 2, 27)
    local = quadrature.inverse @ natural
    return local.reshape(*xy.shape[:-2], 9, 2, 9, 3)


def compute_shear_stiffness(xy: np.ndarray, quadrature: Quadrature) -> np.ndarray:
    """K = integral of Bs^T Bs for unit shear rigidity: (..., 27, 27), node-major (w, bx, by)."""
    operator = compute_shear_operator(xy, quadrature).reshape(*xy.shape[:-2], 9, 2, 27)
    weighted = operator * np.sqrt(quadrature.area)[..., None, None]
    weighted = weighted.reshape(*xy.shape[:-2], 18, 27)
    return np.swapaxes(weighted, -1, -2) @ weighted
