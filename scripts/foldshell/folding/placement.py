"""Where a folded sheet stands: solved about the middle of the plan, written where the target is.

Coordinates far from the origin have fewer digits left. What is reported of a sheet is measured on
the coordinates that are written, so vertices are rounded as writing them does before anything is
measured, and limits that are round-off themselves grow by what that rounding can do.
"""

import numpy as np

from foldshell.folding.terms import Target


def place_vertices(vertices: np.ndarray, target: Target) -> np.ndarray:
    """Vertices (V, 3) [m] from the middle of the plan to where the target stands."""
    return vertices + np.array(target.origin) if any(target.origin) else vertices


def round_as_written(vertices: np.ndarray, target: Target) -> np.ndarray:
    """Vertices (V, 3) [m] from the middle of the plan as the written ones hold them."""
    if not any(target.origin):
        return vertices
    return place_vertices(vertices, target) - np.array(target.origin)


def measure_rounding(target: Target) -> float:
    """Spacing [m] of doubles at the far end of the target's place; 0 at the origin itself."""
    far = max(abs(value) for value in target.origin)
    return float(np.spacing(far + target.span)) if far else 0.0
