"""The history of a sizing loop, one row per iteration, and who changed what in it."""

from collections.abc import Sequence
from dataclasses import fields

import numpy as np

from foldshell.records.analysis import AnalysisRecord
from foldshell.records.history import HistoryRow
from foldshell.sizing.rounding import FloatArray

COPIED = tuple(
    {one.name for one in fields(HistoryRow)}
    & {one.name for one in fields(AnalysisRecord)} - {"edited", "edited_panels"}
)
"""Columns that are those of the analysis."""


def make_history(
    analyses: Sequence[AnalysisRecord],
    thicknesses: Sequence[FloatArray] | None = None,
    displacement_limit: float | None = None,
) -> list[HistoryRow]:
    """Return one row per iteration.

    `thicknesses` are those that each analysis read, (P,) m each; `displacement_limit` is in m.
    """
    rows: list[HistoryRow] = []
    for index, analysis in enumerate(analyses):
        thickness = {} if thicknesses is None else _measure_thickness(thicknesses[index])
        changed = len(analysis.edited_panels or ())
        rows.append(
            HistoryRow(
                **{name: getattr(analysis, name) for name in COPIED},
                edited="edited" if analysis.edited else None,
                edited_panels=changed or None,
                volume_change_m3=analysis.volume_m3 - rows[-1].volume_m3 if rows else None,
                displacement_limit_m=displacement_limit,
                buckling_factor_min=analysis.least_factor,
                **thickness,
            )
        )
    return rows


def _measure_thickness(thickness: FloatArray) -> dict[str, float]:
    return {
        "thickness_min_m": float(np.min(thickness)),
        "thickness_mean_m": float(np.mean(thickness)),
        "thickness_max_m": float(np.max(thickness)),
    }


def collect_edited_panels(analyses: Sequence[AnalysisRecord]) -> set[int]:
    """Return the panels that a person has changed in some iteration."""
    return {panel for one in analyses for panel in one.edited_panels or ()}
