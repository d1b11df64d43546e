"""Levenberg-Marquardt on sparse normal equations."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from foldshell.folding.normal_equations import NormalEquations, NotPositiveDefinite
from foldshell.folding.terms import Term


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

    def look(trial: np.ndarray) -> tuple[np.ndarray, list, float]:
        own = [term.evaluate(trial) for term in terms]
        return trial, own, half_squares(own)

    equations = equations or NormalEquations([t.columns for t in terms], start.size)
    vertices, growth = start, 2.0
    _, rows, cost = look(vertices)
    reason, iteration, fall = "", 0, np.inf
    matrix, gradient = equations.assemble(rows)
    while not reason and iteration < max_iterations:
        iteration += 1
        step = _solve_step(equations, matrix, gradient, damping)
        if step is None:
            damping, growth, trial_cost = damping * growth, growth * 2, np.inf
        else:
            trial, rows, trial_cost = look(retract(vertices + step.reshape(-1, 3)))
            if shorten and cost < trial_cost < np.inf:
                share = _find_share(-gradient @ step, trial_cost - cost)
                trial, rows, trial_cost = look(retract(vertices + share * step.reshape(-1, 3)))
        if trial_cost < cost:
            shift = damping * equations.diagonal(matrix)
            damping, growth = _relax(damping, shift, step, gradient, cost - trial_cost), 2.0
            if cost - trial_cost <= cost_tolerance * cost:
                reason = f"cost fell by less than {cost_tolerance:g} of itself"
            fall = (cost - trial_cost) / cost
            vertices, cost = trial, trial_cost
            matrix, gradient = equations.assemble(rows)
        elif step is not None:
            damping, growth = damping * growth, growth * 2
        if step is not None and np.abs(step).max() <= step_tolerance:
            reason = reason or f"no vertex moved further than {step_tolerance:g} m"
    said = reason or f"stopped at the limit of {max_iterations} iterations"
    slope = float(np.abs(gradient).max())
    return Minimum(vertices, cost, slope, iteration, bool(reason), said, fall)


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
