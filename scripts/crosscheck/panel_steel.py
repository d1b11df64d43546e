"""Steel, moments and shear of panels by this code's own forces: means over facets and strips."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from crosscheck.analysis import Analysis
from crosscheck.discretisation import Discretisation
from crosscheck.element import build_plane_elasticity, compute_tied_shear, interpolate_tied_shear
from crosscheck.model import Model
from crosscheck.steel import Bars, reinforce
from crosscheck.stress import compute_strains
from crosscheck.system import compute_shear_rigidity


@dataclass(frozen=True)
class Laid:
    """What a sheet is reinforced with: `bars`, the widths (m) of strips for steel and for shear,
    whether strips along diagonals inside panels count, the combinations it is designed for."""

    bars: Bars
    strip: float
    shear_strip: float
    diagonals: bool
    combinations: tuple[str, ...]


def measure_reinforcement(analysis: Analysis, laid: Laid) -> Mapping[str, float]:
    """kg/m2 of reinforcement, and the largest of one layer and direction, moment and shear.

    Of each panel and layer the largest mean over a facet, or over a strip along a side of one
    (folds, borders, diagonals), of what the Gauss points need, over all combinations, of first
    order. No least steel. Moments are principal ones of means; shear is that of means with their
    sign, from the strains of the tied field, over its own strips without diagonals.
    """
    grid, model = analysis.system.grid, analysis.model
    names = list(model.compared_combinations)
    area = grid.quadrature.area.reshape(len(model.facets), -1)
    inner = find_inner_sides(model)
    shares = share_strips(model, grid, area, laid.strip, inner & (not laid.diagonals))
    wide = share_strips(model, grid, area, laid.shear_strip, inner)
    turn = _turn_to_bars(model, grid.axes, inner)
    most = np.zeros((int(model.facet_panel.max()) + 1, 4))
    moment = shear = 0.0
    sized = ~model.self_weight_only
    thickness = np.repeat(model.thickness, area.shape[1])
    for name in laid.combinations:
        local = analysis.response.local[..., names.index(name)]
        n, m = (_turn(one, turn) for one in _find_forces(analysis, local))
        flat = n.reshape(-1, 3), m.reshape(-1, 3)
        need = reinforce(*flat, thickness, laid.bars).reshape(*area.shape, 4)
        np.maximum.at(most, model.facet_panel, (shares @ need).max(axis=1))
        moment = max(moment, _largest_principal((shares @ m)[sized]))
        across = wide @ find_shear(analysis, local).reshape(*area.shape, 2)
        shear = max(shear, float(np.linalg.norm(across[sized], axis=-1).max()))
    size = np.bincount(model.facet_panel, area.sum(axis=1) * sized)
    mass = laid.bars.density / laid.bars.yield_ * (most.sum(axis=1) @ size) / size.sum()
    return {
        "steel_kg_m2": float(mass),
        "steel_max_kn_m": float(most[size > 0].max()),
        "moment_max_knm_m": moment,
        "shear_max_kn_m": shear,
    }


def _largest_principal(values: np.ndarray) -> float:
    """Largest principal value, either sign, of tensors (..., 3) as xx, yy, xy, in their unit."""
    x, y, xy = np.moveaxis(values, -1, 0)
    return float((np.abs(x + y) / 2 + np.hypot((x - y) / 2, xy)).max())


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


def find_shear(analysis: Analysis, local: np.ndarray) -> np.ndarray:
    """v = G t k gamma (F, 3, m^2, 9, 2) kN/m at the Gauss points, in facet axes.

    local (F, R, 5) m and rad; gamma is the tied field that stiffness is made of.
    """
    grid, section = analysis.system.grid, analysis.system.section
    plate = np.take(local[:, :, 2:], grid.elements, axis=1)
    tied = compute_tied_shear(grid.coordinates)
    found = tied @ plate.reshape(*tied.shape[:3], 27, 1)
    rigidity = compute_shear_rigidity(grid, section, section.shear_factor)
    strain = interpolate_tied_shear(grid.quadrature, found[..., 0])
    return rigidity[..., None, None] * strain


def share_strips(
    model: Model, grid: Discretisation, area: np.ndarray, width: float, left_out: np.ndarray
) -> np.ndarray:
    """Weights (F, 4, g) of the Gauss points in the facet and in the strips along its sides.

    A point stands for a square of its area, of which the part within the strip counts. Of sides
    that are left out, (F, 3) bool, the facet stands again.
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
        within = area * np.clip((width - far) / np.sqrt(area) + 0.5, 0.0, 1.0)
        rows.append(np.where(left_out[:, k, None], area, within))
    found = np.stack(rows, axis=1)
    return found / found.sum(axis=2, keepdims=True)


def _list_sides(model: Model) -> np.ndarray:
    """Ends of the sides of facets, the lower number first: (F, 3, 2)."""
    return np.sort(np.stack([model.facets, np.roll(model.facets, -1, axis=1)], axis=2), axis=2)


def find_inner_sides(model: Model) -> np.ndarray:
    """Whether each side of a facet lies inside its panel: (F, 3) bool."""
    panel = np.repeat(model.facet_panel, 3)[:, None]
    key = np.concatenate([panel, _list_sides(model).reshape(-1, 2)], axis=1)
    _, which, count = np.unique(key, axis=0, return_inverse=True, return_counts=True)
    return (count[which.ravel()] > 1).reshape(-1, 3)


def _turn_to_bars(model: Model, axes: np.ndarray, inner: np.ndarray) -> np.ndarray:
    """Angle (F,) rad from the first side of each facet to the bars along x of its panel.

    They run along the side with the lowest ends that is not `inner`, (F, 3) bool.
    """
    outer = np.flatnonzero(~inner.ravel())
    panel = np.repeat(model.facet_panel, 3)[outer]
    low, high = _list_sides(model).reshape(-1, 2)[outer].T
    order = np.lexsort((high, low, panel))
    first = order[np.searchsorted(panel[order], model.facet_panel)]
    direction = model.vertices[high[first]] - model.vertices[low[first]]
    along = np.einsum("fax,fx->fa", axes[:, :2], direction)
    return np.arctan2(along[:, 1], along[:, 0])


def _turn(values: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Components (F, g, 3) in axes turned by (F,) rad."""
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    x, y, xy = np.moveaxis(values, -1, 0)
    both = 2 * s * c * xy
    turned = c * c * x + s * s * y + both, s * s * x + c * c * y - both
    return np.stack([*turned, (c * c - s * s) * xy + s * c * (y - x)], axis=-1)
