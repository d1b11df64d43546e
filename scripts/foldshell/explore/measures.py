"""What a candidate of an exploration comes to: sizes of its sheet, limits that it breaks."""

from collections.abc import Mapping, Sequence

import numpy as np

from foldshell.records.candidate import SIZED, CandidateRecord
from foldshell.settings.exploration import SearchLimits

BOUNDS = {
    "plan_coverage_min": ("plan_coverage", 1),
    "edge_strain_max": ("edge_strain_max", -1),
    "planarity_max": ("planarity_max", -1),
    "depth_min_m": ("depth_m", 1),
    "depth_max_m": ("depth_m", -1),
    "buckling_factor_min": ("buckling_factor_min", 1),
}
"""Each limit by what it holds: 1 where it is the least value allowed, -1 the largest."""
GEOMETRIC = ("plan_coverage_min", "edge_strain_max", "planarity_max", "depth_min_m", "depth_max_m")
"""Limits that are known once a sheet is folded."""


def find_broken(values: Mapping[str, float | None], limits: SearchLimits) -> tuple[str, ...]:
    """Return the limits that a candidate breaks; what it has no value of breaks none of those."""
    broken = []
    for name, (key, sign) in BOUNDS.items():
        value = values.get(key)
        if value is not None and sign * (value - getattr(limits, name)) < 0:
            broken.append(name)
    return tuple(broken)


def count_broken(records: Sequence[CandidateRecord]) -> dict[str, int]:
    """Return how many candidates each limit has excluded, most first; states count as limits."""
    found: dict[str, int] = {}
    for record in records:
        for name in (*record.broken, *([record.state] if record.state != SIZED else [])):
            found[name] = found.get(name, 0) + 1
    return dict(sorted(found.items(), key=lambda item: (-item[1], item[0])))


def measure_depth(rest: np.ndarray) -> float:
    """Return the height of the folds (m) of a planar rest state: vertices (V, 3) m."""
    return float(np.ptp(rest[:, 2]))


def measure_creases(vertices: np.ndarray, edges: np.ndarray, folds: np.ndarray) -> float:
    """Return the length (m) of all folds.

    vertices (V, 3) m, edges (E, 2), folds (k,) rows of those that are creases
    """
    ends = vertices[edges[folds]]
    return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum())
