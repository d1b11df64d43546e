"""Load cases as surface loads, and their combinations (Table 2 of Tsiamis et al. 2018)."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from foldshell.settings.field import Factors
from foldshell.settings.loads import LOAD_CASES, Loads

WEIGHT, PRESSURE = "weight", "pressure"
"""Kinds of load: by volume of the shell, or by area."""

GLOBAL_X, GLOBAL_Y, DOWN = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, -1.0)


@dataclass(frozen=True)
class SurfaceLoad:
    """A load case: uniform over the shell.

    Attributes
    ----------
    case : name that combinations know it by
    kind : WEIGHT or PRESSURE
    value : kN/m3 of a weight, kN/m2 of a pressure
    direction : unit vector in global axes; None is against the normal of each facet
    area : what a pressure refers to, "sheet" (true area) or "plan_abs" (its plan projection)
    words : what it is
    """

    case: str
    kind: str
    value: float
    direction: tuple[float, float, float] | None
    area: str = "sheet"
    words: str = "load"

    def evaluate(self, normal: np.ndarray, thickness: np.ndarray) -> np.ndarray:
        """Return the load (E, 3) kN per m2 of mesh; normal (E, 3) unit, thickness (E,) m."""
        size = np.full(len(normal), self.value)
        if self.kind == WEIGHT:
            size = self.value * thickness
        elif self.area == "plan_abs":
            size = self.value * np.abs(normal[:, 2])
        along = -normal if self.direction is None else np.array(self.direction)
        return size[:, None] * along


def make_load_cases(loads: Loads, unit_weight: float) -> tuple[SurfaceLoad, ...]:
    """Return the cases of Table 2 in the order of `LOAD_CASES`; unit weight kN/m3.

    Part of the wind acts on all of the mesh. Live load and wind refer to the area that the
    settings name.
    """
    wind, area = loads.wind * loads.wind_fraction, loads.area_basis
    own, dead, live, along_x, along_y = LOAD_CASES
    return (
        SurfaceLoad(own, WEIGHT, unit_weight, DOWN, words="self-weight"),
        SurfaceLoad(dead, PRESSURE, loads.superimposed_dead, None, words="superimposed dead load"),
        SurfaceLoad(live, PRESSURE, loads.live, DOWN, area, "live load"),
        SurfaceLoad(along_x, PRESSURE, wind, GLOBAL_X, area, "wind"),
        SurfaceLoad(along_y, PRESSURE, wind, GLOBAL_Y, area, "wind"),
    )


def surface_loads(
    normal: np.ndarray,
    thickness: np.ndarray,
    cases: Sequence[SurfaceLoad],
    self_weight_only: np.ndarray | None = None,
) -> np.ndarray:
    """Return the load of each case on each element, (E, 3, c) kN per m2 of mesh.

    Parameters
    ----------
    normal : (E, 3) unit normals
    thickness : (E,) m
    cases : c load cases
    self_weight_only : (E,) bool, elements that carry nothing but their own weight; by default none
    """
    result = np.stack([case.evaluate(normal, thickness) for case in cases], axis=2)
    if self_weight_only is not None:
        others = [case.kind != WEIGHT for case in cases]
        result[np.ix_(self_weight_only, (True,) * 3, others)] = 0
    return result


def combination_matrix(combinations: Factors, cases: Sequence[str] = LOAD_CASES) -> np.ndarray:
    """Return the factors (cases, combinations) by which load cases are superposed.

    Factors without unit.
    """
    return np.array(
        [[factors.get(case, 0.0) for factors in combinations.values()] for case in cases]
    )
