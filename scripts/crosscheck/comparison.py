"""Two codes side by side: limits, differences, tolerances, mesh errors."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from crosscheck.extrapolation import (
    ORDER,
    compute_mesh_error,
    extrapolate,
    measure_order,
)
from crosscheck.reading import Place
from crosscheck.records import MULTIFRONTAL, Comparison, Limit, Quantity

SECOND_ORDER = "Th.II"
"""Second-order values of combination S2 stand under `S2 Th.II`."""

NOT_SETTLED = None
"""Stands for a value whose iteration ended before it settled."""

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

TOLERANCES = {
    "displacement": 0.04,
    "work": 0.04,
    "utilization_p99": 0.08,
    "utilization_panel_mean": 0.08,
    "buckling_factor": 0.08,
    "reaction": 1e-6,
    "reaction_balance": 1e-6,
}
"""Relative. Displacement and work: two limits of 1 to 2.5 % each; utilization and buckling factor
follow derivatives and modes, which settle later; reactions are statics, where only rounding may
differ."""


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


def build_independent(
    subdivisions: Sequence[int], runs: Sequence[Mapping[str, Any]], order: float = ORDER
) -> Code:
    """This code's values from one `list_values` dictionary a mesh."""
    shared = [name for name in runs[0] if all(name in run for run in runs)]
    values = {name: _collect([run[name] for run in runs]) for name in shared}
    return Code(subdivisions, values, {}, order)


def _collect(entries: Sequence[Mapping[str, Any]]) -> dict[str, list]:
    """One list a quantity from one dictionary a mesh."""
    return {name: [entry[name] for entry in entries] for name in entries[0]}


def compare(
    primary: Code, independent: Code, tolerances: Mapping[str, float], solver: str = MULTIFRONTAL
) -> Comparison:
    """Quantity by quantity: both limits, relative difference, tolerance, pass; and mesh errors.

    Compared is what both codes give; what only one gives is listed as `not_compared`. What this
    code has not settled on some mesh, and the other gives, is listed as `not_settled`: there is
    no number to compare, and the comparison fails.
    """
    allowed = TOLERANCES | read_tolerances(tolerances)
    quantities: dict[str, Quantity] = {}
    not_settled: list[str] = []
    missing = [name for name in primary.values if name not in independent.values]
    for combination, values in independent.values.items():
        given = primary.values.get(combination, {})
        for name in values:
            if name not in given:
                missing.append(f"{combination} {name}")
            elif name in KINDS:
                label = f"{combination} {name}"
                if NOT_SETTLED in values[name]:
                    not_settled.append(label)
                    continue
                quantities[label] = _compare_scalar(
                    primary, independent, combination, name, allowed
                )
        if "reaction_sum_kn" in values and "reaction_sum_kn" in given:
            quantities |= _compare_reactions(given, values, combination, allowed)
    agree = bool(quantities) and all(entry.passed for entry in quantities.values())
    return Comparison(
        passed=agree and not not_settled,
        quantities=quantities,
        not_compared=missing,
        not_settled=not_settled,
        primary_subdivisions=list(primary.subdivisions),
        independent_subdivisions=list(independent.subdivisions),
        solver=solver,
    )


def read_tolerances(tolerances: Mapping[str, float]) -> dict[str, float]:
    """The tolerances given; raises CrosscheckError for an unknown name or a value not above 0."""
    place = Place("crosscheck", "tolerance", dict(tolerances))
    for name in place.names():
        if name not in TOLERANCES:
            place.refuse(name, "one of " + ", ".join(TOLERANCES))
    return {name: place.key(name).number(above=0.0) for name in place.names()}


def _compare_scalar(
    primary: Code, independent: Code, combination: str, name: str, allowed: Mapping[str, float]
) -> Limit:
    kind, unit = KINDS[name]
    codes = {"primary": primary, "independent": independent}
    limits = {label: code.limit(combination, name) for label, code in codes.items()}
    first, second = (value for value, _ in limits.values())
    judged = _judge(first, second, max(abs(first), abs(second)), allowed[kind], unit)
    more: dict[str, Any] = {}
    for label, code in codes.items():
        meshes = [float(value) for value in code.values[combination][name]]
        aim = code.extrapolate(combination, name)[0]
        more[f"{label}_meshes"] = meshes
        more[f"{label}_order"] = limits[label][1]
        more[f"{label}_mesh_error"] = compute_mesh_error(meshes[-1], aim)
    return Limit(**vars(judged), **more)


def _compare_reactions(
    given: Mapping[str, Any], own: Mapping[str, Any], combination: str, allowed: Mapping[str, float]
) -> dict[str, Quantity]:
    """Finest mesh: each component against the other code's, and each code's own balance."""
    first, second = (np.array(values["reaction_sum_kn"][-1], float) for values in (given, own))
    scale = max(np.linalg.norm(first), np.linalg.norm(second))
    entries = {
        f"{combination} reaction_{axis}_kn": _judge(
            first[k], second[k], scale, allowed["reaction"], "kN"
        )
        for k, axis in enumerate("xyz")
    }
    defect = [
        np.linalg.norm(np.add(values["reaction_sum_kn"], values["load_sum_kn"]), axis=1).max()
        / np.linalg.norm(values["load_sum_kn"], axis=1).max()
        for values in (given, own)
    ]
    balance = _judge(defect[0], defect[1], 1.0, allowed["reaction_balance"], "-")
    kept = bool(max(defect) <= balance.tolerance)
    balance = replace(balance, relative_difference=float(max(defect)), passed=kept)
    return entries | {f"{combination} reaction_imbalance": balance}


def _judge(
    primary: float, independent: float, scale: float, tolerance: float, unit: str
) -> Quantity:
    difference = abs(primary - independent) / scale if scale > 0 else 0.0
    return Quantity(
        primary=float(primary),
        independent=float(independent),
        relative_difference=float(difference),
        tolerance=float(tolerance),
        passed=bool(difference <= tolerance),
        unit=unit,
    )
