"""From one analysed iteration to the thicknesses of the next."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from foldshell.records.analysis import AnalysisRecord, Criterion
from foldshell.records.analysis_arrays import AnalysisArrays, StepMemory
from foldshell.settings.sizing import Sizing
from foldshell.sizing.buildable import list_buildable, round_up, step_to_buildable
from foldshell.sizing.constraints import NEED_CONSTRAINTS, Constraints, read_constraints
from foldshell.sizing.filtered import filtered_dead_band
from foldshell.sizing.optimality import optimality
from foldshell.sizing.panel_limits import (
    PanelLimits,
    bound_panels,
    hold_limits,
    index_groups,
    limits_of,
)
from foldshell.sizing.pooling import pool_state, spread_state
from foldshell.sizing.rounding import round_thickness
from foldshell.sizing.rules import (
    SizingState,
    dead_band,
    fully_stressed,
    start_state,
    thicken_all,
)
from foldshell.sizing.stress_ratio import stress_ratio

Rule = Callable[[SizingState, Sizing], SizingState]
RULES: dict[str, Rule] = {
    "dead_band": dead_band,
    "filtered_dead_band": filtered_dead_band,
    "fully_stressed": fully_stressed,
    "optimality": optimality,
    "stress_ratio": stress_ratio,
}

EDGE_BEAM_NOTE = "thicker for its edge beam"


def first_step(sizing: Sizing) -> float:
    """Return the relative step of every panel at the start."""
    return sizing.move_limit if sizing.rule == "optimality" else sizing.step


@dataclass(frozen=True)
class NextStep:
    """Next thickness (P,) m, one note per panel, the memory that the step after it needs, and what
    is asked of panels, which goes on holding."""

    thickness: np.ndarray
    note: tuple[str, ...]
    memory: StepMemory
    limits: PanelLimits | None = None


def take_step(
    analysis: AnalysisRecord,
    arrays: AnalysisArrays,
    memory: StepMemory | None,
    sizing: Sizing,
) -> NextStep:
    """Return the thickness (P,) m that follows an analysis, rounded as workbooks hold it.

    `memory` is that of the step before (None at the start), `sizing` the settings.
    """
    following = propose_thickness(
        analysis,
        arrays.thickness,
        choose_utilization(arrays, sizing.measure),
        memory,
        sizing,
        read_constraints(arrays),
        limits_of(arrays),
    )
    new = round_thickness(following.thickness)
    relieving = _relieves_edge_beam(arrays, sizing) & (new > arrays.thickness)
    note, limits = _add_note(following.note, relieving), limits_of(arrays)
    return replace(following, thickness=new, note=note, limits=limits)


def _relieves_edge_beam(arrays: AnalysisArrays, sizing: Sizing) -> np.ndarray:
    """Return which panels (P,) are within their own limit, but not the edge beam that they hold."""
    own = arrays.utilization(sizing.measure)
    if own is None:
        return np.zeros(len(arrays.thickness), bool)
    limit = sizing.utilization_max
    return (own <= limit) & (choose_utilization(arrays, sizing.measure) > limit)


def _add_note(notes: tuple[str, ...], relieving: np.ndarray) -> tuple[str, ...]:
    words = np.where(relieving, EDGE_BEAM_NOTE, "").tolist()
    return tuple("; ".join(filter(None, pair)) for pair in zip(notes, words, strict=True))


def choose_utilization(arrays: AnalysisArrays, measure: str) -> np.ndarray | None:
    """Return the utilization (P,) by which a rule sizes panels, None where there is none.

    No rule sizes the panels of an edge beam: the panel that one hangs from takes the larger of
    both utilizations, so that it relieves an overstressed one.

    Without unit.
    """
    used = arrays.utilization(measure)
    if used is None or arrays.edge_beam_panel is None:
        return used
    larger = used.copy()
    np.maximum.at(larger, arrays.edge_beam_panel, arrays.edge_beam_utilization(measure))
    return larger


def propose_thickness(
    analysis: AnalysisRecord,
    thickness: np.ndarray,
    utilization: np.ndarray | None,
    memory: StepMemory | None,
    sizing: Sizing,
    constraints: Constraints | None = None,
    limits: PanelLimits | None = None,
) -> NextStep:
    """Apply the sizing rule, or thicken everything where the state does not allow it.

    An unstable or unconverged analysis thickens from the last stable state, one step more each
    time. While the least buckling factor or the displacement is beyond its limit nothing is
    thinned; where displacement alone is open and no panel is overstressed, all panels grow. A rule
    that works on constraints sees the displacement among them.

    Parameters
    ----------
    thickness : (P,) m as analysed
    utilization : (P,) by the chosen measure, None where the analysis gave none
    memory : of the step before; None at the start
    constraints : of the analysis, for rules in `NEED_CONSTRAINTS`
    limits : what a person asks of panels
    """
    state = _restore(thickness, memory, first_step(sizing))
    if limits is not None:
        least, largest = bound_panels(limits, thickness, *sizing.bounds)
        state = replace(state, least=least, largest=largest)
    if analysis.state != "ok":
        return _recover(state, memory, sizing, analysis.reason, limits)
    factor = analysis.least_factor
    stiff = analysis.criteria.displacement_vertical_m.met
    safe = factor is None or factor >= sizing.thinning_buckling_factor_min
    if sizing.rule in NEED_CONSTRAINTS:
        stiff = True
    state = replace(
        state,
        utilization=utilization,
        may_thin=bool(stiff and safe),
        constraints=constraints,
        step_max=sizing.move_limit,
        least_factor=np.inf if factor is None else factor,
        displacement_share=_share(analysis.criteria.displacement_vertical_m),
    )
    if not stiff and not (utilization > sizing.utilization_max).any():
        following = _advance(state, sizing, _thicken, limits)
        note = "displacement above its limit"
    else:
        following = _advance(state, sizing, RULES[sizing.rule], limits)
        note = "" if state.may_thin else _explain(stiff)
    notes = _notes(following, sizing, note, limits)
    return NextStep(following.thickness, notes, _memory(following, thickness, 0))


def _share(displacement: Criterion) -> float:
    """Return the displacement over its limit."""
    known = displacement.value is not None and np.isfinite(displacement.value)
    return displacement.value / displacement.limit if known else 1.0


def _thicken(state: SizingState, sizing: Sizing) -> SizingState:
    return thicken_all(state, sizing, sizing.step)


def _advance(state: SizingState, sizing: Sizing, rule: Rule, limits) -> SizingState:
    """Apply a rule to groups of panels, and round up to thicknesses that can be built."""
    member = None if limits is None else index_groups(limits)
    own = state if member is None else pool_state(state, member)
    following = rule(own, sizing)
    buildable = list_buildable(sizing)
    if buildable is not None:
        following = step_to_buildable(own, following, buildable)
    return following if member is None else spread_state(following, member, state)


def _restore(thickness, memory: StepMemory | None, step: float) -> SizingState:
    if memory is None:
        return start_state(thickness, step)
    unknown = np.full(len(thickness), np.nan)
    return SizingState(thickness, unknown, memory.step, memory.direction, memory.sign_changes)


def _recover(state, memory: StepMemory | None, sizing: Sizing, reason: str, limits) -> NextStep:
    failures = int(memory.failures) + 1 if memory else 1
    stable = memory.stable if memory and memory.stable.size else None
    base = state.thickness if stable is None else stable
    steps = 1 if stable is None else failures
    share = (1 + sizing.step) ** steps - 1
    if limits is not None:
        base = hold_limits(limits, state.clip(base, sizing), *sizing.bounds)
    following = thicken_all(replace(state, thickness=base), sizing, share)
    up = state.clip(round_up(following.thickness, list_buildable(sizing)), sizing)
    following = replace(following, thickness=up)
    if sizing.rule in NEED_CONSTRAINTS:
        following = replace(following, step=following.step / 2)
    kept = np.empty(0) if stable is None else stable
    note = (reason,) * len(base)
    return NextStep(following.thickness, note, _memory(following, kept, failures))


def _memory(state: SizingState, stable: np.ndarray, failures: int) -> StepMemory:
    return StepMemory(
        step=state.step,
        direction=state.direction,
        sign_changes=state.sign_changes,
        stable=stable,
        failures=np.asarray(failures),
    )


def _explain(stiff: bool) -> str:
    return "no thinning: " + ("buckling factor" if stiff else "displacement")


def _notes(state: SizingState, sizing: Sizing, note: str, limits) -> tuple[str, ...]:
    least, largest = bound_panels(limits, state.thickness, *sizing.bounds)
    at_least, at_most = state.thickness <= least, state.thickness >= largest
    words = np.where(at_least, "least thickness", np.where(at_most, "largest thickness", ""))
    if limits is not None:
        words = np.where(limits.fixed, "fixed", words)
    return tuple("; ".join(filter(None, (word, note))) for word in words.tolist())
