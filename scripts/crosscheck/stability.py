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
from crosscheck.comparison import SECOND_ORDER
from crosscheck.model import Model
from crosscheck.second_order import NotSettled, solve_second_order
from crosscheck.system import Response

LARGEST_FACTOR = 1e6  # beyond it nothing buckles; a number that JSON can hold


def analyse_mesh(
    model: Model, subdivisions: int, shear_factor: float, buckling: bool, second_order: bool
) -> dict[str, dict[str, object]]:
    """All values of one mesh, by combination; second-order ones under `<combination> Th.II`."""
    analysis = analyse_model(model, subdivisions, shear_factor)
    values = list_values(analysis)
    if buckling or second_order:
        for name, entry in list_stability_values(analysis, second_order).items():
            values[name] = values.get(name, {}) | entry
    return values


def list_stability_values(analysis: Analysis, second_order: bool) -> dict[str, dict[str, object]]:
    """The factor of each combination and, if asked for and below buckling, second-order values."""
    names = list(analysis.model.compared_combinations)
    factors = compute_buckling_factors(analysis.system, analysis.response)
    result: dict[str, dict[str, object]] = {
        name: {"buckling_factor": float(min(factor, LARGEST_FACTOR))}
        for name, factor in zip(names, factors, strict=True)
    }
    if second_order:
        for case in np.flatnonzero(factors > 1.0):
            try:
                values = _solve_combination(analysis, int(case))
            except NotSettled:
                continue
            result[f"{names[case]} {SECOND_ORDER}"] = values
    return result


def _solve_combination(analysis: Analysis, case: int) -> dict[str, object]:
    first = analysis.response
    start = Response(
        first.local[..., [case]], first.displacement[..., [case]], first.reaction_sum[:, [case]]
    )
    state = solve_second_order(analysis.system, analysis.forces[..., [case]], start)
    loads = sum_loads(analysis.system.grid, analysis.surface[..., [case]])
    return measure_response(analysis, state.response, 0, analysis.forces[..., case]) | {
        "reaction_sum_kn": state.response.reaction_sum[:, 0].tolist(),
        "load_sum_kn": loads[:, 0].tolist(),
    }
