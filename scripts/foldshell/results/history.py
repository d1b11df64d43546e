"""The history of a sizing loop as plain rows, one per iteration."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from foldshell.sizing.rounding import FloatArray

Row = Mapping[str, Any]

HISTORY_KEYS = (
    "iteration",
    "verdict",
    "edited",
    "volume_m3",
    "volume_change_m3",
    "utilization_max",
    "utilization_p99",
    "utilization_panel_mean_max",
    "panels_above_one",
    "panels_at_bound",
    "displacement_vertical_max_m",
    "displacement_limit_m",
    "buckling_factor_min",
    "thickness_min_m",
    "thickness_mean_m",
    "thickness_max_m",
    "second_order_iterations",
    "reaction_imbalance",
    "reason",
)
EDGE_BEAM_KEYS = ("edge_beam_utilization_max", "edge_beam_utilization_panel_mean_max")
"""Columns after `reason` where a design has an edge beam."""


def find_least_factor(analysis: Mapping[str, Any]) -> float | None:
    """Return the least buckling factor of all combinations, None where none was found."""
    factors = analysis.get("buckling_factor") or {}
    values = [float(factor) for factor in factors.values() if factor is not None]
    return min(values) if values else None


def make_history(
    analyses: Sequence[Mapping[str, Any]],
    thicknesses: Sequence[FloatArray] | None = None,
    displacement_limit: float | None = None,
    edited: Sequence[int] = (),
) -> list[dict[str, Any]]:
    """Return one row per iteration from the contents of its `analysis.json`.

    `thicknesses` are those that each analysis read (m), `displacement_limit` is in m, and
    `edited` holds the iterations whose workbook a person has changed.

    Each of `thicknesses` is (P,).
    """
    rows: list[dict[str, Any]] = []
    for index, analysis in enumerate(analyses):
        row = {key: analysis.get(key) for key in HISTORY_KEYS}
        row |= {key: analysis[key] for key in EDGE_BEAM_KEYS if key in analysis}
        before = rows[-1]["volume_m3"] if rows else None
        if before is not None and row["volume_m3"] is not None:
            row["volume_change_m3"] = row["volume_m3"] - before
        row["displacement_limit_m"] = displacement_limit
        row["buckling_factor_min"] = find_least_factor(analysis)
        row["second_order_iterations"] = _largest(analysis.get("second_order_iterations"))
        row["edited"] = "edited" if row["iteration"] in edited else None
        if thicknesses is not None:
            row["thickness_min_m"] = float(np.min(thicknesses[index]))
            row["thickness_mean_m"] = float(np.mean(thicknesses[index]))
            row["thickness_max_m"] = float(np.max(thicknesses[index]))
        rows.append(row)
    return rows


def _largest(value: Any) -> Any:
    """Return the largest entry of counts by combination, or the one count there is."""
    if isinstance(value, Mapping):
        return max((count for count in value.values() if count is not None), default=None)
    return value


def choose_keys(rows: Sequence[Row]) -> tuple[str, ...]:
    """Return the columns of a history: those of the edge beam only where some row has them."""
    return HISTORY_KEYS + tuple(key for key in EDGE_BEAM_KEYS if any(key in row for row in rows))
