"""Rules that turn the utilization of panels into their next thickness."""

from dataclasses import dataclass, replace

import numpy as np

from foldshell.settings.sizing import Sizing
from foldshell.sizing.constraints import Constraints

SIGN_CHANGES_MAX = 3
"""Changes of direction after which the step of a panel is halved."""


@dataclass(frozen=True)
class SizingState:
    """What a rule sees; arrays are (P,), thickness in m.

    `step` is the relative step of each panel, `direction` its last change (-1, 0, 1),
    `sign_changes` how often that changed sign. `may_thin` tells whether thinning is allowed at all.
    `constraints` serve the rules that work on them, the largest relative step `step_max` the rule
    `optimality` alone; the least buckling factor and the displacement over its limit limit long
    steps of `stress_ratio`. `least` and `largest` are the bounds of panels, None for those of the
    settings.
    """

    thickness: np.ndarray
    utilization: np.ndarray
    step: np.ndarray
    direction: np.ndarray
    sign_changes: np.ndarray
    may_thin: bool = True
    constraints: Constraints | None = None
    step_max: float = np.inf
    least_factor: float = np.inf
    displacement_share: float = 0.0
    least: np.ndarray | None = None
    largest: np.ndarray | None = None

    def clip(self, thickness: np.ndarray, sizing: Sizing) -> np.ndarray:
        """Return thicknesses (P,) m within the bounds of panels, or those of the settings."""
        least = sizing.least_thickness if self.least is None else self.least
        largest = sizing.largest_thickness if self.largest is None else self.largest
        return np.clip(thickness, least, largest)


def start_state(thickness: np.ndarray, step: float) -> SizingState:
    """Return the state before the first change; utilization is not known yet. thickness (P,) m."""
    zero = np.zeros(len(thickness), dtype=np.int64)
    return SizingState(
        thickness, np.full(len(thickness), np.nan), np.full(len(thickness), step), zero, zero
    )


def dead_band(state: SizingState, sizing: Sizing) -> SizingState:
    """Grow by the step above the upper limit, shrink below the lower one, keep in between."""
    return _step(state, wish_of_band(state.utilization, sizing), sizing)


def wish_of_band(utilization: np.ndarray, sizing: Sizing) -> np.ndarray:
    """Return 1 for panels (P,) above the band of utilization, -1 below it, 0 in it.

    Without unit.
    """
    wish = np.where(utilization > sizing.utilization_max, 1, 0)
    return np.where(utilization < sizing.utilization_min, -1, wish)


def fully_stressed(state: SizingState, sizing: Sizing) -> SizingState:
    """Grow above the upper limit, else shrink: the words of the paper, kept for comparison."""
    wish = np.where(state.utilization > sizing.utilization_max, 1, -1)
    return _step(state, wish, sizing)


def thicken_all(state: SizingState, sizing: Sizing, step: float) -> SizingState:
    """Grow every panel by one step, as is done when a structure is unstable or too soft."""
    return replace(state, thickness=state.clip(state.thickness * (1 + step), sizing))


def _step(state: SizingState, wish: np.ndarray, sizing: Sizing) -> SizingState:
    """Move each panel by its own step, which is halved after repeated changes of direction."""
    wish = wish if state.may_thin else np.maximum(wish, 0)
    following = turn(state, wish)
    thickness = state.clip(state.thickness * (1 + wish * following.step), sizing)
    return replace(following, thickness=thickness)


def turn(
    state: SizingState, wish: np.ndarray, sign_changes_max: int = SIGN_CHANGES_MAX
) -> SizingState:
    """Note the way each panel goes, -1, 0 or 1 (P,), no unit; halve its step after some changes."""
    turned = wish * state.direction < 0
    sign_changes = state.sign_changes + turned
    halve = turned & (sign_changes % sign_changes_max == 0)
    step = np.where(halve, state.step / 2, state.step)
    direction = np.where(wish == 0, state.direction, wish)
    return replace(state, step=step, direction=direction, sign_changes=sign_changes)
