"""Thicknesses that can be built: multiples of a step, or a list."""

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from foldshell.settings.sizing import Sizing
from foldshell.sizing.constraints import Constraints
from foldshell.sizing.filtered import CHANGE_LEAST, predict
from foldshell.sizing.optimality import MARGIN
from foldshell.sizing.rounding import round_thickness
from foldshell.sizing.rules import SIGN_CHANGES_MAX, SizingState

FloatArray = npt.NDArray[np.float64]
SLACK = 1e-9
"""Relative difference within which a thickness counts as one that can be built."""


def list_buildable(sizing: Sizing) -> FloatArray | None:
    """Return the thicknesses (K,) m that can be built, within both bounds; None for any."""
    least, largest = sizing.least_thickness, sizing.largest_thickness
    if sizing.thickness_list:
        values = np.array(sizing.thickness_list)
    elif sizing.thickness_step:
        first = np.ceil(least / sizing.thickness_step * (1 - SLACK))
        last = np.floor(largest / sizing.thickness_step * (1 + SLACK))
        values = sizing.thickness_step * np.arange(first, last + 1)
    else:
        return None
    return round_thickness(np.clip(values, least, largest))


def round_up(thickness: FloatArray, buildable: FloatArray | None) -> FloatArray:
    """Return the next larger thickness that can be built, at most the largest; (P,) m, (K,) m."""
    if buildable is None:
        return thickness
    place = np.searchsorted(buildable, np.asarray(thickness) * (1 - SLACK))
    return buildable[np.minimum(place, len(buildable) - 1)]


def step_to_buildable(
    before: SizingState, after: SizingState, buildable: FloatArray
) -> SizingState:
    """Round a step up to thicknesses that can be built, so that panels still get thinner.

    A panel that is to thin and would stay goes to the next smaller thickness, unless it has turned
    `SIGN_CHANGES_MAX` times. Under limits that are predicted the panels that do least for them
    go first, as far as the limits allow. Fixed panels and those at their own bounds keep theirs.

    buildable (K,) m.
    """
    least = buildable[0] if before.least is None else before.least
    t, wanted = before.thickness, after.thickness
    new = round_up(wanted, buildable)
    place = np.searchsorted(buildable, t * (1 - SLACK)) - 1
    lower = buildable[np.maximum(place, 0)]
    thins = (wanted < t * (1 - CHANGE_LEAST)) & (after.sign_changes < SIGN_CHANGES_MAX)
    stays = thins & (new >= t * (1 - SLACK)) & (place >= 0) & (lower >= least * (1 - SLACK))
    stands = (np.abs(wanted / t - 1) <= CHANGE_LEAST) | (thins & (new > t))
    new = np.where(stands, t, new)
    if before.constraints is not None:
        stays = _choose_harmless(before.constraints, t, new, lower, stays)
    new = np.where(stays, lower, new)
    if before.largest is not None:
        new = np.where(new > before.largest, np.minimum(wanted, before.largest), new)
    return replace(after, thickness=new)


def _choose_harmless(
    constraints: Constraints, t: FloatArray, new: FloatArray, lower: FloatArray, may: np.ndarray
) -> np.ndarray:
    """Return which panels (P,) of those that may go lower can: least harm for their volume first.

    Harm is what a panel adds to any limit; all are added up until one reaches its margin.
    """
    base = predict(constraints, t, new)
    falling, rising = np.maximum(-constraints.gradient, 0), np.maximum(constraints.gradient, 0)
    harm = falling * (t**2 * (1 / lower - 1 / new)) - rising * (new - lower)
    room = np.maximum(MARGIN - base, 0)
    worst = (harm / np.maximum(room, SLACK)[:, None]).max(axis=0, initial=0.0)
    worth = worst / (constraints.area * np.maximum(new - lower, SLACK))
    order = np.flatnonzero(may)[np.argsort(worth[may], kind="stable")]
    total = np.cumsum(np.maximum(harm[:, order], 0), axis=1)
    fits = (total <= room[:, None]).all(axis=0)
    chosen = np.zeros(len(t), dtype=bool)
    chosen[order[fits]] = True
    return chosen
