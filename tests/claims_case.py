"""Outcomes of designs made by hand, for the tests of the claims."""

from typing import Any

import numpy as np

from foldshell.claims.design_result import DesignResult
from foldshell.records.design_row import DesignRow, make_design_row
from foldshell.records.measures import Measures

ERRORS = {name: (0.03, 0.04) for name in ("displacement", "utilization", "buckling")}
"""Mesh error 3 % and cross-check difference 4 %: 5 % together."""

VALUES = {
    "state": "converged", "reason": "", "iterations": 15, "volume": 80.0, "volume_per_area": 0.05,
    "volume_change": None, "displacement": 0.05, "buckling_factor": 10.0, "utilization_mean": 0.4,
    "utilization_max": 2.0, "utilization_panel_mean_max": 0.95, "panels_above_one": 0,
    "panels_at_bound": 0, "panel_area": 2.0, "utilization_variation": 0.5, "above_one": 0,
    "above_one_at_free_edge": 0, "displacement_edge": 0.05, "displacement_inner": 0.03,
    "depth": 1.9, "edge_strain_rms": 0.01,
}  # fmt: skip


def make_row(design: str | None = None, **columns: Any) -> DesignRow:
    """Return the columns of designs.tsv; the name is made of them unless given."""
    row = {
        "pattern": "miura", "surface": "paraboloid", "span_m": 28.0, "height_m": 10.0,
        "zigzag": 15, "strip": 16, "support": "all", "fold_mode": "elastic", "tags": "table1",
    } | columns  # fmt: skip
    name = "-".join(str(row[k]) for k in ("pattern", "surface", "height_m", "zigzag", "strip",
                                          "support", "fold_mode"))  # fmt: skip
    return make_design_row({"design": design or name.replace(".", "_")} | row)


def make_design_result(values: dict[str, Any] | None = None, **columns: Any) -> DesignResult:
    """Return an design_result with 5 % uncertainty; `columns` say which design it is."""
    panels = np.stack([np.linspace(0.0, 0.04, 20), np.linspace(0.9, 0.2, 20)])
    measures = Measures(**VALUES | (values or {}))
    return DesignResult(make_row(**columns), measures, ERRORS, None, panels)
