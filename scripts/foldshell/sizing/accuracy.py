"""How well an analysis inside the loop has to be known, and when it is not known well enough.

The next thickness of rules that only compare utilization with limits is the same to the last bit as
long as every comparison comes out the same. So an analysis begins roughly, from the modes of the
one before, and is repeated with more effort where a comparison is close, where modes could hide,
and where its state is delivered. All of it follows from what the files of a loop hold.
"""

from dataclasses import replace

import numpy as np

from foldshell.records.analysis import AnalysisRecord
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.settings.sizing import Sizing
from foldshell.shell.effort import COLD, START, TRACKED, USUAL, WARM, Effort

COMPARING = ("dead_band", "fully_stressed")
"""Rules that take nothing but comparisons from an analysis; others get all digits of it."""

BY_UTILIZATION = ("stress_ratio",)
"""Rules that take utilization with all its digits and nothing but comparisons of factors."""

HIDDEN_FACTOR = 2.0
"""Least buckling factor, over its limit where that is above 1, below which random vectors come in:
a mode that the warm ones do not see could then already stop the thinning."""

LARGE_STEP = 0.15
"""Relative change of a thickness from which the modes of the analysis before say little."""

CLOSE = 3e-4
"""Relative distance of utilization or displacement from a limit at which second order is brought
to its full accuracy. A tolerance of 1e-4 moves them by 2e-4 at most on nine folded sheets."""

CLOSE_FACTOR = 5e-3
"""The same for buckling factors: a change of 1e-2 bounds their error by 1e-4 over the gap between
modes. Warm modes alone were 4e-2 too high once in 131 analyses, where modes cross: the bound of
hidden factors stands for that."""


def choose_effort(
    sizing: Sizing,
    thickness: np.ndarray,
    previous: AnalysisRecord | None,
    arrays: AnalysisArrays | None,
    edited: bool,
) -> Effort:
    """Return what the analysis of a thickness (P,) m inside a loop begins with.

    `previous` and `arrays` are of the analysis before, `edited` tells of panels changed by hand.
    """
    if sizing.rule not in COMPARING + BY_UTILIZATION:
        return USUAL
    effort = _choose_search(sizing, thickness, previous, arrays, edited)
    if sizing.rule in BY_UTILIZATION:
        return replace(effort, second_order_tolerance=0.0, ample=np.inf)
    return _scale_ample(sizing, TRACKED if effort is WARM else effort)


def _choose_search(sizing, thickness, previous, arrays, edited) -> Effort:
    """Return how buckling is searched for, with the rest of the effort inside a loop."""
    if previous is None:
        return COLD
    if previous.state != "ok" or arrays.buckling_modes is None or edited:
        return START
    change = np.abs(thickness / arrays.thickness - 1).max()
    bound = bound_hidden_factor(previous, thickness, arrays.thickness)
    return START if change > LARGE_STEP or bound < _careful(sizing) else WARM


def _scale_ample(sizing: Sizing, effort: Effort) -> Effort:
    """Count as ample what is so far above the limits of these settings as above the usual ones."""
    scale = _careful(sizing) / HIDDEN_FACTOR
    return effort if scale == 1 else replace(effort, ample=effort.ample * scale)


def bound_hidden_factor(
    previous: AnalysisRecord, thickness: np.ndarray, before: np.ndarray
) -> float:
    """Return a factor that no mode is expected to fall below, seen by the warm ones or not.

    Bending stiffness falls with the cube of the thickness, so the factor of any mode that random
    vectors would have found then has fallen by no more, where forces stay. thickness (P,) m, as is
    that of the analysis before.
    """
    known = previous.buckling_factor_bound
    if known is None:
        return 0.0
    return known * min(1.0, float((thickness / before).min())) ** 3


def is_doubtful(sizing: Sizing, factor: float | None) -> bool:
    """Tell whether the least factor is low enough to be looked at with more care."""
    return factor is not None and factor < _careful(sizing)


def _careful(sizing: Sizing) -> float:
    limits = 1.0, sizing.thinning_buckling_factor_min, sizing.buckling_factor_min
    return max(HIDDEN_FACTOR, HIDDEN_FACTOR / 1.5 * max(limits))


def is_factor_close(sizing: Sizing, factor: float | None) -> bool:
    """Tell whether the least factor is too near to one of its limits to compare them."""
    limits = 1.0, sizing.thinning_buckling_factor_min, sizing.buckling_factor_min
    return factor is not None and any(abs(factor - one) < CLOSE_FACTOR * one for one in limits)


def is_state_close(
    sizing: Sizing, utilization: np.ndarray, displacement: float, span: float
) -> bool:
    """Tell whether a utilization (P,) or the displacement (m) is too near to one of its limits."""
    pairs = [(utilization, one) for one in (sizing.utilization_min, sizing.utilization_max)]
    pairs.append((np.array([displacement]), span / sizing.displacement_limit_span_over))
    return any((np.abs(values - limit) < CLOSE * limit).any() for values, limit in pairs)
