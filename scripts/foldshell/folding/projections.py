"""Averaged projections: an explicit engine after Kangaroo 2, to compare with.

Every goal moves its vertices the least way that satisfies it; each vertex takes the weighted
mean of what its goals ask, with momentum (Piker, Kangaroo 2, 2015; Bouaziz et al., Projective
Dynamics, 2014). The minimum is that of the weighted squares which Levenberg-Marquardt finds.
"""

from collections.abc import Sequence

import numpy as np

from foldshell.folding.levenberg import Minimum, half_squares
from foldshell.folding.terms import Term

MOMENTUM = 0.97
WINDOW = 50  # iterations over which the fall of the cost is judged


def average_projections(
    terms: Sequence[Term],
    start: np.ndarray,
    *,
    max_iterations: int,
    cost_tolerance: float,
    step_tolerance: float,
) -> Minimum:
    """Iterate x += mean_g(-r_g J_g / |J_g|2) + momentum, vertices (V, 3), from `start`.

    A goal's weight is |J_g|2, which makes the fixed point the least-squares one. Momentum is
    dropped whenever it points against the goals. Stops when the least cost fell by less than
    `cost_tolerance` of itself in WINDOW iterations, or when no vertex moves `step_tolerance` [m].
    """
    vertices, velocity, best = start, np.zeros_like(start), start
    history: list[float] = []
    reason, iteration = "", 0
    columns, earlier = [term.columns for term in terms], np.inf
    while not reason and iteration < max_iterations:
        iteration += 1
        rows = [term.evaluate(vertices) for term in terms]
        cost = half_squares(rows)
        if not history or cost < history[-1]:
            best = vertices
        history.append(min(cost, history[-1]) if history else cost)
        move = _mean_move(columns, rows, start.size)
        if np.sum(move * velocity) < 0:
            velocity = np.zeros_like(velocity)
        velocity = MOMENTUM * velocity + move
        vertices = vertices + velocity
        if np.abs(velocity).max() <= step_tolerance:
            reason = f"no vertex moved further than {step_tolerance:g} m"
        earlier = history[-WINDOW] if len(history) >= WINDOW else np.inf
        if np.isfinite(earlier) and earlier - history[-1] <= cost_tolerance * history[-1]:
            reason = f"cost fell by less than {cost_tolerance:g} of itself"
    return Minimum(
        best, history[-1], float(np.abs(velocity).max()), iteration, bool(reason),
        reason or f"stopped at the limit of {max_iterations} iterations",
        earlier / history[-1] - 1 if history[-1] > 0 else 0.0,
    )  # fmt: skip


def _mean_move(
    columns: Sequence[np.ndarray], rows: Sequence[tuple[np.ndarray, np.ndarray]], unknowns: int
) -> np.ndarray:
    """-J^T r over the summed weights of the goals at each vertex: moves (V, 3)."""
    force, weight = np.zeros(unknowns), np.zeros(unknowns // 3)
    for column, (residual, values) in zip(columns, rows, strict=True):
        force -= np.bincount(column.ravel(), (values * residual[:, None]).ravel(), unknowns)
        goal = np.einsum("ij,ij->i", values, values)
        # A goal weighs on each vertex once, however many coordinates of it are touched.
        first = np.ones(column.shape, dtype=bool)
        first[:, 1:] = column[:, 1:] // 3 != column[:, :-1] // 3
        share = np.where(first, goal[:, None], 0.0)
        weight += np.bincount((column // 3).ravel(), share.ravel(), len(weight))
    return force.reshape(-1, 3) / np.where(weight > 0, weight, 1.0)[:, None]
