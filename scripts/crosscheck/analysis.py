"""All that is compared, for one mesh of a model."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from crosscheck.discretisation import Discretisation, discretise
from crosscheck.errors import CrosscheckError, MechanismError
from crosscheck.frontal import NotPositiveDefinite
from crosscheck.loads import combine_cases, compute_surface_loads, distribute_loads
from crosscheck.model import Model
from crosscheck.ordering import Plan
from crosscheck.reactions import sum_supports
from crosscheck.records import MULTIFRONTAL, SCIPY
from crosscheck.stress import compute_panel_means, compute_percentile, compute_utilization
from crosscheck.supports import hold_supports
from crosscheck.system import (
    SHEAR_FACTOR,
    Response,
    Section,
    State,
    System,
    build_system,
    solve_loads,
)

if TYPE_CHECKING:
    from crosscheck.plain import PlainSystem


@dataclass(frozen=True)
class Analysis:
    """A model on one mesh: its system, loads on facet nodes (F, R, 3, k) and first-order answer."""

    model: Model
    system: "System | PlainSystem"
    surface: np.ndarray  # (F, 3, k) kN/m2
    forces: np.ndarray
    response: Response


def analyse_model(
    model: Model,
    subdivisions: int,
    shear_factor: float = SHEAR_FACTOR,
    plan: Plan | None = None,
    solver: str = MULTIFRONTAL,
) -> Analysis:
    """First-order answer to the compared combinations on `subdivisions` elements a block side.

    `plan` is that of `plan_facets`, made here where it is not given; `solver` is
    MULTIFRONTAL, or SCIPY for the plain path.
    """
    build, solve = _choose_solver(solver)
    hold = hold_supports(model.supports, model.vertices)
    grid = discretise(model.vertices, model.facets, hold, subdivisions, plan=plan)
    material = model.material
    section = Section(
        model.thickness, material.youngs_modulus, material.poissons_ratio, shear_factor
    )
    try:
        system = build(grid, section)
    except NotPositiveDefinite:
        raise MechanismError(
            "model: supports: these let the shell move: allowed are such as hold it"
        ) from None
    surface, forces = find_loads(model, grid)
    return Analysis(model, system, surface, forces, solve(system, forces))


def find_loads(model: Model, grid: Discretisation) -> tuple[np.ndarray, np.ndarray]:
    """Mean load of each combination on facets (F, 3, k) kN/m2, forces on their nodes (F, R, 3, k)
    kN."""
    chosen = model.compared_combinations
    if not model.own_loads:
        surface = combine_cases(compute_surface_loads(model, grid.axes[:, 2]), chosen)
        return surface, distribute_loads(grid, surface)
    from crosscheck.own_forces import distribute_own_loads

    mean, forces = distribute_own_loads(model, grid)
    return combine_cases(mean, chosen, model.cases), combine_cases(forces, chosen, model.cases)


def _choose_solver(solver: str) -> tuple[Callable, Callable]:
    """What builds a system and what solves it; the plain path is imported where it is taken."""
    if solver == MULTIFRONTAL:
        return build_system, solve_loads
    if solver != SCIPY:
        raise CrosscheckError(
            f"crosscheck.solver: {solver!r}: allowed are {MULTIFRONTAL} and {SCIPY}"
        )
    from crosscheck.plain import build_plain_system, solve_plain_loads

    return build_plain_system, solve_plain_loads


def measure_response(
    analysis: Analysis, state: State, case: int, forces: np.ndarray
) -> dict[str, float]:
    """Displacement, work of `forces` (F, R, 3) and utilization for one column of a state.

    Forces in kN, displacement in m, work in kNm.
    """
    model, grid = analysis.model, analysis.system.grid
    moved = state.displacement[..., case]
    use = compute_utilization(grid, analysis.system.section, model.material, state.local[..., case])
    means = compute_panel_means(use, grid.quadrature.area, model.facet_panel)
    return {
        "displacement_down_max_m": float(-moved[..., 2].min()),
        "displacement_max_m": float(np.sqrt((moved**2).sum(axis=-1).max())),
        "work_knm": float((moved * forces).sum()),
        "utilization_p99": compute_percentile(use, grid.quadrature.area),
        "utilization_panel_mean_max": float(means.max()),
    }


def sum_loads(grid: Discretisation, surface: np.ndarray) -> np.ndarray:
    """Resultant of uniform facet loads (F, 3, k): (3, k) in kN, by summing areas."""
    area = grid.quadrature.area.reshape(len(surface), -1).sum(axis=1)
    return np.einsum("f,fxk->xk", area, surface)


def list_statics(
    analysis: Analysis, response: Response, loads: np.ndarray
) -> list[dict[str, object]]:
    """Loads (3, k) and reactions of each column, those of all and of each support: kN."""
    supports = sum_supports(analysis.model, analysis.system.grid.mesh, response.reactions)
    return [
        {
            "reaction_sum_kn": response.reaction_sum[:, case].tolist(),
            "load_sum_kn": loads[:, case].tolist(),
            "support_reactions_kn": {
                name: sums[:, case].tolist() for name, sums in supports.items()
            },
        }
        for case in range(loads.shape[1])
    ]


def list_values(analysis: Analysis) -> dict[str, dict[str, object]]:
    """First-order values of each compared combination."""
    response = analysis.response
    statics = list_statics(analysis, response, sum_loads(analysis.system.grid, analysis.surface))
    return {
        name: measure_response(analysis, response, case, analysis.forces[..., case]) | statics[case]
        for case, name in enumerate(analysis.model.compared_combinations)
    }
