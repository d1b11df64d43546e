"""How much work an analysis does: all of it, or what the next step of a sizing loop needs.

Inside a loop an analysis only decides which panels grow or shrink and whether the structure is
stable. Modes change little from one thickness to the next, so the modes of the analysis before are
a start from which one or two inverse iterations suffice; a mode to which all of them are orthogonal
would stay hidden, which is why random vectors come in wherever that could matter.
"""

from dataclasses import dataclass, replace

import numpy as np


@dataclass(frozen=True)
class Effort:
    """What an analysis spends on buckling and on second order.

    Attributes
    ----------
    random_vectors : with which the search for modes begins, beside those of an analysis before
    followed : least number of modes that are followed in all
    pairs : least number of modes that are followed for each combination
    near_tolerance : change of a mode at which its factor counts as found, see `BucklingResult`
    far_tolerance : the same for factors above `NEAR` times the least one
    neighbour_tolerance : change at which all but the first mode of a combination count as found;
        they are followed only to keep the first from settling on a mode that is not the lowest
    ample : least factor of all from which tolerances are `ample_tolerance` at least, and modes of
        factors above `NEAR` times the least one are left as they are
    ample_tolerance : change of a mode at which a factor far above all limits counts as found
    second_order_tolerance : least relative change of displacement at which second order ends; the
        setting counts where it is larger
    watch_growth : count a mode as found only once its factor has stopped falling as the space grows
    check_mechanism : look for mechanisms that Cholesky's method misses
    """

    random_vectors: int = 8
    followed: int = 8
    pairs: int = 2
    near_tolerance: float = 1e-2
    far_tolerance: float = 1e-2
    neighbour_tolerance: float = 0.2
    ample: float = np.inf
    ample_tolerance: float = 0.0
    second_order_tolerance: float = 0.0
    watch_growth: bool = True
    check_mechanism: bool = True


NEAR = 1.5
"""Factors up to this multiple of the least one are as well known as it."""

FULL = Effort(near_tolerance=6e-4, far_tolerance=6e-4)
"""Of a state that is delivered: it hangs on no analysis before it. The error of a factor falls with
the square of the tolerance: 6e-4 leaves less than 1e-6 also where modes are close, 1e-2 5e-5."""

USUAL = Effort()
"""Of an analysis whose factors are compared with those of another mesh or code."""

KNOWN = replace(USUAL, random_vectors=0, followed=1, pairs=1)
"""Of a state whose modes a full search has found already."""

START = Effort(far_tolerance=0.3, second_order_tolerance=1e-4)
"""Inside a loop where the modes of the analysis before cannot be relied on."""

COLD = replace(
    START, near_tolerance=3e-2, neighbour_tolerance=0.5, ample=40.0, ample_tolerance=0.08
)
"""At the begin of a loop, where factors are far above all limits; where not, `START` follows."""

WARM = replace(
    START, random_vectors=0, followed=1, pairs=1, watch_growth=False, check_mechanism=False
)
"""Inside a loop from the modes of the analysis before. Elements keep their matrices and change
their thickness by little, so there is no mechanism where there was none."""

TRACKED = replace(WARM, ample=4.0, ample_tolerance=0.05)
"""The same where nothing but comparisons is taken from factors. While all of them are far above
their limits, two inverse iterations keep the lowest modes on their way; what is then said of
factors is an upper bound, less than 1 % high as a rule, more where another mode becomes the
lowest (13 % once in 140 analyses, at a factor of 189). That none falls below its limit unseen is
for the bound by random vectors."""
