"""What limits the thickness of panels, linearised about an analysed state, as plain arrays."""

from dataclasses import dataclass

import numpy as np

from foldshell.records.analysis_arrays import AnalysisArrays


@dataclass(frozen=True)
class Constraints:
    """Values g (m,) with g <= 1 due, gradients dg/dt (m, P) 1/m, panel areas (P,) m2."""

    value: np.ndarray
    gradient: np.ndarray
    area: np.ndarray


def read_constraints(arrays: AnalysisArrays) -> Constraints | None:
    """Return the constraints that analysis.npz holds, or None."""
    if arrays.constraint_value is None:
        return None
    return Constraints(arrays.constraint_value, arrays.constraint_gradient, arrays.panel_area)
