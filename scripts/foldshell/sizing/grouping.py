"""Group the sized panels into thickness classes and analyse the grouped design."""

from dataclasses import fields, replace

import numpy as np

from foldshell.records.analysis import AnalysisRecord, Criteria, ShellState
from foldshell.records.analysis_arrays import AnalysisArrays, ClassesArrays
from foldshell.records.classes import ClassesRecord, ThicknessClass
from foldshell.shell.effort import USUAL
from foldshell.shell.results import panel_area
from foldshell.sizing.buildable import list_buildable, round_up
from foldshell.sizing.classes import ThicknessClasses, group_thicknesses
from foldshell.sizing.iteration import AnalysisCase, IterationTask
from foldshell.sizing.rounding import round_thickness

CRITERIA = ("utilization_panel_mean", "utilization_element_max", "utilization_strip",
            "utilization_reinforced", "displacement_vertical_m",
            "edge_beam_utilization")  # fmt: skip
"""What a grouped design has to keep; changes of volume mean nothing to it."""

ROUNDS_MAX = 6
"""How often panels above the limit are thickened and grouped anew."""

SAFETY = 1.005
"""Factor on a raised thickness, so that rounds end."""


def analyse_classes(
    case: AnalysisCase,
    span: float,
    last: AnalysisRecord,
    arrays: AnalysisArrays,
    count: int,
) -> tuple[ClassesRecord, ClassesArrays]:
    """Return what classes.json and classes.npz hold.

    Panels that grew draw forces to them. Where that puts a panel above the limit, which the sized
    design kept, its needed thickness is raised by its utilization and all are grouped anew.

    Parameters
    ----------
    span : m
    last, arrays : of the last iteration
    count : classes allowed
    """
    area = panel_area(case.model)[: case.model.sized_panels]
    limit = case.sizing.utilization_max
    needed, buildable = arrays.thickness, list_buildable(case.sizing)
    before = AnalysisArrays(thickness=np.empty(0), buckling_modes=arrays.buckling_modes)
    for raised in range(ROUNDS_MAX + 1):
        groups = group_thicknesses(round_up(needed, buildable), area, count)
        thickness = round_thickness(groups.thickness)
        task = IterationTask(last.iteration, span, thickness, None, before)
        found, its_arrays = replace(case, factor_min=None).run(task, effort=USUAL)
        used = its_arrays.utilization(case.sizing.measure)
        share = np.zeros(1) if used is None else used / limit
        if found.state != "ok" or share.max() <= 1 or raised == ROUNDS_MAX:
            break
        more = np.where(share > 1, thickness * share * SAFETY, needed)
        needed = round_thickness(np.clip(more, needed, case.sizing.largest_thickness))
    verdict, reason, criteria = _judge(found)
    record = ClassesRecord(
        **{one.name: getattr(found, one.name) for one in fields(ShellState)},
        verdict=verdict,
        reason=reason,
        criteria=criteria,
        count=count,
        rounds=raised,
        classes=_describe(groups, area),
        ungrouped_volume_m3=last.volume_m3,
        added_volume_relative=found.volume_m3 / last.volume_m3 - 1,
        seconds=found.seconds,
    )
    mean = its_arrays.utilization_panel_mean
    return record, ClassesArrays(
        utilization_panel_mean=mean, thickness=thickness, panel_class=groups.panel_class
    )


def _judge(found: AnalysisRecord) -> tuple[str, str, Criteria]:
    """Return verdict (holds, fails or the state without an answer), reason and criteria."""
    if found.state != "ok":
        return found.state, found.reason, Criteria()
    criteria = found.criteria.select(CRITERIA)
    broken = [
        f"{about.key} {item.value:.4g} beyond {item.limit:.4g}"
        for about, item in criteria.items()
        if not item.met
    ]
    return "fails" if broken else "holds", "; ".join(broken) or "all criteria are met", criteria


def _describe(groups: ThicknessClasses, area: np.ndarray) -> tuple[ThicknessClass, ...]:
    """Return number, thickness (m), panels and area (m2) of each class."""
    return tuple(
        ThicknessClass(
            number=number,
            thickness_m=float(thickness),
            panels=int((groups.panel_class == number).sum()),
            area_m2=float(area[groups.panel_class == number].sum()),
        )
        for number, thickness in enumerate(groups.class_thickness, start=1)
    )
