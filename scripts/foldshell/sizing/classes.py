"""Group the thicknesses of panels into a few classes for fabrication."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]


@dataclass(frozen=True)
class ThicknessClasses:
    """Classes in rising order.

    `class_thickness` (K,) in m, `panel_class` (P,) from 1 to K, `thickness` (P,) in m of each
    panel's class, `added_volume` in m3 over the needed volume.
    """

    class_thickness: FloatArray
    panel_class: IntArray
    thickness: FloatArray
    added_volume: float


def group_thicknesses(needed: npt.ArrayLike, area: npt.ArrayLike, count: int) -> ThicknessClasses:
    """Minimise sum_p A_p (T_class(p) - t_p) over at most `count` classes with T_class(p) >= t_p.

    needed t (P,) in m and area A (P,) in m2. In rising order of t each class of an optimum is a
    run of panels, and its thickness the largest in it. So the least cost of the first j distinct
    thicknesses in k runs follows from those in k - 1 runs, c_k(j) = min_i c_(k-1)(i) +
    T_j (A_1 + ... + A_j - A_1 - ... - A_i): exact, O(count n^2) for n distinct thicknesses.
    Raises `ValueError` for values that are not finite and positive. Source: Fisher (1958), J. Am.
    Stat. Assoc. 53:789-798, on grouping in one dimension.
    """
    needed, area = np.asarray(needed, dtype=float), np.asarray(area, dtype=float)
    _check(needed, area, count)
    values, inverse = np.unique(needed, return_inverse=True)
    total = np.concatenate([[0.0], np.cumsum(np.bincount(inverse, weights=area))])
    ends = _find_runs(values, total, min(count, values.size))
    index = np.searchsorted(ends, inverse)
    class_thickness = values[ends]
    thickness = class_thickness[index]
    added = float(np.sum(area * (thickness - needed)))
    return ThicknessClasses(class_thickness, index + 1, thickness, added)


def _check(needed: FloatArray, area: FloatArray, count: int) -> None:
    if needed.ndim != 1 or needed.shape != area.shape or needed.size == 0:
        raise ValueError("one thickness and one area per panel are due")
    if not (np.isfinite(needed) & np.isfinite(area) & (needed > 0) & (area > 0)).all():
        raise ValueError("thicknesses and areas must be finite and above 0")
    if count < 1:
        raise ValueError("at least one class is due")


def _find_runs(values: FloatArray, total: FloatArray, count: int) -> IntArray:
    """Return the index of the last value of each of `count` runs of least cost.

    `total` (n + 1,) is the area of the first 0, 1, ..., n values.
    """
    size = values.size
    cost = values * total[1:]  # one run from the first value to each
    first = np.zeros((count, size), dtype=np.int64)
    for runs in range(1, count):
        shorter = cost
        cost = np.full(size, np.inf)
        for end in range(runs, size):
            starts = np.arange(runs, end + 1)
            tried = shorter[starts - 1] + values[end] * (total[end + 1] - total[starts])
            best = int(np.argmin(tried))
            cost[end], first[runs, end] = tried[best], starts[best]
    ends = np.empty(count, dtype=np.int64)
    end = size - 1
    for runs in range(count - 1, -1, -1):
        ends[runs] = end
        end = first[runs, end] - 1
    return ends
