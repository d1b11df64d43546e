"""How well polygons follow an outline in plan."""

from collections.abc import Iterable
from typing import Any

import numpy as np


def measure_overlap(vertices: np.ndarray, rings: Iterable[np.ndarray], plan: Any) -> float:
    """Return intersection over union of polygons (k,) in plan with what an outline leaves.

    vertices (V, 3) m; the share has no unit.
    """
    import shapely

    shapes = [shapely.make_valid(shapely.Polygon(vertices[ring, :2])) for ring in rings]
    union = shapely.union_all(shapes)
    return float(union.intersection(plan).area / union.union(plan).area)
