"""The dead band's wish, filtered by what it would do to displacement and buckling factor."""

from dataclasses import replace

import numpy as np

from foldshell.settings.sizing import Sizing
from foldshell.sizing.constraints import Constraints
from foldshell.sizing.optimality import MARGIN, minimise_volume
from foldshell.sizing.rules import SizingState, turn, wish_of_band

CHANGE_LEAST = 1e-3
"""Relative change below which a panel counts as standing."""


REACH = 0.5
"""Share left out of what one step could bring, where that is not enough to reach a limit."""


def filtered_dead_band(state: SizingState, sizing: Sizing) -> SizingState:
    """Take the step of the dead band; where displacement or buckling would pass 99 % of its limit,
    the least volume that the linearised limits allow within a step.

    Panels above the band grow in any case. Of those below it only those thin whose material does
    least for the limits, by two steps at most, since the limits are known here and the band leaves
    room (0.6 / 0.9^4 < 1). Where a limit is passed though nothing thins, the panels that do most
    for it grow, by one step at most. Raises `ValueError` where the analysis left no constraints.
    """
    if state.constraints is None or state.constraints.thinning is None:
        raise ValueError("the analysis holds no constraint gradients: it was made for another rule")
    t = state.thickness
    wish = wish_of_band(state.utilization, sizing)
    wish = wish if state.may_thin else np.maximum(wish, 0)
    grown = state.clip(t * (1 + state.step), sizing)
    thickness = np.where(wish > 0, grown, t)
    thickness = np.where(wish < 0, state.clip(t * (1 - state.step), sizing), thickness)
    if not _within(state.constraints, t, thickness, MARGIN):
        upper = np.maximum(thickness, t)
        upper = upper if _within(state.constraints, t, upper, 1.0) else np.maximum(upper, grown)
        thinned = state.clip(t * (1 - state.step) ** state.constraints.thinning, sizing)
        lower = np.where(wish < 0, thinned, np.maximum(thickness, t))
        thickness = minimise_volume(t, lower, upper, _relax(state.constraints, t, upper))
    change = thickness / t - 1
    way = np.where(np.abs(change) > CHANGE_LEAST, np.sign(change), 0).astype(np.int64)
    return replace(turn(state, way), thickness=thickness)


def predict(constraints: Constraints, old: np.ndarray, new: np.ndarray) -> np.ndarray:
    """Return g (m,) at thicknesses (P,) m, linear in t where it grows with t, else in 1/t.

    `old` (P,) m is where the constraints were linearised.
    """
    rising = np.maximum(constraints.gradient, 0) @ (new - old)
    falling = np.maximum(-constraints.gradient, 0) @ (old**2 / new - old)
    return constraints.value + rising + falling


def _relax(constraints: Constraints, old: np.ndarray, upper: np.ndarray) -> Constraints:
    """Ask of limits that one step cannot reach for half of what it can; else nothing that helps
    a little would be left out."""
    best = predict(constraints, old, upper)
    excess = np.maximum(best + REACH * np.maximum(constraints.value - best, 0) - MARGIN, 0)
    return replace(constraints, value=constraints.value - np.where(best > MARGIN, excess, 0))


def _within(constraints: Constraints, old: np.ndarray, new: np.ndarray, share: float) -> bool:
    return bool((predict(constraints, old, new) <= share).all())
