"""What every folding mode hands back."""

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Shape:
    """What a mode hands back: vertices and flat state (V, 3) [m], and how it ended.

    `flat` is the crease pattern that was folded: given in elastic and isometric mode, found in
    exact and rigid mode. `residuals` are further measures of the mode, by name. `surface` (Y, K, 3)
    [m] are points between the vertices of a smooth shell, None for sheets of flat facets.
    """

    vertices: np.ndarray
    flat: np.ndarray
    iterations: int
    converged: bool
    reason: str
    residuals: dict[str, float] = field(default_factory=dict)
    surface: np.ndarray | None = None
