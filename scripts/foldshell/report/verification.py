"""Verification of all designs: what the independent code and a finer mesh say of each."""

from collections.abc import Sequence
from typing import Any

from foldshell.report.markup import Cell, Table, make_table

QUANTITIES = {
    "displacement_down_max_m": "displacement down",
    "displacement_max_m": "displacement",
    "work_knm": "work",
    "utilization_p99": "utilization, 99 %",
    "utilization_panel_mean_max": "utilization, panel mean",
    "buckling_factor": "buckling factor",
}

STEEL = {
    "steel_kg_m2": "steel, kg/m²",
    "steel_max_kn_m": "largest steel",
    "moment_max_knm_m": "moment",
    "shear_max_kn_m": "shear (open)",
}
"""Of the reinforcement."""


def make_verification(designs: Sequence[Any]) -> dict[str, Table]:
    """Return the largest difference between both codes, and the largest mesh error, in per cent,
    of each quantity and design."""
    compared = [
        (entry.name, *_differences(entry.comparison), *_steel_differences(entry.comparison),
         _judge(entry.comparison.outcome))
        for entry in designs
    ]  # fmt: skip
    errors = [
        (entry.name, *_errors(entry.convergence.errors),
         *_steel_errors(entry.convergence.reinforcement_errors))
        for entry in designs
    ]  # fmt: skip
    words = [f"{name} [%]" for name in QUANTITIES.values()]
    steel = [f"{name} [%]" for name in STEEL.values()]
    return {
        "comparison": make_table(["design", *words, *steel, "verdict"], compared),
        "mesh": make_table(["design", *words, *steel], errors),
    }


def _differences(comparison: Any) -> list[float | None]:
    found = {name: [] for name in QUANTITIES}
    for key, item in comparison.quantities.items():
        name = key.split(" ")[-1]
        if name in found:
            found[name].append(100 * item.relative_difference)
    return [max(values, default=None) for values in found.values()]


def _steel_differences(comparison: Any) -> list[float | None]:
    """Return those of the reinforcement, which do not decide the verdict."""
    steel = comparison.reinforcement
    known = {} if steel is None else steel.quantities
    return [100 * known[name].relative_difference if name in known else None for name in STEEL]


def _steel_errors(errors: dict[str, float] | None) -> list[float | None]:
    return [100 * errors[name] if errors and name in errors else None for name in STEEL]


def _errors(errors: dict[str, dict[str, float]]) -> list[float | None]:
    return [
        max((100 * one[name] for one in errors.values() if name in one), default=None)
        for name in QUANTITIES
    ]


def _judge(outcome: str) -> Cell:
    return Cell(outcome, {"pass": "good", "fail": "bad"}.get(outcome, ""))
