"""Group the sized panels into thickness classes and analyse the grouped design."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from foldshell.shell.results import panel_area
from foldshell.sizing.classes import ThicknessClasses, group_thicknesses
from foldshell.sizing.iteration import AnalysisCase, IterationTask
from foldshell.sizing.rounding import round_thickness

CRITERIA = ("utilization_max", "displacement_vertical_m", "edge_beam_utilization")
"""What a grouped design has to keep; changes of volume mean nothing to it."""

ROUNDS_MAX = 6
"""How often panels above the limit are thickened and grouped anew."""

SAFETY = 1.005
"""Factor on a raised thickness, so that rounds end."""

LEFT_OUT = ("stationary_iterations", "utilization_min", "verdict", "reason", "criteria")


def analyse_classes(
    case: AnalysisCase,
    span: float,
    last: Mapping[str, Any],
    arrays: Mapping[str, np.ndarray],
    count: int,
) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Return the contents of classes.json and classes.npz.

    Panels that grew draw forces to them. Where that puts a panel above the limit, which the sized
    design kept, its needed thickness is raised by its utilization and all are grouped anew.

    Parameters
    ----------
    span : m
    last, arrays : contents of analysis.json and analysis.npz of the last iteration
    count : classes allowed
    """
    area = panel_area(case.model)[: case.model.sized_panels]
    limit = case.sizing.utilization_max
    needed = arrays["thickness"]
    before = {"buckling_modes": arrays["buckling_modes"]} if "buckling_modes" in arrays else {}
    for raised in range(ROUNDS_MAX + 1):
        groups = group_thicknesses(needed, area, count)
        thickness = round_thickness(groups.thickness)
        task = IterationTask(last["iteration"], span, thickness, {}, before)
        found, fields = replace(case, factor_min=None).run(task)
        share = fields.get(f"utilization_{case.sizing.measure}", np.zeros(1)) / limit
        if found["state"] != "ok" or share.max() <= 1 or raised == ROUNDS_MAX:
            break
        more = np.where(share > 1, thickness * share * SAFETY, needed)
        raised_to = np.minimum(np.maximum(needed, more), case.sizing.largest_thickness)
        needed = round_thickness(raised_to)
    report = {
        **_judge(found),
        "count": count,
        "rounds": raised,
        "classes": _describe(groups, area),
        "ungrouped_volume_m3": last["volume_m3"],
        "added_volume_relative": found["volume_m3"] / last["volume_m3"] - 1,
        **{name: value for name, value in found.items() if name not in LEFT_OUT},
    }
    kept = {name: values for name, values in fields.items() if name.startswith("utilization_panel")}
    kept |= {"thickness": thickness, "panel_class": groups.panel_class}
    return report, kept


def _judge(found: Mapping[str, Any]) -> dict[str, Any]:
    """Return verdict (holds, fails or unstable), reason and criteria."""
    if found["state"] != "ok":
        return {"verdict": found["state"], "reason": found["reason"], "criteria": {}}
    criteria = {name: item for name, item in found["criteria"].items() if name in CRITERIA}
    broken = [
        f"{name} {item['value']:.4g} beyond {item['limit']:.4g}"
        for name, item in criteria.items()
        if not item["met"]
    ]
    verdict = "fails" if broken else "holds"
    reason = "; ".join(broken) or "all criteria are met"
    return {"verdict": verdict, "reason": reason, "criteria": criteria}


def _describe(groups: ThicknessClasses, area: np.ndarray) -> list[dict[str, Any]]:
    """Return number, thickness (m), panels and area (m2) of each class."""
    return [
        {
            "class": number,
            "thickness_m": float(thickness),
            "panels": int((groups.panel_class == number).sum()),
            "area_m2": float(area[groups.panel_class == number].sum()),
        }
        for number, thickness in enumerate(groups.class_thickness, start=1)
    ]
