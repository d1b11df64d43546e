"""The result of a design, its uncertainty, and designs that differ in one thing only."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from itertools import pairwise
from typing import Any

import numpy as np

from foldshell.claims.finding import (
    FAILS,
    HOLDS,
    Finding,
    combine_errors,
    judge_difference,
)
from foldshell.records.design_row import DesignRow
from foldshell.records.entry import Entry, entries
from foldshell.records.measures import Geometry, Measures
from foldshell.records.quality import QualityMeasures, QualityRecord
from foldshell.settings.sizing import Sizing

QUANTITIES = {
    "volume_per_area": "volume",
    "volume": "volume",
    "displacement": "displacement",
    "displacement_edge": "displacement",
    "displacement_inner": "displacement",
    "utilization_mean": "utilization",
    "utilization_variation": "utilization",
    "utilization_panel_mean_max": "utilization",
    "buckling_factor": "buckling",
    "strength_factor": "utilization",
    "steel_kg_m2": "steel",
    "depth": "geometry",
    "panel_area": "geometry",
    "edge_strain_rms": "geometry",
    "angle_defect_max_rad": "geometry",
    "flat_foldability_max_rad": "geometry",
}
"""What error a quantity inherits."""
STAND_INS = {
    "utilization_mean": ("utilization_reinforced_mean", "utilization_strip_mean"),
    "utilization_variation": ("utilization_reinforced_variation", "utilization_strip_variation"),
    "utilization_panel_mean_max": ("utilization_reinforced_max", "utilization_strip_max"),
}
"""Measures that stand in for others where a loop sized as reinforced concrete, or by strips."""


def describe_quantity(quantity: str) -> Entry | None:
    """Return what a record says of a quantity, None for what none knows, such as counts."""
    known = {**entries(QualityMeasures), **entries(Measures)}
    return known[quantity] if quantity in QUANTITIES else None


def find_unit(quantity: str) -> str:
    """Return the unit that a quantity has in files, - for what no record knows."""
    about = describe_quantity(quantity)
    return about.unit if about else "-"


@dataclass(frozen=True)
class DesignResult:
    """A design and what came of it.

    `values` are the measures of its state, of a sheet that was only folded those of its geometry;
    `errors` the relative mesh error and cross-check difference of displacement, utilization and
    buckling, or of single quantities (None where unknown), `panels` (2, P) planarity and
    utilization, `warning` what theory or mesh does not hold of its final state, `strips` the
    utilization of that state by strips.
    """

    row: DesignRow
    values: Measures | Geometry
    errors: Mapping[str, tuple[float | None, float | None]] = field(default_factory=dict)
    quality: QualityRecord | None = None
    panels: np.ndarray | None = None
    warning: str | None = None
    strips: Mapping[str, float] | None = None

    def measure(self, quantity: str) -> float | None:
        """Return a quantity by its name, None where it was not measured.

        Of a loop that sized by strips or as reinforced concrete the utilization is that of it.
        """
        for name in (*STAND_INS.get(quantity, ()), quantity):
            value = getattr(self.values, name, None)
            if value is not None:
                return value
        return getattr(self.quality, quantity, None)

    @property
    def by_strips(self) -> "DesignResult":
        """The same state, its utilization that of strips."""
        return replace(self, values=replace(self.values, **self.strips or {}))

    @property
    def name(self) -> str:
        """Name of the design."""
        return self.row.design

    @property
    def panel_count(self) -> int:
        """Panels between the polylines."""
        return self.row.panels


def estimate_uncertainty(
    design_result: DesignResult, quantity: str, volume_step: float
) -> float | None:
    """Return the uncertainty of a quantity in its own unit, None where it is not known.

    Mesh error and cross-check difference as root of the sum of squares. Volume inherits the
    larger of those of displacement and utilization, since a thickness follows either at most in
    proportion, and the change of volume `volume_step` that ends the loop, or the last one where
    that is larger; both on the share of panels that do not stand at a bound.
    """
    value, kind = design_result.measure(quantity), QUANTITIES[quantity]
    if value is None:
        return None
    if kind == "geometry":
        return 0.0
    if kind != "volume":
        known = design_result.errors.get(quantity, design_result.errors.get(kind, (None, None)))
        relative = combine_errors(*known)
        return None if relative is None else abs(value) * relative
    at_bound = design_result.values.panels_at_bound
    if at_bound is None:
        return None
    free = 1 - at_bound / design_result.panel_count
    if free == 0:
        return 0.0
    errors = [combine_errors(*design_result.errors.get(name, (None, None)))
              for name in ("displacement", "utilization")]  # fmt: skip
    step = max(volume_step, design_result.values.volume_change or 0.0)
    relative = None if None in errors else combine_errors(max(errors), step)
    return None if relative is None else abs(value) * free * relative


@dataclass(frozen=True)
class Comparer:
    """Compares designs by limits of the loop: the relative change of volume that ends it, the
    span over the displacement allowed, least mean utilization and least buckling factor."""

    volume_step: float = 0.01
    displacement_span_over: float = 240.0
    utilization_min: float = 0.6
    buckling_factor_min: float = 1.5

    def compare(
        self,
        part: str,
        greater: DesignResult,
        lesser: DesignResult,
        quantity: str,
        strict: bool = True,
    ) -> Finding:
        """Find whether a quantity of `greater` exceeds that of `lesser` beyond uncertainty."""
        names = greater.name, lesser.name
        both = [(greater, quantity), (lesser, quantity)]
        return self._compare(part, names, quantity, both, strict)

    def compare_within(
        self, part: str, design_result: DesignResult, greater: str, lesser: str
    ) -> Finding:
        """Find whether one quantity of a design exceeds another of the same unit."""
        both = [(design_result, greater), (design_result, lesser)]
        return self._compare(part, (design_result.name,), f"{greater}, {lesser}", both)

    def _compare(
        self,
        part: str,
        designs: tuple[str, ...],
        quantity: str,
        both: Sequence[tuple[DesignResult, str]],
        strict: bool = True,
    ) -> Finding:
        greater, lesser = (design_result.measure(name) for design_result, name in both)
        uncertainty = combine_errors(
            *(
                estimate_uncertainty(design_result, name, self.volume_step)
                for design_result, name in both
            )
        )
        unit = find_unit(both[0][1])
        verdict = judge_difference(greater, lesser, uncertainty, strict)
        return Finding(part, designs, quantity, unit, (greater, lesser), uncertainty, verdict)


def make_comparer(sizing: Sizing) -> Comparer:
    """Return the comparer with the limits of the loop."""
    return Comparer(
        sizing.volume_change_max_relative,
        sizing.displacement_limit_span_over,
        sizing.utilization_min,
        sizing.thinning_buckling_factor_min,
    )


def state_fact(
    part: str, design: str, quantity: str, value: float | None, limit: float, true: bool
) -> Finding:
    """Return a finding that is counted, not measured: it has no uncertainty."""
    unit, verdict = find_unit(quantity), HOLDS if true else FAILS
    return Finding(part, (design,), quantity, unit, (value, limit), 0.0, verdict)


def select(design_results: Iterable[DesignResult], **columns: Any) -> list[DesignResult]:
    """Return the results whose columns have these values; a tuple allows several."""

    def fits(design_result: DesignResult) -> bool:
        """Tell whether a result has all of the values."""
        return all(
            getattr(design_result.row, name) in (value if isinstance(value, tuple) else (value,))
            for name, value in columns.items()
        )

    return [design_result for design_result in design_results if fits(design_result)]


def select_folded(design_results: Iterable[DesignResult]) -> list[DesignResult]:
    """Return the designs folded as in the paper."""
    return select(design_results, pattern="miura", fold_mode="elastic")


def group_by_others(
    design_results: Iterable[DesignResult], column: str
) -> list[dict[Any, DesignResult]]:
    """Return groups of designs that differ in one column only, {its value: result}, sorted."""
    groups: dict[tuple, dict[Any, DesignResult]] = {}
    for design_result in design_results:
        row = design_result.row
        others = tuple(
            getattr(row, one.name) for one in fields(row)
            if one.name not in ("design", "tags", column)
        )  # fmt: skip
        groups.setdefault(others, {})[getattr(row, column)] = design_result
    return [dict(sorted(group.items())) for group in groups.values() if len(group) > 1]


def pair_neighbours(
    design_results: Sequence[DesignResult], column: str
) -> list[tuple[DesignResult, DesignResult]]:
    """Return (lower, higher) pairs, neighbours in the order of a column of numbers."""
    return [pair for group in group_by_others(design_results, column)
            for pair in pairwise(group.values())]  # fmt: skip
