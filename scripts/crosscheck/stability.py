"""Buckling factors and second-order values of the compared combinations."""

import numpy as np

from crosscheck.analysis import (
    Analysis,
    analyse_model,
    list_values,
    measure_response,
    sum_loads,
)
from crosscheck.buckling import compute_buckling_factors
from crosscheck.comparison import NOT_SETTLED, SECOND_ORDER
from crosscheck.frontal import Plan
from crosscheck.model import Model
from crosscheck.second_order import NotSettled, solve_second_order
from crosscheck.system import Response

CHANGE = 1e-5  # at which second order has settled: mesh errors are a thousand times larger
LARGEST_FACTOR = 1e6  # beyond it nothing buckles; a number that JSON can hold


def analyse_mesh(
    model: Model,
    subdivisions: int,
    shear_factor: float,
    buckling: bool,
    second_order: bool,
    plan: Plan | None = None,
) -> dict[str, dict[str, object]]:
    """All values of one mesh, by combination; second-order ones under `<combination> Th.II`.

    `plan` is that of `plan_facets`, which all meshes of a model share.
    """
    analysis = analyse_model(model, subdivisions, shear_factor, plan)
    values = list_values(analysis)
    if buckling or second_order:
        for name, entry in list_stability_values(analysis, second_order).items():
            values[name] = values.get(name, {}) | entry
    return values


def list_stability_values(analysis: Analysis, second_order: bool) -> dict[str, dict[str, object]]:
    """The factor of each combination and, if asked for and below buckling, second-order values.

    A factor that has not settled is NOT_SETTLED in place of a number.
    """
    names = list(analysis.model.compared_combinations)
    found = compute_buckling_factors(analysis.system, analysis.response)
    result: dict[str, dict[str, object]] = {
        name: {"buckling_factor": float(min(factor, LARGEST_FACTOR)) if settled else NOT_SETTLED}
        for name, factor, settled in zip(names, found.factor, found.settled, strict=True)
    }
    if second_order:
        result |= _list_second_order(analysis, np.flatnonzero(found.factor > 1.0))
    return result


def _list_second_order(analysis: Analysis, cases: np.ndarray) -> dict[str, dict[str, object]]:
    """Second-order values of some combinations: all at once, or those alone that settle alone."""
    if not len(cases):
        return {}
    try:
        return _solve_combinations(analysis, cases)
    except NotSettled:
        apart = [cases[[k]] for k in range(len(cases))] if len(cases) > 1 else []
    result = {}
    for case in apart:
        result |= _list_second_order(analysis, case)
    return result


def _solve_combinations(analysis: Analysis, cases: np.ndarray) -> dict[str, dict[str, object]]:
    first, names = analysis.response, list(analysis.model.compared_combinations)
    start = Response(
        first.local[..., cases], first.displacement[..., cases], first.reaction_sum[:, cases]
    )
    forces = analysis.forces[..., cases]
    state = solve_second_order(analysis.system, forces, start, CHANGE).response
    loads = sum_loads(analysis.system.grid, analysis.surface[..., cases])
    return {
        f"{names[case]} {SECOND_ORDER}": measure_response(analysis, state, k, forces[..., k])
        | {
            "reaction_sum_kn": state.reaction_sum[:, k].tolist(),
            "load_sum_kn": loads[:, k].tolist(),
        }
        for k, case in enumerate(cases.tolist())
    }
