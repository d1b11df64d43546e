"""The paper's loads as forces on facet nodes.

Tsiamis, Oliva, Calvano (2018), Table 2: self-weight; a superimposed dead load local to the mesh;
live load and wind along global axes, half of the wind acting on the sheet.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from crosscheck.discretisation import Discretisation
from crosscheck.model import CASES, Model


def compute_surface_loads(model: Model, normal: np.ndarray) -> np.ndarray:
    """Force on a square metre of each facet in each case (SW, SDL, LL, WX, WY): (F, 3, 5) kN/m2.

    `normal` (F, 3) are the facets' unit normals. The dead load presses at right angles to the
    facet: on the side that faces up (`downward`), or on the sheet's upper side (`sheet`), which
    differs where a facet overhangs. Facets of `self_weight_only` carry no more.
    """
    loads = model.loads
    share = np.abs(normal[:, 2]) if loads.area_basis == "plan_abs" else np.ones(len(normal))
    side = np.where(normal[:, 2] < 0, -1.0, 1.0) if loads.dead_side == "downward" else 1.0
    wind = loads.wind * loads.wind_fraction * share
    surface = np.zeros((len(normal), 3, len(CASES)))
    surface[:, 2, 0] = -model.material.unit_weight * model.thickness
    surface[:, :, 1] = -loads.dead * normal * np.broadcast_to(side, len(normal))[:, None]
    surface[:, 2, 2] = -loads.live * share
    surface[:, 0, 3] = wind
    surface[:, 1, 4] = wind
    surface[model.self_weight_only, :, 1:] = 0
    return surface


def combine_cases(
    surface: np.ndarray,
    combinations: Mapping[str, Mapping[str, float]],
    cases: Sequence[str] = CASES,
) -> np.ndarray:
    """Sum of factor times load for each combination: (F, 3, k).

    Loads of the cases are (F, 3, C), or (F, R, 3, C) forces at nodes; units stay.
    """
    factor = [[factors.get(case, 0.0) for factors in combinations.values()] for case in cases]
    return surface @ np.array(factor)


def distribute_loads(grid: Discretisation, surface: np.ndarray) -> np.ndarray:
    """F = integral of N q over each facet for a uniform q (F, 3, k): (F, R, 3, k) in kN."""
    share = compute_node_areas(grid)
    return share[:, :, None, None] * surface[:, None]


def compute_node_areas(grid: Discretisation) -> np.ndarray:
    """Integral of each node's shape function over its facet: (F, R) in m2."""
    quadrature = grid.quadrature
    part = quadrature.area @ quadrature.shape  # (F, 3, m^2, 9)
    places = grid.mesh.facet_nodes.shape[1]
    total = np.zeros((len(part), places))
    for block in range(3):
        for k, nodes in enumerate(grid.elements[block]):
            total[:, nodes] += part[:, block, k]
    return total
