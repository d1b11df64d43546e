"""When the sizing loop stops, and with what verdict (Table 3 of Tsiamis et al. 2018)."""

from dataclasses import dataclass

import numpy as np

from foldshell.records.analysis import Criteria, Criterion
from foldshell.settings.sizing import Sizing

LAST_ITERATION = 99
"""Iterations are numbered with two digits."""

STATIONARY_ITERATIONS = 3
"""Iterations in a row over which `stop: stationary` asks for a small change of volume: each may
take an equal share of `volume_change_max_relative`. Of slow rules a single change says little."""


AT_LEAST = ("utilization_min", "buckling_factor")
"""Criteria whose value has to reach the limit; that of the others stays below it."""

WHY_UNKNOWN = {"buckling_factor": "without analysis.second_order"}


@dataclass(frozen=True)
class IterationState:
    """What a verdict is made of. `utilization` (P,) by the chosen measure; `previous_*` are None
    in iteration 0, `previous_stationary` counts iterations in a row with a small change of volume;
    `edge_beam` is the largest utilization of its panels, by the same measure; `buckling_factor` the
    least of all combinations, inf where nothing is compressed, None where unknown; the allowed
    iterations count from `counted_from`, where a person last changed panels."""

    iteration: int
    state: str
    reason: str
    thickness: np.ndarray
    utilization: np.ndarray
    displacement: float
    span: float
    volume: float
    previous_volume: float | None
    previous_thickness: np.ndarray | None
    previous_stationary: int
    edge_beam: float | None = None
    buckling_factor: float | None = None
    counted_from: int = 0


@dataclass(frozen=True)
class Verdict:
    """Verdict, its reason in words, each criterion with value, limit and whether it is met."""

    verdict: str
    reason: str
    criteria: Criteria
    stationary_iterations: int


def judge_iteration(now: IterationState, sizing: Sizing) -> Verdict:
    """Compare an analysis with Table 3 and say whether and why the loop ends."""
    if now.state == "mechanism":
        return Verdict("unstable", now.reason, Criteria(), 0)
    if now.state == "unstable":
        return _judge_unstable(now, sizing)
    criteria = evaluate_criteria(now, sizing)
    change = criteria.volume_change_relative.value
    share = sizing.volume_change_max_relative / STATIONARY_ITERATIONS
    small = change is not None and change < share
    stationary_iterations = now.previous_stationary + 1 if small else 0
    open_names = criteria.open_names
    settled = sizing.stop == "table3" or stationary_iterations >= STATIONARY_ITERATIONS
    if now.state == "ok" and not open_names and settled:
        return Verdict("converged", "all criteria are met", criteria, stationary_iterations)
    failing = _describe(now, sizing, criteria, open_names)
    if now.state == "ok" and open_names == ["utilization_min"] and _thinnest(now, sizing):
        reason = f"every panel stands at the least thickness of {1e3 * sizing.least_thickness:g} mm"
        return Verdict(
            "at_minimum_thickness", f"{reason}; {failing}", criteria, stationary_iterations
        )
    if now.state == "ok" and open_names and _unchanged(now):
        return Verdict(
            "not_converged",
            f"no panel changes any more; {failing}",
            criteria,
            stationary_iterations,
        )
    if used_up := _count_up(now, sizing):
        reason = f"{used_up}; {failing or 'not stationary'}"
        return Verdict("not_converged", reason, criteria, stationary_iterations)
    return Verdict(
        "continue", failing or now.reason or "not stationary yet", criteria, stationary_iterations
    )


def _count_up(now: IterationState, sizing: Sizing) -> str:
    """Say that no iteration is left, empty where one is."""
    since = f" since the edit of iteration {now.counted_from}" if now.counted_from else ""
    if now.iteration - now.counted_from >= sizing.iterations_max:
        return f"{sizing.iterations_max} iterations{since} are used up"
    return "" if now.iteration < LAST_ITERATION else f"iteration {LAST_ITERATION} is the last one"


def evaluate_criteria(now: IterationState, sizing: Sizing) -> Criteria:
    """Return those of Table 3, the relative change of volume, the edge beam's where there is one,
    and the buckling factor where it is asked for."""
    highest = float(now.utilization.max())
    limit = now.span / sizing.displacement_limit_span_over
    change = None if now.previous_volume is None else abs(now.volume - now.previous_volume)
    relative = None if change is None else change / now.previous_volume
    least, beam = sizing.utilization_min, now.edge_beam
    return Criteria(
        **{name_measure(sizing): _below(highest, sizing.utilization_max, closed=True)},
        utilization_min=Criterion(value=highest, limit=least, met=highest >= least),
        displacement_vertical_m=_below(now.displacement, limit),
        volume_change_m3=_below(change, sizing.volume_change_max),
        volume_change_relative=_below(relative, sizing.volume_change_max_relative),
        edge_beam_utilization=(
            None if beam is None else _below(beam, sizing.utilization_max, closed=True)
        ),
        buckling_factor=_stable(now.buckling_factor, sizing.buckling_factor_min),
    )


def _stable(factor: float | None, least: float) -> Criterion | None:
    """Hold the least buckling factor against its limit; none where the limit is 0."""
    if least == 0:
        return None
    known = factor is not None and np.isfinite(factor)
    met = factor is not None and factor >= least
    return Criterion(value=factor if known else None, limit=least, met=met)


def name_measure(sizing: Sizing) -> str:
    """Return the name of the criterion that limits utilization: that of its measure."""
    return f"utilization_{sizing.measure}"


def _below(value: float | None, limit: float, closed: bool = False) -> Criterion:
    met = value is not None and (value <= limit if closed else value < limit)
    return Criterion(value=value, limit=limit, met=met)


def _judge_unstable(now: IterationState, sizing: Sizing) -> Verdict:
    if used_up := _count_up(now, sizing):
        return Verdict("unstable", f"{used_up}; {now.reason}", Criteria(), 0)
    if (now.thickness >= sizing.largest_thickness).all():
        largest = f"{1e3 * sizing.largest_thickness:g} mm"
        reason = f"{now.reason} at the largest thickness of {largest}"
        return Verdict("unstable", reason, Criteria(), 0)
    return Verdict("continue", now.reason, Criteria(), 0)


def _thinnest(now: IterationState, sizing: Sizing) -> bool:
    return bool((now.thickness <= sizing.least_thickness).all())


def _unchanged(now: IterationState) -> bool:
    before = now.previous_thickness
    return before is not None and np.array_equal(before, now.thickness)


def _describe(now, sizing: Sizing, criteria: Criteria, open_names: list[str]) -> str:
    """Say which criteria are open, with values and panels."""
    words = []
    for name in open_names:
        item = getattr(criteria, name)
        if name == name_measure(sizing):
            above = np.flatnonzero(now.utilization > sizing.utilization_max)
            worst = above[np.argsort(-now.utilization[above], kind="stable")][:8].tolist()
            more = f" and {len(above) - 8} more" if len(above) > 8 else ""
            value, limit = _show_both(item)
            words.append(
                f"utilization {value} above {limit} in {len(above)} of "
                f"{len(now.utilization)} panels: {', '.join(map(str, worst))}{more}"
            )
        elif item.value is None:
            words.append(
                f"{name} is not known {WHY_UNKNOWN.get(name, 'before the second analysis')}"
            )
        else:
            relation = "below" if name in AT_LEAST else "not below"
            value, limit = _show_both(item)
            words.append(f"{name} {value} {relation} {limit}")
    return "; ".join(words)


def _show_both(item: Criterion) -> tuple[str, str]:
    """Return value and limit with three digits, or as many as tell them apart."""
    pairs = ((f"{item.value:.{n}g}", f"{item.limit:.{n}g}") for n in range(3, 18))
    return next((pair for pair in pairs if pair[0] != pair[1]), (f"{item.value}",) * 2)
