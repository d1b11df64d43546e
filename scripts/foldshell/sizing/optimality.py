"""Least volume under linearised constraints: an optimality-criteria step within move limits."""

from dataclasses import replace

import numpy as np

from foldshell.settings.sizing import Sizing
from foldshell.sizing.constraints import Constraints
from foldshell.sizing.rules import SizingState

MARGIN = 0.99
"""Share of each limit that a step aims at: later iterations then stay inside of it."""

MULTIPLIER_MAX = 1e3
"""Bound of the multipliers, in relative volume a unit of g: what cannot be met is approached."""

TURN_FACTOR, CALM_FACTOR = 0.6, 1.1
"""A panel's move limit shrinks where its thickness turns back, and recovers where it goes on."""

STEP_LEAST = 0.01
CHANGE_LEAST = 1e-3
"""Least move limit; relative change below which a panel counts as standing."""


def optimality(state: SizingState, sizing: Sizing) -> SizingState:
    """Minimise the volume of the linearised problem, each panel within its own move limit.

    Raises `ValueError` where the analysis left no constraints.
    """
    if state.constraints is None:
        raise ValueError("the analysis holds no constraint gradients: it was made for another rule")
    lower = state.thickness * (1 - state.step) if state.may_thin else state.thickness
    lower = state.clip(lower, sizing)
    upper = np.maximum(state.clip(state.thickness * (1 + state.step), sizing), lower)
    thickness = minimise_volume(state.thickness, lower, upper, state.constraints)
    change = thickness / state.thickness - 1
    wish = np.where(np.abs(change) > CHANGE_LEAST, np.sign(change), 0).astype(np.int64)
    turned = wish * state.direction < 0
    calm = np.minimum(state.step * CALM_FACTOR, state.step_max)
    step = np.where(turned, np.maximum(state.step * TURN_FACTOR, STEP_LEAST), calm)
    return replace(
        state,
        thickness=thickness,
        step=step,
        direction=np.where(wish == 0, state.direction, wish),
        sign_changes=state.sign_changes + turned,
    )


def minimise_volume(
    thickness: np.ndarray, lower: np.ndarray, upper: np.ndarray, constraints: Constraints
) -> np.ndarray:
    """min sum A t subject to g_j <= margin and lower <= t <= upper, by its dual.

    g is convex and separable: linear in t where it grows with t, in 1/t where it falls. With
    multipliers l the panels follow at once, t_p = sqrt(sum_j l_j c_jp / (A_p + sum_j l_j b_jp)):
    the optimality criterion. The dual is concave; its bounded maximum is found by L-BFGS-B.
    Sources: Fleury & Braibant (1986) Int. J. Numer. Meth. Eng. 23:409; Berke & Khot (1974) AFFDL.

    thickness, lower, upper and the result (P,) m.
    """
    from scipy.optimize import minimize

    weight = constraints.area / (constraints.area @ thickness)
    rising = np.maximum(constraints.gradient, 0)
    falling = np.maximum(-constraints.gradient, 0) * thickness**2
    constant = constraints.value - MARGIN - rising @ thickness - falling @ (1 / thickness)

    def panels(multiplier: np.ndarray) -> np.ndarray:
        """Return the thicknesses (P,) m that are best at given multipliers (k,)."""
        square = (multiplier @ falling) / (weight + multiplier @ rising)
        return np.clip(np.sqrt(square), lower, upper)

    def dual(multiplier: np.ndarray) -> tuple[float, np.ndarray]:
        """Return minus the dual function and its gradient (k,)."""
        new = panels(multiplier)
        excess = constant + rising @ new + falling @ (1 / new)
        return -(weight @ new + multiplier @ excess), -excess

    count = len(constraints.value)
    if count == 0:
        return lower
    found = minimize(
        dual,
        np.full(count, 1e-3),
        jac=True,
        bounds=[(0, MULTIPLIER_MAX)] * count,
        method="L-BFGS-B",
        options={"maxiter": 2000, "maxfun": 4000, "ftol": 1e-14, "gtol": 1e-7},
    )
    return panels(found.x)
