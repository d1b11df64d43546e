"""The values of one code: a value a mesh, and their limits."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from crosscheck.extrapolation import ORDER, extrapolate, measure_order

SECOND_ORDER = "Th.II"
"""Second-order values of combination S2 stand under `S2 Th.II`."""

SHEARED = "with shear"
"""First-order values with shear deformation stand under `S2 with shear`, in one code alone."""

NOT_SETTLED = None
"""Stands for a value whose iteration ended before it settled."""

SUPPORTS = "support_reactions_kn"
"""The reaction of each support by its name, one dictionary a mesh."""

KINDS: dict[str, tuple[str, str]] = {
    "displacement_down_max_m": ("displacement", "m"),
    "displacement_max_m": ("displacement", "m"),
    "work_knm": ("work", "kNm"),
    "utilization_p99": ("utilization_p99", "-"),
    "utilization_panel_mean_max": ("utilization_panel_mean", "-"),
    "buckling_factor": ("buckling_factor", "-"),
}
"""Scalar values of a combination: the tolerance each is held to, and its unit."""

NOT_EXTRAPOLATED = ("utilization_p99",)
"""A percentile of sampled peaks goes up and down from mesh to mesh (by 1 to 4 %): the finest
mesh stands, and what extrapolation would add is its mesh error."""


@dataclass(frozen=True)
class Code:
    """One code's values: `values[combination][name]` holds a value a mesh, coarse to fine.

    Second-order values stand under a combination of their own, `<combination> Th.II`.
    """

    subdivisions: Sequence[int]
    values: Mapping[str, Mapping[str, Any]]
    orders: Mapping[str, float]
    default_order: float

    @property
    def names(self) -> set[str]:
        """All quantities that some combination has."""
        return {name for values in self.values.values() for name in values}

    def limit(self, combination: str, name: str) -> tuple[float, float | None]:
        """The value that stands, and the order it was extrapolated with, None where it was not."""
        if name in NOT_EXTRAPOLATED:
            return float(self.values[combination][name][-1]), None
        return self.extrapolate(combination, name)

    def extrapolate(self, combination: str, name: str) -> tuple[float, float]:
        """The extrapolated value and its order."""
        values = self.values[combination][name]
        order = self.orders.get(name, self.default_order)
        order = measure_order(self.subdivisions, values, order)
        return extrapolate(self.subdivisions, values, order), order

    def extrapolate_reaction(self, combination: str, support: str) -> np.ndarray:
        """The extrapolated reaction of a support: (3,) in kN."""
        meshes = np.array([mesh[support] for mesh in self.values[combination][SUPPORTS]])
        order = self.default_order
        return np.array([extrapolate(self.subdivisions, row, order) for row in meshes.T])


def build_independent(
    subdivisions: Sequence[int], runs: Sequence[Mapping[str, Any]], order: float = ORDER
) -> Code:
    """This code's values from one `list_values` dictionary a mesh."""
    compared = [name for name in runs[0] if not name.endswith(SHEARED)]
    shared = [name for name in compared if all(name in run for run in runs)]
    values = {name: _collect([run[name] for run in runs]) for name in shared}
    return Code(subdivisions, values, {}, order)


def _collect(entries: Sequence[Mapping[str, Any]]) -> dict[str, list]:
    """One list a quantity from one dictionary a mesh."""
    return {name: [entry[name] for entry in entries] for name in entries[0]}
