"""What limits the thickness of panels, linearised about an analysed state, as plain arrays."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Constraints:
    """Values g (m,) with g <= 1 due, gradients dg/dt (m, P) 1/m, panel areas (P,) m2."""

    value: np.ndarray
    gradient: np.ndarray
    area: np.ndarray

    def to_arrays(self) -> dict[str, np.ndarray]:
        """Return the arrays that analysis.npz keeps.

        Shapes and units are those of the class: values (k,), gradients (k, P) 1/m, areas (P,) m2.
        """
        return {
            "constraint_value": self.value,
            "constraint_gradient": self.gradient,
            "panel_area": self.area,
        }


def read_constraints(arrays: Mapping[str, np.ndarray]) -> Constraints | None:
    """Return the constraints that the arrays of analysis.npz hold, or None."""
    names = ("constraint_value", "constraint_gradient", "panel_area")
    return Constraints(*(arrays[name] for name in names)) if names[0] in arrays else None
