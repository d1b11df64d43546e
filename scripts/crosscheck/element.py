"""The nine-node flat shell element: biquadratic membrane, MITC9 plate.

Local coordinates (x, y) lie in the facet. Membrane unknowns (u, v), plate unknowns
(w, bx, by), where u = z bx and v = z by through the thickness.
Sources: Bathe, Finite Element Procedures (2014), ch. 5; Bucalem and Bathe, Int. J. Numer.
Methods Eng. 36 (1993) 3729-3754 for the tying of transverse shear.
"""

from dataclasses import dataclass
from functools import cache

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


def compute_tied_shear(xy: np.ndarray) -> np.ndarray:
    """Natural shear at the six tying points along r and the six along s: (..., 12, 27).

    Acts on (w, bx, by), node-major, of elements with node coordinates `xy` (..., 9, 2) in m.
    """
    operator = np.empty((*xy.shape[:-2], 2, 6, 9, 3))
    for direction, (r, s) in enumerate((build_grid(TIE, GAUSS), build_grid(GAUSS, TIE))):
        shape, slope = evaluate_shape(r, s)
        tangent = slope[..., direction] @ xy
        operator[..., direction, :, :, 0] = slope[..., direction]
        operator[..., direction, :, :, 1:] = shape[:, :, None] * tangent[..., :, None, :]
    return operator.reshape(*xy.shape[:-2], 12, 27)


@cache
def _interpolate_ties() -> np.ndarray:
    """Natural shear at the Gauss points from that at its tying points: (2 directions, 9, 6)."""
    at_r, at_s = build_grid(GAUSS, GAUSS)
    weights = []
    for direction, (along, across) in enumerate(((at_r, at_s), (at_s, at_r))):
        linear = np.stack([1 - along / TIE[1], 1 + along / TIE[1]], axis=-1) / 2
        quadratic = _lagrange(across / GAUSS[2])[0]
        outer, inner = (quadratic, linear) if direction == 0 else (linear, quadratic)
        weights.append((outer[:, :, None] * inner[:, None, :]).reshape(9, 6))
    return np.array(weights)


def interpolate_tied_shear(quadrature: Quadrature, tied: np.ndarray) -> np.ndarray:
    """Transverse shear strain (xz, yz) at the Gauss points: (..., 9, 2), without unit.

    tied (..., 12) are the natural shears at the tying points, those along r first.
    """
    ties = _interpolate_ties()
    natural = np.stack([tied[..., :6] @ ties[0].T, tied[..., 6:] @ ties[1].T], axis=-1)
    return (quadrature.inverse @ natural[..., None])[..., 0]


def integrate_tied_shear(quadrature: Quadrature) -> np.ndarray:
    """S = integral of products of interpolated shear, over the element: (..., 12, 12) in m2.

    With the shear g at the tying points, g^T S g is the integral of the squared transverse shear
    strain (xz, yz).
    """
    metric = np.swapaxes(quadrature.inverse, -1, -2) @ quadrature.inverse  # natural x natural
    metric *= quadrature.area[..., None, None]
    ties = _interpolate_ties()
    total = np.empty((*quadrature.area.shape[:-1], 2, 6, 2, 6))
    for n in range(2):
        for m in range(2):
            products = (ties[n][:, :, None] * ties[m][:, None, :]).reshape(9, 36)
            found = metric[..., n, m] @ products
            total[..., n, :, m, :] = found.reshape(*found.shape[:-1], 6, 6)
    return total.reshape(*total.shape[:-4], 12, 12)


def compute_shear_stiffness(xy: np.ndarray, quadrature: Quadrature) -> np.ndarray:
    """K = integral of Bs^T Bs for unit shear rigidity: (..., 27, 27), node-major (w, bx, by)."""
    tied = compute_tied_shear(xy)
    return np.swapaxes(tied, -1, -2) @ (integrate_tied_shear(quadrature) @ tied)
