"""Levenberg-Marquardt on sparse normal equations."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from foldshell.folding.normal_equations import NormalEquations, NotPositiveDefinite
from foldshell.folding.terms import Term

Trial = tuple[np.ndarray, list[tuple[np.ndarray, np.ndarray]], float]
"""Vertices (V, 3) m, rows of the terms there, and the cost."""


@dataclass(frozen=True)
class Minimum:
    """Where a minimisation stopped, and why.

    `cost` is half the sum of squares, `gradient` its largest slope, `converged` tells whether
    a tolerance was met rather than the limit on iterations, `fall` is the share of itself by
    which the cost fell last.
    """

    vertices: np.ndarray
    cost: float
    gradient: float
    iterations: int
    converged: bool
    reason: str
    fall: float = 0.0


def minimise_terms(
    terms: Sequence[Term],
    start: np.ndarray,
    *,
    max_iterations: int,
    cost_tolerance: float,
    step_tolerance: float,
    damping: float = 1e-3,
    equations: NormalEquations | None = None,
    retract: Callable[[np.ndarray], np.ndarray] = lambda trial: trial,
    shorten: bool = False,
) -> Minimum:
    """argmin over vertices (V, 3) of 1/2 sum r2, from `start`.

    Marquardt's damping on the diagonal, with Nielsen's update (IMM report 05, DTU, 1999). Stops
    when the cost falls by less than `cost_tolerance` of itself, or no vertex moves further than
    `step_tolerance` [m]. `retract` brings each trial (V, 3) back onto constraints that the terms
    know only to first order, before its cost is counted. With `shorten` a step along which the cost
    rises is tried once more at a part of its length, which spares a factorisation.
    """
    equations = equations or NormalEquations([t.columns for t in terms], start.size)
    vertices, rows = start, [term.evaluate(start) for term in terms]
    cost, growth, reason, iteration, fall = half_squares(rows), 2.0, "", 0, np.inf
    matrix, gradient = equations.assemble(rows)
    while not reason and iteration < max_iterations:
        iteration += 1
        step, trial_cost = _solve_step(equations, matrix, gradient, damping), np.inf
        if step is not None:
            look = partial(_look, terms, retract, vertices)
            slope = -gradient @ step if shorten else None
            trial, rows, trial_cost = _try_step(look, step, cost, slope)
        if trial_cost < cost:
            shift = damping * equations.diagonal(matrix)
            damping, growth = _relax(damping, shift, step, gradient, cost - trial_cost), 2.0
            if cost - trial_cost <= cost_tolerance * cost:
                reason = f"cost fell by less than {cost_tolerance:g} of itself"
            fall = (cost - trial_cost) / cost
            vertices, cost = trial, trial_cost
            matrix, gradient = equations.assemble(rows)
        else:
            damping, growth = damping * growth, growth * 2
        if step is not None and np.abs(step).max() <= step_tolerance:
            reason = reason or f"no vertex moved further than {step_tolerance:g} m"
    said = reason or f"stopped at the limit of {max_iterations} iterations"
    steepest = float(np.abs(gradient).max())
    return Minimum(vertices, cost, steepest, iteration, bool(reason), said, fall)


def _look(
    terms: Sequence[Term],
    retract: Callable[[np.ndarray], np.ndarray],
    vertices: np.ndarray,
    step: np.ndarray,
) -> Trial:
    """Return vertices (V, 3) after a step (n,), what the terms come to there, and their cost."""
    trial = retract(vertices + step.reshape(-1, 3))
    rows = [term.evaluate(trial) for term in terms]
    return trial, rows, half_squares(rows)


def _try_step(
    look: Callable[[np.ndarray], Trial], step: np.ndarray, cost: float, slope: float | None
) -> Trial:
    """Look at a step (n,); at a part of it where the cost rises and a `slope` at its start says
    that it falls at first."""
    found = look(step)
    if slope is None or not cost < found[2] < np.inf:
        return found
    return look(_find_share(slope, found[2] - cost) * step)


def _find_share(slope: float, rise: float) -> float:
    """Return the share of a step at which a parabola is lowest that falls by `slope` at first and
    has risen by `rise` at its end."""
    return max(0.1, 0.5 * slope / (slope + rise))


def _relax(
    damping: float, shift: np.ndarray, step: np.ndarray, gradient: np.ndarray, fall: float
) -> float:
    """Nielsen's damping after a step (n,) that was taken, by how well the cost's fall was told."""
    gain = fall / (0.5 * step @ (shift * step - gradient))
    return damping * max(1 / 5, 1 - (2 * gain - 1) ** 3)


def half_squares(rows: Sequence[tuple[np.ndarray, np.ndarray]]) -> float:
    """1/2 sum of squared residuals; infinite where one is not finite.

    Each row holds a residual (m,) and its derivatives (m, k).
    """
    cost = 0.5 * sum(float(residual @ residual) for residual, _ in rows)
    return cost if np.isfinite(cost) else np.inf


def _solve_step(
    equations: NormalEquations, matrix: np.ndarray, gradient: np.ndarray, damping: float
) -> np.ndarray | None:
    diagonal = equations.diagonal(matrix)
    shift = damping * np.maximum(diagonal, 1e-12 * diagonal.max())
    try:
        return equations.solve(matrix, shift, -gradient)
    except NotPositiveDefinite:
        return None
