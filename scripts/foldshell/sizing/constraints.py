"""What limits the thickness of panels, linearised about an analysed state, as plain arrays."""

from dataclasses import dataclass

import numpy as np

from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.settings.sizing import Sizing

NEED_CONSTRAINTS = ("filtered_dead_band", "optimality")
"""Rules that work on the linearised constraints of the analysis."""


@dataclass(frozen=True)
class Constraints:
    """Values g (m,) with g <= 1 due, gradients dg/dt (m, P) 1/m, panel areas (P,) m2.

    Of each value, in order: `panels` (a,) whose utilization it is, `nodes` (b, 2) and deflection
    combination whose displacement, `factors` (c,) combination whose buckling factor; a + b + c = m.
    """

    value: np.ndarray
    gradient: np.ndarray
    area: np.ndarray
    thinning: np.ndarray | None = None
    panels: np.ndarray | None = None
    nodes: np.ndarray | None = None
    factors: np.ndarray | None = None


def read_constraints(arrays: AnalysisArrays) -> Constraints | None:
    """Return the constraints that analysis.npz holds, or None."""
    if arrays.constraint_value is None:
        return None
    return Constraints(
        arrays.constraint_value,
        arrays.constraint_gradient,
        arrays.panel_area,
        arrays.thinning_steps,
    )


def least_factor_due(sizing: Sizing) -> float:
    """Return the buckling factor that rules on constraints keep: the larger of both settings."""
    return max(sizing.thinning_buckling_factor_min, sizing.buckling_factor_min)
