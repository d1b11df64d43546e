"""Load cases as surface loads, and their combinations (Table 2 of Tsiamis et al. 2018)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

LOAD_CASES = ("SW", "SDL", "LL", "WX", "WY")
"""Self-weight, superimposed dead load, live load, wind along x and along y."""


@dataclass(frozen=True)
class Loads:
    """Surface loads in kN/m2; `area_basis` says whether LL and W act on mesh or plan area."""

    superimposed_dead: float = 0.5
    live: float = 1.0
    wind: float = 1.7
    wind_fraction: float = 0.5
    area_basis: str = "mesh"


def surface_loads(
    normal: np.ndarray,
    thickness: np.ndarray,
    unit_weight: float,
    loads: Loads,
    self_weight_only: np.ndarray | None = None,
) -> np.ndarray:
    """Return the load of each case on each element, (E, 3, 5) kN per m2 of mesh.

    Self-weight, live load and wind act along global axes; the superimposed dead load acts
    against the normal of each facet. Half of the wind acts on all of the mesh (the fraction).

    Parameters
    ----------
    normal : (E, 3) unit normals
    thickness : (E,) m
    self_weight_only : (E,) bool, elements that carry nothing but their own weight; by default none
    """
    result = np.zeros((len(normal), 3, len(LOAD_CASES)))
    share = np.abs(normal[:, 2]) if loads.area_basis == "plan" else np.ones(len(normal))
    result[:, 2, 0] = -unit_weight * thickness
    result[:, :, 1] = -loads.superimposed_dead * normal
    result[:, 2, 2] = -loads.live * share
    result[:, 0, 3] = result[:, 1, 4] = loads.wind * loads.wind_fraction * share
    if self_weight_only is not None:
        result[self_weight_only, :, 1:] = 0
    return result


def combination_matrix(
    combinations: Mapping[str, Mapping[str, float]], cases: Sequence[str] = LOAD_CASES
) -> np.ndarray:
    """Return the factors (cases, combinations) by which load cases are superposed.

    Factors without unit.
    """
    return np.array(
        [[factors.get(case, 0.0) for factors in combinations.values()] for case in cases]
    )
