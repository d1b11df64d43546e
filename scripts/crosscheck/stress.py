"""Stresses at the Gauss points and how much of the strength they use."""

import numpy as np

from crosscheck.discretisation import Discretisation
from crosscheck.element import build_plane_elasticity
from crosscheck.model import Material
from crosscheck.system import Section


def compute_gradients(grid: Discretisation, values: np.ndarray) -> np.ndarray:
    """d/dx and d/dy at the Gauss points of k fields (F, R, k): (F, 3, m^2, 9, 2, k)."""
    slope = grid.quadrature.gradient  # point, x|y, node
    at = np.take(values, grid.elements, axis=1)  # (F, 3, m^2, 9, k)
    change = slope.reshape(*slope.shape[:3], 18, 9) @ at
    return change.reshape(*slope.shape[:-1], -1)


def compute_strains(grid: Discretisation, local: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Membrane strain and curvature (xx, yy, 2xy): (F, 3, m^2, 9, 3) each, from (F, R, 5)."""
    change = compute_gradients(grid, local)

    def strain(u: int, v: int) -> np.ndarray:
        """(xx, yy, 2xy) of the fields in columns u and v."""
        du, dv = change[..., u], change[..., v]
        return np.stack([du[..., 0], dv[..., 1], du[..., 1] + dv[..., 0]], axis=-1)

    return strain(0, 1), strain(3, 4)


def compute_membrane_forces(section: Section, change: np.ndarray) -> np.ndarray:
    """N = t D eps at the Gauss points, tension positive: (F, 3, m^2, 9, 2, 2, c) in kN/m.

    `change` (F, 3, m^2, 9, 2, u|v|w, c) are displacement gradients.
    """
    stiff = section.youngs_modulus * section.thickness[:, None, None, None, None]
    elasticity = build_plane_elasticity(section.poissons_ratio)
    xx, yy = change[..., 0, 0, :], change[..., 1, 1, :]
    force = np.empty((*change.shape[:4], 2, 2, change.shape[-1]))
    force[..., 0, 0, :] = stiff * (elasticity[0, 0] * xx + elasticity[0, 1] * yy)
    force[..., 1, 1, :] = stiff * (elasticity[1, 0] * xx + elasticity[1, 1] * yy)
    shear = stiff * elasticity[2, 2] * (change[..., 1, 0, :] + change[..., 0, 1, :])
    force[..., 0, 1, :] = force[..., 1, 0, :] = shear
    return force


def compute_utilization(
    grid: Discretisation, section: Section, material: Material, local: np.ndarray
) -> np.ndarray:
    """Largest of top, middle and bottom surface at each Gauss point: (F, 3, m^2, 9)."""
    membrane, curvature = compute_strains(grid, local)
    elasticity = section.youngs_modulus * build_plane_elasticity(section.poissons_ratio)
    middle = membrane @ elasticity
    bending = curvature @ elasticity * (section.thickness[:, None, None, None, None] / 2)
    use = RATES[material.criterion]
    return np.max([use(middle + z * bending, material) for z in (-1, 0, 1)], axis=0)


def rate_stress(stress: np.ndarray, material: Material) -> np.ndarray:
    """Von Mises stress over strength, for plane stress (xx, yy, xy).

    stress (..., 3) kPa; returns (...) without unit.
    """
    x, y, xy = np.moveaxis(stress, -1, 0)
    return np.sqrt(x * x - x * y + y * y + 3 * xy * xy) / material.strength


def rate_principal_stress(stress: np.ndarray, material: Material) -> np.ndarray:
    """Rankine: the larger of tension and compression, each over its own strength.

    stress (..., 3) kPa as xx, yy, xy; returns (...) without unit.
    """
    x, y, xy = np.moveaxis(stress, -1, 0)
    middle, radius = (x + y) / 2, np.hypot((x - y) / 2, xy)
    tension = (middle + radius) / material.strength_tension
    return np.maximum(np.maximum(tension, (radius - middle) / material.strength), 0.0)


def rate_pressure(stress: np.ndarray, material: Material) -> np.ndarray:
    """Drucker-Prager cone through both uniaxial strengths: (m - 1) p + (m + 1) q over 2 f.

    p is the sum of the normal stresses, q the von Mises stress and m = f / f_t.

    stress (..., 3) kPa as xx, yy, xy; returns (...) without unit.
    """
    x, y, xy = np.moveaxis(stress, -1, 0)
    ratio = material.strength / material.strength_tension
    mises = np.sqrt(x * x - x * y + y * y + 3 * xy * xy)
    use = (ratio - 1) * (x + y) + (ratio + 1) * mises
    return np.maximum(use / (2 * material.strength), 0.0)


RATES = {
    "von_mises": rate_stress,
    "rankine": rate_principal_stress,
    "drucker_prager": rate_pressure,
}


def compute_percentile(value: np.ndarray, area: np.ndarray, share: float = 0.99) -> float:
    """The value (any unit) that is not exceeded on `share` of the area: both (F, g), area in m2."""
    order = np.argsort(value, axis=None)
    covered = np.cumsum(area.ravel()[order])
    place = np.searchsorted(covered, share * covered[-1])
    return float(value.ravel()[order[min(place, len(order) - 1)]])


def compute_panel_means(value: np.ndarray, area: np.ndarray, facet_panel: np.ndarray) -> np.ndarray:
    """Area mean over each panel of a value at the Gauss points (F, ...): (P,).

    The value keeps its unit, area (F, ...) is in m2, facet_panel (F,) are numbers.
    """
    weighted = (value * area).reshape(len(facet_panel), -1).sum(axis=1)
    total = area.reshape(len(facet_panel), -1).sum(axis=1)
    return np.bincount(facet_panel, weighted) / np.bincount(facet_panel, total)
