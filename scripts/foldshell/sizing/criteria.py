"""When the sizing loop stops, and with what verdict (Table 3 of Tsiamis et al. 2018)."""

from dataclasses import dataclass, replace

import numpy as np

from foldshell.records.analysis import Criteria, Criterion
from foldshell.settings.sizing import Sizing
from foldshell.sizing.constraints import NEED_CONSTRAINTS, least_factor_due
from foldshell.sizing.panel_limits import PanelLimits, bound_panels

LAST_ITERATION = 99
"""Iterations are numbered with two digits."""

STATIONARY_ITERATIONS = 3
"""Iterations in a row over which a small change of volume is asked for, by `stop: stationary` and
by the rules that work on constraints: of slow rules a single change says little."""

GOVERNS = 0.97
"""Share of its limit from which displacement or buckling counts as what governs."""

NO_LIMITS = ("utilization_min", "volume_change_m3", "volume_change_relative")
"""Criteria of when to stop; the others are limits that a shell has to keep."""

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
    limits: PanelLimits | None = None

    @property
    def fixed(self) -> np.ndarray:
        """Whether a person has fixed each panel, (P,) bool."""
        return np.zeros(len(self.thickness), bool) if self.limits is None else self.limits.fixed


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
    change = criteria.volume_change_relative and criteria.volume_change_relative.value
    small = change is not None and change < _small_change(sizing)
    stationary_iterations = now.previous_stationary + 1 if small else 0
    quiet = stationary_iterations >= STATIONARY_ITERATIONS
    verdict, reason = _judge_criteria(now, sizing, criteria, quiet)
    return Verdict(verdict, reason, criteria, stationary_iterations)


def _judge_criteria(
    now: IterationState, sizing: Sizing, criteria: Criteria, quiet: bool
) -> tuple[str, str]:
    """Return the verdict on an analysis with displacements, and its reason."""
    open_names = criteria.open_names
    failing = _describe(now, sizing, criteria, open_names)
    if sizing.analyse_only:
        met = now.state == "ok" and not open_names
        words = "all limits are met" if met else failing or now.reason
        return "converged" if met else "not_converged", f"analysed as given; {words}"
    if now.state == "ok" and not open_names and (quiet or _ends_at_once(sizing)):
        return "converged", "all criteria are met"
    if now.state == "ok" and open_names == ["utilization_min"]:
        governing = _find_governing(now, sizing, criteria)
        if quiet and governing:
            return "converged", governing
        if _thinnest(now, sizing):
            least = f"{1e3 * sizing.least_thickness:g} mm"
            reason = f"every panel stands at the least thickness of {least}; {failing}"
            return "at_minimum_thickness", reason
    if now.state == "ok" and open_names and _unchanged(now):
        return "not_converged", f"no panel changes any more; {failing}"
    if now.state == "ok" and (stuck := _find_stuck(now, sizing, criteria)):
        return "not_converged", f"{stuck}; {failing}"
    if used_up := _count_up(now, sizing):
        return "not_converged", f"{used_up}; {failing or 'not stationary'}"
    return "continue", failing or now.reason or "not stationary yet"


def _ends_at_once(sizing: Sizing) -> bool:
    """Tell whether the first iteration that meets Table 3 ends the loop."""
    return sizing.stop == "table3" and sizing.rule not in NEED_CONSTRAINTS


def _small_change(sizing: Sizing) -> float:
    """Return the relative change of volume below which an iteration counts as quiet: together
    `volume_change_max_relative`, but for `filtered_dead_band` by Table 3, where each may take all.
    """
    if sizing.rule == "filtered_dead_band" and sizing.stop == "table3":
        return sizing.volume_change_max_relative
    return sizing.volume_change_max_relative / STATIONARY_ITERATIONS


def _find_governing(now: IterationState, sizing: Sizing, criteria: Criteria) -> str:
    """Say which limit of stiffness a sheet stands at that is not used to `utilization_min`; empty
    for none, and for rules that do not size for these limits."""
    if sizing.rule not in NEED_CONSTRAINTS:
        return ""
    words, down, factor = [], criteria.displacement_vertical_m, now.buckling_factor
    if down.value >= GOVERNS * down.limit:
        words.append(
            f"displacement_vertical_m {down.value:.4g} stands at its limit {down.limit:.4g}"
        )
    least = least_factor_due(sizing)
    if factor is not None and factor * GOVERNS <= least:
        words.append(f"buckling_factor {factor:.4g} stands at its limit {least:.4g}")
    return "; ".join([*words, "all other limits are met"]) if words else ""


def _find_stuck(now: IterationState, sizing: Sizing, criteria: Criteria) -> str:
    """Say that fixed panels cannot hold, once the others have settled; empty where they can."""
    over = np.flatnonzero(now.fixed & (now.utilization > sizing.utilization_max))
    change = criteria.volume_change_relative
    if now.fixed.all() and any(name not in NO_LIMITS for name in criteria.open_names):
        return "every panel is fixed, and they cannot hold"
    if not len(over) or (now.utilization[~now.fixed] > sizing.utilization_max).any():
        return ""
    if not (change.met and criteria.displacement_vertical_m.met):
        return ""
    return f"fixed panels cannot hold: {', '.join(map(str, over[:8].tolist()))}"


def _count_up(now: IterationState, sizing: Sizing) -> str:
    """Say that no iteration is left, empty where one is."""
    since = f" since the edit of iteration {now.counted_from}" if now.counted_from else ""
    if now.iteration - now.counted_from + 1 >= sizing.iterations_max:
        return f"{sizing.iterations_max} iterations{since} are used up"
    return "" if now.iteration < LAST_ITERATION else f"iteration {LAST_ITERATION} is the last one"


def evaluate_criteria(now: IterationState, sizing: Sizing) -> Criteria:
    """Return those of Table 3, the relative change of volume, the edge beam's where there is one,
    and the buckling factor where it is asked for; limits alone where nothing is sized."""
    highest = float(now.utilization.max())
    limit = now.span / sizing.displacement_limit_span_over
    change = None if now.previous_volume is None else abs(now.volume - now.previous_volume)
    relative = None if change is None else change / now.previous_volume
    least, beam = sizing.utilization_min, now.edge_beam
    found = Criteria(
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
    return replace(found, **dict.fromkeys(NO_LIMITS)) if sizing.analyse_only else found


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
    if sizing.analyse_only:
        return Verdict("unstable", f"analysed as given; {now.reason}", Criteria(), 0)
    if used_up := _count_up(now, sizing):
        return Verdict("unstable", f"{used_up}; {now.reason}", Criteria(), 0)
    if (now.thickness >= bound_panels(now.limits, now.thickness, *sizing.bounds)[1]).all():
        largest = f"{1e3 * sizing.largest_thickness:g} mm"
        reason = f"{now.reason} at the largest thickness of {largest}"
        return Verdict("unstable", reason, Criteria(), 0)
    return Verdict("continue", now.reason, Criteria(), 0)


def _thinnest(now: IterationState, sizing: Sizing) -> bool:
    least, _ = bound_panels(now.limits, now.thickness, *sizing.bounds)
    return bool((now.thickness <= least).all())


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
