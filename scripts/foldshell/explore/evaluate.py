"""From columns of a design to a sized shell in memory: pattern, fold, mesh, thickness loop."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from foldshell.explore.folded import (
    FoldedCandidate,
    fold_candidate,
    make_design,
    measure_sheet,
    pack_geometry,
)
from foldshell.explore.judge import judge_loop
from foldshell.explore.measures import GEOMETRIC, find_broken
from foldshell.records.analysis import AnalysisRecord
from foldshell.records.candidate import SIZED, CandidateRecord, ScreenedRecord
from foldshell.settings.design import leave_out_names
from foldshell.settings.exploration import ENGINEERING, PAPER, Exploration, list_sizing
from foldshell.settings.sizing import REINFORCED
from foldshell.settings.stage import StageSettings
from foldshell.sizing.case import AnalysisCase, make_case
from foldshell.sizing.iteration import IterationTask
from foldshell.sizing.loop import run_loop

CHEAP_SUBDIVISIONS = 1
CHEAP_EXPONENT, CHEAP_UTILIZATION = 0.7, 0.8
"""How thickness goes with utilization at fixed forces, between a plate in bending (1/2) and a
membrane (1), and what the dead band leaves in the mean."""


def choose_settings(settings: StageSettings, exploration: Exploration) -> StageSettings:
    """Return the settings of the search: rule, measure, and the buckling factor that it keeps."""
    changed = settings.sizing.changed(**list_sizing(exploration, settings.sizing))
    return settings.changed(changed)


def prepare_case(folded: FoldedCandidate, settings: StageSettings, n: int) -> AnalysisCase:
    """Mesh a folded candidate with n subdivisions and open it for analyses."""
    return open_mesh(folded.mesh(n), settings, n)


def open_mesh(mesh: Mapping[str, np.ndarray], settings: StageSettings, n: int) -> AnalysisCase:
    """Open the arrays of mesh.npz with n subdivisions for analyses."""
    return make_case(mesh, settings.changed(settings.analysis.changed(subdivisions=n)))


def estimate_volume(folded: FoldedCandidate, settings: StageSettings) -> float:
    """V = sum A t0 clip((u / 0.8)^0.7, t_min / t0, t_max / t0) from one analysis at t0, n = 1 [m3].

    A cheap answer that ranks designs; nan where that analysis finds no state.
    """
    sizing = settings.sizing
    if sizing.measure == REINFORCED:  # one analysis ranks by the paper's measure
        settings = settings.changed(sizing.changed(measure="panel_mean"))
    case = prepare_case(folded, settings, CHEAP_SUBDIVISIONS)
    start = sizing.start_thickness
    thickness = np.full(case.model.sized_panels, start)
    _, arrays = case.run(IterationTask(0, folded.design.span, thickness))
    used = arrays.utilization_panel_mean
    if used is None:
        return float("nan")
    wish = np.clip(start * (used / CHEAP_UTILIZATION) ** CHEAP_EXPONENT, *sizing.bounds)
    return float(folded.panel_area @ wish)


def evaluate(
    name: str, row: Mapping[str, object], settings: StageSettings, exploration: Exploration
) -> CandidateRecord:
    """Size one candidate; whatever becomes of it is a record with its reason.

    row : columns of designs.tsv; `settings` : Pattern, Fold and those of an analysis
    """
    search = exploration.search
    blank = CandidateRecord(
        candidate=name, columns=leave_out_names(row), state="crumpled", reason="", feasible=False,
        broken=(), mesh_subdivisions=search.subdivisions,
    )  # fmt: skip
    settings = choose_settings(settings, exploration)
    try:
        folded = fold_candidate(make_design(dict(row), exploration.supports), settings)
        record = replace(blank, **measure_sheet(folded), geometry=pack_geometry(folded))
        if folded.state == "crumpled":
            return _finish(replace(record, reason=folded.reason), exploration)
        record = replace(record, cheap_m3=_finite(estimate_volume(folded, settings)))
        record = _size(record, folded, settings, exploration)
    except ValueError as error:
        return replace(blank, state="not_reached", reason=str(error))
    return _finish(record, exploration)


def screen(
    row: Mapping[str, object], settings: StageSettings, exploration: Exploration
) -> ScreenedRecord:
    """Fold a candidate and analyse it once: what it promises, and which limits it breaks.

    row : columns of designs.tsv; `settings` : Pattern, Fold and those of an analysis
    """
    columns = leave_out_names(row)
    settings = choose_settings(settings, exploration)
    try:
        folded = fold_candidate(make_design(dict(row), exploration.supports), settings)
        broken = find_broken(measure_sheet(folded), exploration.limits)
        if folded.state == "crumpled":
            return ScreenedRecord(
                columns=columns, cheap_m3=None, broken=("crumpled",), reason=folded.reason
            )
        cheap = _finite(estimate_volume(folded, settings))
    except ValueError as error:
        return ScreenedRecord(columns=columns, cheap_m3=None, broken=(), reason=str(error))
    return ScreenedRecord(
        columns=columns, cheap_m3=cheap, broken=tuple(name for name in broken if name in GEOMETRIC)
    )


def _size(
    record: CandidateRecord,
    folded: FoldedCandidate,
    settings: StageSettings,
    exploration: Exploration,
) -> CandidateRecord:
    mesh = folded.mesh(exploration.search.subdivisions)
    case = open_mesh(mesh, settings, exploration.search.subdivisions)
    loop = run_loop(case, folded.design.span, settings.sizing)
    final = loop.final
    judged = {}
    if exploration.needs_engineering and final.state == "ok":
        judged = judge_loop(case, loop, settings, mesh, folded.design.span)
    if folded.state != "ok":
        state, reason = folded.state, folded.reason
    else:
        state, reason = _judge(final), final.reason
    return replace(
        record,
        state=state,
        reason=reason,
        verdict=final.verdict,
        area_m2=final.area_m2,
        volume_m3=final.volume_m3,
        buckling_factor_min=find_least_factor(final),
        displacement_vertical_max_m=final.displacement_vertical_max_m,
        utilization_panel_mean_max=final.utilization_panel_mean_max,
        iterations=len(loop.analyses),
        **judged,
    )


def _judge(final: AnalysisRecord) -> str:
    """Return the state of a sized candidate: a verdict of success, or what became of it."""
    if final.verdict in ("converged", "at_minimum_thickness"):
        return SIZED
    return final.verdict if final.state == "ok" else final.state


def find_least_factor(final: AnalysisRecord) -> float | None:
    """Return the least buckling factor of all combinations, None where nothing buckles."""
    factors = [factor for factor in final.buckling_factor.values() if factor is not None]
    return min(factors, default=None)


def _finish(record: CandidateRecord, exploration: Exploration) -> CandidateRecord:
    broken = find_broken(vars(record), exploration.limits)
    asked = exploration.limits.verdicts
    if asked != PAPER and record.engineering not in (None, "passes"):
        broken = (*broken, "engineering")
    ended = (SIZED, "not_converged") if asked == ENGINEERING else (SIZED,)
    return replace(record, broken=broken, feasible=record.state in ended and not broken)


def _finite(value: float) -> float | None:
    return value if np.isfinite(value) else None
