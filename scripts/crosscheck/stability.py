"""All values of one mesh: first order, buckling factors, second order, shear deformation."""

from dataclasses import dataclass

import numpy as np

from crosscheck.analysis import (
    Analysis,
    analyse_model,
    list_statics,
    list_values,
    measure_response,
    sum_loads,
)
from crosscheck.buckling import Buckling, search_factors
from crosscheck.model import Model
from crosscheck.ordering import Plan
from crosscheck.panel_steel import Laid, measure_reinforcement
from crosscheck.records import MULTIFRONTAL
from crosscheck.search import NotSettled, Search, Steps, run_alone, solve_together
from crosscheck.second_order import search_second_order
from crosscheck.shear import TRUE_SHEAR_FACTOR, search_sheared_state
from crosscheck.system import SHEAR_FACTOR, Response, State, System
from crosscheck.values import NOT_SETTLED, SECOND_ORDER, SHEARED

Values = dict[str, dict[str, object]]
"""Values of a mesh by combination and name."""

CHANGE = 1e-5  # at which second order has settled: mesh errors are a thousand times larger
REINFORCED = "reinforcement"
"""Stands for the combinations that steel is designed for."""
LARGEST_FACTOR = 1e6  # beyond it nothing buckles; a number that JSON can hold


@dataclass(frozen=True)
class Method:
    """What is computed beside the first order, and how; `shear` needs one of the two others; what a
    sheet is reinforced `laid` with, None for no design of it."""

    shear_factor: float = SHEAR_FACTOR
    buckling: bool = True
    second_order: bool = True
    shear: bool = False
    solver: str = MULTIFRONTAL
    laid: Laid | None = None


FIRST_ORDER = Method(buckling=False, second_order=False)
"""First order alone."""


def analyse_mesh(
    model: Model, subdivisions: int, method: Method, plan: Plan | None = None
) -> Values:
    """All values of one mesh; second-order ones under `<combination> Th.II`, those of the
    reinforcement, for all its combinations together, under `REINFORCED`.

    `plan` is that of `plan_facets`, which all meshes of a model share.
    """
    analysis = analyse_model(model, subdivisions, method.shear_factor, plan, method.solver)
    values = list_values(analysis)
    if method.buckling or method.second_order:
        found = list_stability_values(analysis, method.second_order, method.shear)
        for name, entry in found.items():
            values[name] = values.get(name, {}) | entry
    if method.laid is not None:
        values[REINFORCED] = dict(measure_reinforcement(analysis, method.laid))
    return values


def list_stability_values(analysis: Analysis, second_order: bool, shear: bool = False) -> Values:
    """The factor of each combination and, if asked for, values of second order and with shear.

    Those of second order stand where the load is below buckling. A factor that has not settled is
    NOT_SETTLED in place of a number. All searches share each sweep through the factor.
    """
    if not isinstance(analysis.system, System):
        return _list_plain(analysis, second_order, shear)
    cases = np.arange(len(analysis.model.compared_combinations))
    factors = Search(search_factors(analysis.system, analysis.response))
    others = [Search(_search_sheared(analysis))] if shear else []
    state = Search(_search_state(analysis, cases)) if second_order else None
    while factors.request is not None:
        _advance(analysis, factors, state, *others)
    result = _list_factors(analysis, factors.result)
    below = np.flatnonzero(factors.result.factor > 1.0)
    whole = state if len(below) == len(cases) else None
    while any(search.request is not None for search in (whole, *others) if search):
        _advance(analysis, whole, *others)
    if shear and others[0].error is None:
        result |= _list_sheared(analysis, others[0].result)
    if not second_order:
        return result
    if whole is None or whole.error is not None:
        return result | _list_one_by_one(analysis, below)
    return result | _list_second_order(analysis, cases, whole.result.response)


def _advance(analysis: Analysis, *searches: Search | None) -> None:
    solve_together(analysis.system, *(search for search in searches if search))


def _list_factors(analysis: Analysis, found: Buckling) -> Values:
    names = list(analysis.model.compared_combinations)
    return {
        name: {"buckling_factor": float(min(factor, LARGEST_FACTOR)) if settled else NOT_SETTLED}
        for name, factor, settled in zip(names, found.factor, found.settled, strict=True)
    }


def _list_plain(analysis: Analysis, second_order: bool, shear: bool) -> Values:
    """The same by the plain path, one combination after the other."""
    from crosscheck.plain import find_plain_factors, find_plain_state, solve_plain_sheared

    names, system = list(analysis.model.compared_combinations), analysis.system
    factors = find_plain_factors(system, analysis.response)
    result = _list_factors(analysis, Buckling(factors, np.ones(len(names), dtype=bool), 0))
    if shear:
        sheared = solve_plain_sheared(system, analysis.forces, TRUE_SHEAR_FACTOR)
        result |= _list_sheared(analysis, sheared)
    for case in np.flatnonzero(factors > 1) if second_order else ():
        only = np.array([case])
        first = analysis.response.pick_cases(only)
        state = find_plain_state(system, analysis.forces[..., only], first)
        result |= _list_second_order(analysis, only, state)
    return result


def _list_one_by_one(analysis: Analysis, cases: np.ndarray) -> Values:
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
    first = analysis.response.pick_cases(cases)
    return search_second_order(analysis.system, analysis.forces[..., cases], first, CHANGE)


def _search_sheared(analysis: Analysis) -> Steps:
    """The search for the first-order state with shear deformation."""
    return search_sheared_state(analysis.system, analysis.response)


def _list_sheared(analysis: Analysis, state: State) -> Values:
    """First-order values with shear deformation."""
    return {
        f"{name} {SHEARED}": measure_response(analysis, state, case, analysis.forces[..., case])
        for case, name in enumerate(analysis.model.compared_combinations)
    }


def _list_second_order(analysis: Analysis, cases: np.ndarray, state: Response) -> Values:
    """Values of the state found for some combinations."""
    names = list(analysis.model.compared_combinations)
    forces = analysis.forces[..., cases]
    loads = sum_loads(analysis.system.grid, analysis.surface[..., cases])
    statics = list_statics(analysis, state, loads)
    return {
        f"{names[case]} {SECOND_ORDER}": measure_response(analysis, state, k, forces[..., k])
        | statics[k]
        for k, case in enumerate(cases.tolist())
    }
