"""The stress-ratio method with the end of the dead band: long steps far from the target.

Where forces stay, stress in a plate goes with 1/t if it is membrane stress and with 1/t^2 if it is
bending; so t u / u_target is the next guess of fully stressed design (Razani 1965, J. Struct. Div.
ASCE 91, on when it converges; Haftka & Gurdal 1992, Elements of Structural Optimization, 9.1),
right for the first kind and short of the target for the second. It is taken while a panel is on its
way down and has not turned. A panel in the band stands, as in `dead_band`; one that has turned
goes on by its own step, halved at every turn.
"""

from dataclasses import replace

import numpy as np

from foldshell.settings.sizing import Sizing
from foldshell.sizing.rules import SizingState, turn, wish_of_band

FACTOR_KEPT = 2.0
"""Multiple of the least buckling factor for thinning that a long step may come down to, if it falls
with the cube of the thickness: forces move while panels thin."""

DISPLACEMENT_KEPT = 1.0
"""Share of the limit of displacement that a long step may come up to, by the same cube."""


def stress_ratio(state: SizingState, sizing: Sizing) -> SizingState:
    """Shrink by 1 - u/u_min, by `step` at least and `ratio_limit` at most; grow by `step`.

    Long steps are for panels that have never turned, and no longer than buckling and displacement
    allow: with a cubic law for both, (1 - s)^3 is at least the ratio of what is kept to what is.
    """
    wish = wish_of_band(state.utilization, sizing)
    wish = wish if state.may_thin else np.maximum(wish, 0)
    following = turn(state, wish, sign_changes_max=1)
    ratio = 1 - state.utilization / sizing.utilization_min
    longest = min(sizing.ratio_limit, limit_step(state, sizing))
    long = np.clip(ratio, sizing.step, max(longest, sizing.step))
    fresh = (wish < 0) & (following.sign_changes == 0)
    share = np.where(fresh, long, following.step)
    thickness = state.clip(state.thickness * (1 + wish * share), sizing)
    return replace(following, thickness=thickness)


def limit_step(state: SizingState, sizing: Sizing) -> float:
    """Return the largest relative thinning that stability and displacement allow."""
    kept = FACTOR_KEPT * max(1.0, sizing.thinning_buckling_factor_min)
    shares = kept / state.least_factor, state.displacement_share / DISPLACEMENT_KEPT
    return 1 - min(1.0, max(shares)) ** (1 / 3)
