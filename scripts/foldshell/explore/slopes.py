"""dV/dx of a sized design by the envelope theorem: what would help most.

At the least volume V(t; x) under g(t; x) <= 1 the multipliers l >= 0 fulfil dV/dt + sum l dg/dt = 0
on all panels that are free of their bounds, and the volume of the resized design changes by
dV*/dx = dV/dx|t + sum l dg/dx|t (Haftka and Gurdal 1992, Elements of Structural Optimization,
section 5.4). The right-hand slopes are central differences of the refolded geometry at fixed
thickness: one analysis on each side for each variable.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from foldshell.explore.evaluate import choose_settings, prepare_case
from foldshell.explore.folded import FoldedCandidate, fold_candidate, make_design
from foldshell.settings.exploration import Exploration, Variable
from foldshell.settings.field import Plain
from foldshell.settings.stage import StageSettings
from foldshell.shell.effort import FULL
from foldshell.shell.results import panel_area, translations
from foldshell.sizing.constraints import Constraints
from foldshell.sizing.describe import Analysed
from foldshell.sizing.iteration import AnalysisCase, IterationTask, evaluate, prepare_analysis
from foldshell.sizing.linearise import linearise_constraints
from foldshell.sizing.loop import run_loop

TIGHT = 1e-12
"""Tolerance of folding: the geometry is to be a smooth function of the variables."""
STEP = 2e-3
"""Step of the differences, in ranges of a variable; see the tests for its error."""
ACTIVE = 0.97
"""Share of its limit from which a constraint counts as active."""
AT_BOUND = 1e-3
"""Relative distance to a bound of the thickness within which a panel is not free."""


@dataclass(frozen=True)
class Slope:
    """How the volume of the sized design changes with one variable.

    `volume` is dV*/dx in m3 per unit of the variable, `direct` the part at fixed thickness, and
    `per_range` the first times the variable's range, m3.
    """

    variable: str
    volume: float
    direct: float
    per_range: float


@dataclass(frozen=True)
class SizedState:
    """A sized design with what holds it: thickness (P,) m, constraints, multipliers (m,) m3."""

    columns: Plain
    thickness: np.ndarray
    constraints: Constraints
    multipliers: np.ndarray
    volume: float
    residual: float


@dataclass(frozen=True)
class Response:
    """Volume (m3) and constraints (m,) of a design at a fixed thickness."""

    volume: float
    values: np.ndarray


def tighten(settings: StageSettings) -> StageSettings:
    """Return the settings with folding carried on until nothing moves."""
    fold = settings.fold
    return settings.changed(fold.changed(tolerance=TIGHT, max_iterations=10 * fold.max_iterations))


def size_state(
    columns: Mapping[str, object], settings: StageSettings, exploration: Exploration
) -> SizedState:
    """Size a design and find what holds it; raises `ValueError` where it cannot be sized."""
    settings = tighten(choose_settings(settings, exploration))
    folded = fold_candidate(make_design(dict(columns), exploration.supports), settings)
    case = prepare_case(folded, settings, exploration.search.subdivisions)
    loop = run_loop(case, folded.design.span, settings.sizing)
    if loop.final.state != "ok":
        raise ValueError(f"{loop.final.verdict}: {loop.final.reason}: it has no slopes")
    thickness = loop.arrays.thickness
    found = _linearise(_analyse(case, folded, thickness), exploration)
    multipliers, residual = find_multipliers(found, thickness, settings)
    volume = float(found.area @ thickness)
    return SizedState(dict(columns), thickness, found, multipliers, volume, residual)


def _analyse(case: AnalysisCase, folded: FoldedCandidate, thickness: np.ndarray) -> Analysed:
    task = IterationTask(0, folded.design.span, thickness)
    done = evaluate(case, task, prepare_analysis(case, task).run(FULL, None), FULL)
    if done.result.state != "ok":
        raise ValueError(f"{done.result.state}: {done.result.reason}")
    return done


def _linearise(done: Analysed, exploration: Exploration) -> Constraints:
    case = done.case
    factors = np.array(
        [[one.get(name, 0.0) for one in case.combinations.all.values()]
         for name in case.placed.names]
    )  # fmt: skip
    return linearise_constraints(
        done.result, done.stress, case.placed.weight @ factors, case.sizing, done.task.span,
        exploration.limits.buckling_factor_min,
    )  # fmt: skip


def find_multipliers(
    found: Constraints, thickness: np.ndarray, settings: StageSettings
) -> tuple[np.ndarray, float]:
    """min |A + sum l dg/dt| over l >= 0 on the free panels: multipliers (m,) m3, relative residual.

    thickness (P,) m; constraints that are not active have none.
    """
    from scipy.optimize import nnls

    sizing = settings.sizing
    free = (thickness > sizing.least_thickness * (1 + AT_BOUND)) & (
        thickness < sizing.largest_thickness * (1 - AT_BOUND)
    )
    active = found.value > ACTIVE
    multipliers = np.zeros(len(found.value))
    if not (free.any() and active.any()):
        return multipliers, 1.0 if free.any() else 0.0
    # Scaled by thickness: a relative change of each panel weighs by the material it holds.
    weight = np.sqrt(thickness[free] / found.area[free])
    matrix = -(found.gradient[active][:, free] * weight).T
    solved, rest = nnls(matrix, found.area[free] * weight)
    multipliers[active] = solved
    return multipliers, float(rest / np.linalg.norm(found.area[free] * weight))


def respond(
    state: SizedState, columns: Mapping[str, object], settings: StageSettings,
    exploration: Exploration,
) -> Response:  # fmt: skip
    """Return volume and constraints of a design with other columns at the same thickness.

    The sheet is folded anew; raises `ValueError` where there is no such sheet, or no state.
    """
    settings = tighten(choose_settings(settings, exploration))
    folded = fold_candidate(make_design(dict(columns), exploration.supports), settings)
    case = prepare_case(folded, settings, exploration.search.subdivisions)
    done = _analyse(case, folded, state.thickness)
    known, sizing = state.constraints, settings.sizing
    limit = folded.design.span / sizing.displacement_limit_span_over
    strength = done.stress.displacement.shape[1]
    down = -translations(case.model, done.result.displacement)[:, 2, strength:] / limit
    factor = exploration.limits.buckling_factor_min
    values = [
        done.panels[sizing.measure][known.panels] / sizing.utilization_max,
        down[known.nodes[:, 0], known.nodes[:, 1]],
        factor / done.result.buckling.factors[known.factors],
    ]
    area = panel_area(case.model)[: case.model.sized_panels]
    return Response(float(area @ state.thickness), np.concatenate(values))


def differentiate(
    state: SizedState, variable: Variable, settings: StageSettings, exploration: Exploration,
    step: float = STEP,
) -> Response:  # fmt: skip
    """Return the slopes of volume and constraints by one variable, at fixed thickness."""
    width = step * (variable.high - variable.low)
    middle = float(state.columns[variable.name])
    sides = [
        respond(state, {**state.columns, variable.name: middle + sign * width}, settings,
                exploration)
        for sign in (-1, 1)
    ]  # fmt: skip
    return Response(
        (sides[1].volume - sides[0].volume) / (2 * width),
        (sides[1].values - sides[0].values) / (2 * width),
    )


def find_slopes(
    state: SizedState, settings: StageSettings, exploration: Exploration
) -> list[Slope]:
    """Return dV*/dx of each continuous variable of an exploration."""
    found = []
    for variable in exploration.variables:
        if variable.whole or variable.choices:
            continue
        slope = differentiate(state, variable, settings, exploration)
        total = slope.volume + float(state.multipliers @ slope.values)
        wide = total * (variable.high - variable.low)
        found.append(Slope(variable.name, total, slope.volume, wide))
    return found
