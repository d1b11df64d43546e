"""When the sizing loop stops, and with what verdict (Table 3 of Tsiamis et al. 2018)."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from foldshell.settings.sizing import Sizing

STATIONARY_ITERATIONS = 3
"""Iterations in a row over which `stop: stationary` asks for a small change of volume: each may
take an equal share of `volume_change_max_relative`. Of slow rules a single change says little."""


@dataclass(frozen=True)
class IterationState:
    """What a verdict is made of. `utilization` (P,) by the chosen measure; `previous_*` are None
    in iteration 0, `previous_stationary` counts iterations in a row with a small change of volume;
    `edge_beam` is the largest utilization of its panels, by the same measure."""

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


@dataclass(frozen=True)
class Verdict:
    """Verdict, its reason in words, each criterion with value, limit and whether it is met."""

    verdict: str
    reason: str
    criteria: Mapping[str, Mapping[str, object]]
    stationary_iterations: int


def judge_iteration(now: IterationState, sizing: Sizing) -> Verdict:
    """Compare an analysis with Table 3 and say whether and why the loop ends."""
    if now.state == "mechanism":
        return Verdict("unstable", now.reason, {}, 0)
    if now.state == "unstable":
        return _judge_unstable(now, sizing)
    criteria = evaluate_criteria(now, sizing)
    change = criteria["volume_change_relative"]["value"]
    share = sizing.volume_change_max_relative / STATIONARY_ITERATIONS
    small = change is not None and change < share
    stationary_iterations = now.previous_stationary + 1 if small else 0
    open_names = [name for name, item in criteria.items() if not item["met"]]
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
    if now.iteration >= sizing.iterations_max:
        reason = f"{sizing.iterations_max} iterations are used up; {failing or 'not stationary'}"
        return Verdict("not_converged", reason, criteria, stationary_iterations)
    return Verdict(
        "continue", failing or now.reason or "not stationary yet", criteria, stationary_iterations
    )


def evaluate_criteria(now: IterationState, sizing: Sizing) -> dict[str, dict[str, object]]:
    """Return {name: value, limit, met} of Table 3, of the relative change of volume, and of the
    edge beam where there is one."""
    highest = float(now.utilization.max())
    limit = now.span / sizing.displacement_limit_span_over
    change = None if now.previous_volume is None else abs(now.volume - now.previous_volume)
    relative = None if change is None else change / now.previous_volume
    criteria = {
        "utilization_max": _below(highest, sizing.utilization_max, closed=True),
        "utilization_min": {
            "value": highest,
            "limit": sizing.utilization_min,
            "met": highest >= sizing.utilization_min,
        },
        "displacement_vertical_m": _below(now.displacement, limit),
        "volume_change_m3": _below(change, sizing.volume_change_max),
        "volume_change_relative": _below(relative, sizing.volume_change_max_relative),
    }
    if now.edge_beam is not None:
        criteria["edge_beam_utilization"] = _below(
            now.edge_beam, sizing.utilization_max, closed=True
        )
    return criteria


def _below(value: float | None, limit: float, closed: bool = False) -> dict[str, object]:
    met = value is not None and (value <= limit if closed else value < limit)
    return {"value": value, "limit": limit, "met": met}


def _judge_unstable(now: IterationState, sizing: Sizing) -> Verdict:
    if now.iteration >= sizing.iterations_max:
        reason = f"{sizing.iterations_max} iterations are used up; {now.reason}"
        return Verdict("unstable", reason, {}, 0)
    if (now.thickness >= sizing.largest_thickness).all():
        largest = f"{1e3 * sizing.largest_thickness:g} mm"
        return Verdict("unstable", f"{now.reason} at the largest thickness of {largest}", {}, 0)
    return Verdict("continue", now.reason, {}, 0)


def _thinnest(now: IterationState, sizing: Sizing) -> bool:
    return bool((now.thickness <= sizing.least_thickness).all())


def _unchanged(now: IterationState) -> bool:
    before = now.previous_thickness
    return before is not None and np.array_equal(before, now.thickness)


def _describe(now, sizing: Sizing, criteria, open_names: list[str]) -> str:
    """Say which criteria are open, with values and panels."""
    words = []
    for name in open_names:
        item = criteria[name]
        if name == "utilization_max":
            above = np.flatnonzero(now.utilization > sizing.utilization_max)
            worst = above[np.argsort(-now.utilization[above], kind="stable")][:8].tolist()
            more = f" and {len(above) - 8} more" if len(above) > 8 else ""
            value, limit = _show_both(item)
            words.append(
                f"utilization {value} above {limit} in {len(above)} of "
                f"{len(now.utilization)} panels: {', '.join(map(str, worst))}{more}"
            )
        elif item["value"] is None:
            words.append(f"{name} is not known before the second analysis")
        else:
            relation = "below" if name == "utilization_min" else "not below"
            value, limit = _show_both(item)
            words.append(f"{name} {value} {relation} {limit}")
    return "; ".join(words)


def _show_both(item: Mapping[str, Any]) -> tuple[str, str]:
    """Return value and limit with three digits, or as many as tell them apart."""
    pairs = ((f"{item['value']:.{n}g}", f"{item['limit']:.{n}g}") for n in range(3, 18))
    return next((pair for pair in pairs if pair[0] != pair[1]), (f"{item['value']}",) * 2)
