"""Steel of panels by this code's own forces and moments: means over facets and strips."""

from collections.abc import Mapping

import numpy as np

from crosscheck.analysis import Analysis
from crosscheck.element import build_plane_elasticity
from crosscheck.model import Model
from crosscheck.steel import Bars, reinforce
from crosscheck.stress import compute_strains

STRIP = 0.3
"""Width of the strips along the sides of facets, m."""


def measure_steel(
    analysis: Analysis, local: np.ndarray, bars: Bars, width: float = STRIP
) -> Mapping[str, float]:
    """kg/m2 of reinforcement and the largest of one layer and direction, kN/m.

    Of each panel and layer the largest mean over a facet, or over a strip along a side of one
    (folds, borders, diagonals), of what the Gauss points need, over all columns of `local` (F, R,
    5, k) in m and rad. No least steel.
    """
    model, grid = analysis.model, analysis.system.grid
    area = grid.quadrature.area.reshape(len(model.facets), -1)
    shares = _share_strips(model, grid, area, width)
    turn = _turn_to_bars(model, grid.axes)
    most = np.zeros((int(model.facet_panel.max()) + 1, 4))
    for column in range(local.shape[-1]):
        n, m = (
            _turn(one, turn).reshape(-1, 3) for one in _find_forces(analysis, local[..., column])
        )
        t = np.repeat(model.thickness, area.shape[1])
        need = reinforce(n, m, t, bars).reshape(*area.shape, 4)
        means = np.einsum("fsg,fgk->fsk", shares, need)
        np.maximum.at(most, model.facet_panel, means.max(axis=1))
    size = np.bincount(model.facet_panel, area.sum(axis=1))
    mass = bars.density / bars.yield_ * (most.sum(axis=1) @ size) / size.sum()
    return {"steel_kg_m2": float(mass), "steel_max_kn_m": float(most.max())}


def _find_forces(analysis: Analysis, local: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return n = t E D eps and m = t^3 / 12 E D kappa, (F, g, 3) in facet axes."""
    section = analysis.system.section
    elastic = section.youngs_modulus * build_plane_elasticity(section.poissons_ratio)
    t = section.thickness[:, None, None]
    strain, curvature = (
        one.reshape(len(section.thickness), -1, 3)
        for one in compute_strains(analysis.system.grid, local)
    )
    return t * strain @ elastic, t**3 / 12 * curvature @ elastic


def _share_strips(model: Model, grid, area: np.ndarray, width: float) -> np.ndarray:
    """Weights (F, 4, g) of the Gauss points in the facet and in the strips along its sides.

    A point stands for a square of its area, of which the part within the strip counts.
    """
    shape = grid.quadrature.shape
    place = np.einsum("gn,fbenx->fbegx", shape, grid.coordinates).reshape(*area.shape, 2)
    corner = model.vertices[model.facets] - model.vertices[model.facets[:, :1]]
    flat = np.einsum("fkx,fax->fka", corner, grid.axes[:, :2])
    rows = [area]
    for k in range(3):
        start, end = flat[:, k], flat[:, (k + 1) % 3]
        along = (end - start) / np.linalg.norm(end - start, axis=1, keepdims=True)
        away = place - start[:, None]
        far = np.abs(away[..., 0] * along[:, None, 1] - away[..., 1] * along[:, None, 0])
        rows.append(area * np.clip((width - far) / np.sqrt(area) + 0.5, 0.0, 1.0))
    found = np.stack(rows, axis=1)
    return found / found.sum(axis=2, keepdims=True)


def _turn_to_bars(model: Model, axes: np.ndarray) -> np.ndarray:
    """Angle (F,) rad from the first side of each facet to the bars along x of its panel."""
    angle = np.zeros(len(model.facets))
    for panel in np.unique(model.facet_panel):
        own = np.flatnonzero(model.facet_panel == panel)
        sides = np.sort(
            np.concatenate([model.facets[own], np.roll(model.facets[own], -1, 1)]).reshape(2, -1).T,
            axis=1,
        )
        sides, count = np.unique(sides, axis=0, return_counts=True)
        low, high = sides[count == 1][0]
        along = axes[own, :2] @ (model.vertices[high] - model.vertices[low])
        angle[own] = np.arctan2(along[:, 1], along[:, 0])
    return angle


def _turn(values: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Components (F, g, 3) in axes turned by (F,) rad."""
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    x, y, xy = np.moveaxis(values, -1, 0)
    both = 2 * s * c * xy
    turned = c * c * x + s * s * y + both, s * s * x + c * c * y - both
    return np.stack([*turned, (c * c - s * s) * xy + s * c * (y - x)], axis=-1)
