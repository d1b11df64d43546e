"""The thicknesses that a loop begins with."""

import numpy as np

from foldshell.settings.sizing import Sizing
from foldshell.sizing.buildable import list_buildable, round_up
from foldshell.sizing.panel_limits import PanelLimits, hold_limits
from foldshell.sizing.rounding import FloatArray, round_thickness


def start_thicknesses(count: int, sizing: Sizing, limits: PanelLimits | None = None) -> FloatArray:
    """Return the thickness (P,) m that so many panels begin with."""
    begin = round_up(np.full(count, sizing.start_thickness), list_buildable(sizing))
    return round_thickness(hold_limits(limits, begin, *sizing.bounds))
