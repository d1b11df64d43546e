"""From values on two or more meshes to the limit, and how far each mesh is from it."""

from collections.abc import Sequence

import numpy as np

ORDER = 3.0
"""Order in 1/m on graded meshes, measured on six folded sheets with m = 2 to 5 (2.1 to 3.4)."""
PRIMARY_ORDER = 2.0
"""Taken for another code that does not say its own (`order`, `orders`) and has two meshes only."""
ORDER_BOUNDS = (1.0, 4.0)


def extrapolate(subdivisions: Sequence[int], values: Sequence[float], order: float) -> float:
    """Richardson: v + (v - v') / ((n/n')^p - 1) from the two finest meshes n' < n.

    One mesh alone is returned as it is.
    """
    if len(values) < 2:
        return float(values[-1])
    ratio = (subdivisions[-1] / subdivisions[-2]) ** order
    return float(values[-1] + (values[-1] - values[-2]) / (ratio - 1))


def measure_order(subdivisions: Sequence[int], values: Sequence[float], order: float) -> float:
    """The order p of v(n) = v + c / n^p through the three finest meshes.

    Without three, or where the values do not settle in one direction, the order given.
    """
    if len(values) < 3:
        return order
    sizes = np.array(subdivisions[-3:], dtype=float)
    first, second = np.diff(np.array(values[-3:], dtype=float))
    if first * second <= 0:
        return order
    low, high = ORDER_BOUNDS
    for _ in range(60):
        middle = (low + high) / 2
        powers = sizes**-middle
        if (powers[0] - powers[1]) / (powers[1] - powers[2]) < first / second:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def compute_mesh_error(value: float, limit: float) -> float:
    """|v - limit| / |limit|; zero for a limit of zero that is met."""
    if value == limit:
        return 0.0
    return abs(value - limit) / max(abs(limit), abs(value))
