"""Buckling factors and second-order values of the compared combinations."""

import numpy as np

from crosscheck.analysis import (
    Analysis,
    analyse_model,
    list_values,
    measure_response,
    sum_loads,
)
from crosscheck.buckling import search_factors
from crosscheck.comparison import NOT_SETTLED, SECOND_ORDER
from crosscheck.frontal import Plan
from crosscheck.model import Model
from crosscheck.records import MULTIFRONTAL
from crosscheck.search import NotSettled, Search, Steps, run_alone, solve_together
from crosscheck.second_order import search_second_order
from crosscheck.system import Response, System

CHANGE = 1e-5  # at which second order has settled: mesh errors are a thousand times larger
LARGEST_FACTOR = 1e6  # beyond it nothing buckles; a number that JSON can hold


def analyse_mesh(
    model: Model,
    subdivisions: int,
    shear_factor: float,
    buckling: bool,
    second_order: bool,
    plan: Plan | None = None,
    solver: str = MULTIFRONTAL,
) -> dict[str, dict[str, object]]:
    """All values of one mesh, by combination; second-order ones under `<combination> Th.II`.

    `plan` is that of `plan_facets`, which all meshes of a model share.
    """
    analysis = analyse_model(model, subdivisions, shear_factor, plan, solver)
    values = list_values(analysis)
    if buckling or second_order:
        for name, entry in list_stability_values(analysis, second_order).items():
            values[name] = values.get(name, {}) | entry
    return values


def list_stability_values(analysis: Analysis, second_order: bool) -> dict[str, dict[str, object]]:
    """The factor of each combination and, if asked for and below buckling, second-order values.

    A factor that has not settled is NOT_SETTLED in place of a number.
    """
    if not isinstance(analysis.system, System):
        return _list_plain(analysis, second_order)
    names = list(analysis.model.compared_combinations)
    cases, system = np.arange(len(names)), analysis.system
    searches = [Search(search_factors(system, analysis.response))]
    if second_order:
        searches.append(Search(_search_state(analysis, cases)))
    while searches[0].request is not None:
        solve_together(system, *searches)
    found = searches[0].result
    result: dict[str, dict[str, object]] = {
        name: {"buckling_factor": float(min(factor, LARGEST_FACTOR)) if settled else NOT_SETTLED}
        for name, factor, settled in zip(names, found.factor, found.settled, strict=True)
    }
    if not second_order:
        return result
    below = np.flatnonzero(found.factor > 1.0)
    if len(below) < len(cases):
        return result | _list_one_by_one(analysis, below)
    while searches[1].request is not None:
        solve_together(system, searches[1])
    if searches[1].error is not None:
        return result | _list_one_by_one(analysis, below)
    return result | _list_second_order(analysis, cases, searches[1].result.response)


def _list_plain(analysis: Analysis, second_order: bool) -> dict[str, dict[str, object]]:
    """The same by the plain path, one combination after the other."""
    from crosscheck.plain import find_plain_factors, find_plain_state

    names, system = list(analysis.model.compared_combinations), analysis.system
    result: dict[str, dict[str, object]] = {}
    for case, factor in enumerate(find_plain_factors(system, analysis.response)):
        result[names[case]] = {"buckling_factor": float(min(factor, LARGEST_FACTOR))}
        if second_order and factor > 1:
            only = np.array([case])
            forces, first = _pick_cases(analysis, only)
            state = find_plain_state(system, forces, first)
            result |= _list_second_order(analysis, only, state)
    return result


def _list_one_by_one(analysis: Analysis, cases: np.ndarray) -> dict[str, dict[str, object]]:
    """Second-order values of those combinations that settle alone."""
    result = {}
    for case in cases:
        try:
            state = run_alone(analysis.system, _search_state(analysis, cases[cases == case]))
        except NotSettled:
            continue
        result |= _list_second_order(analysis, cases[cases == case], state.response)
    return result


def _search_state(analysis: Analysis, cases: np.ndarray) -> Steps:
    """The search for the second-order state of some combinations."""
    forces, start = _pick_cases(analysis, cases)
    return search_second_order(analysis.system, forces, start, CHANGE)


def _pick_cases(analysis: Analysis, cases: np.ndarray) -> tuple[np.ndarray, Response]:
    """Forces (F, R, 3, k) and first-order answer of some combinations."""
    first, forces = analysis.response, analysis.forces[..., cases]
    local, moved = first.local[..., cases], first.displacement[..., cases]
    return forces, Response(local, moved, first.reaction_sum[:, cases])


def _list_second_order(
    analysis: Analysis, cases: np.ndarray, state: Response
) -> dict[str, dict[str, object]]:
    """Values of the state found for some combinations."""
    names = list(analysis.model.compared_combinations)
    forces = analysis.forces[..., cases]
    loads = sum_loads(analysis.system.grid, analysis.surface[..., cases])
    return {
        f"{names[case]} {SECOND_ORDER}": measure_response(analysis, state, k, forces[..., k])
        | {
            "reaction_sum_kn": state.reaction_sum[:, k].tolist(),
            "load_sum_kn": loads[:, k].tolist(),
        }
        for k, case in enumerate(cases.tolist())
    }
