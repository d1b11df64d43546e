"""Colours of exports: thickness classes as in the pictures, kinds of creases as fold tools know."""

import numpy as np

from foldshell.exchange.model import ExportModel
from foldshell.results.colour_scales import ColourScale

ASSIGNMENTS = {"M": (255, 0, 0), "V": (0, 0, 255), "B": (0, 0, 0), "F": (150, 150, 150)}
EDGE_BEAM = (190, 190, 190)


def class_colours(model: ExportModel) -> dict[int, tuple[int, int, int]]:
    """Return a colour for each thickness class, 0 for panels of none."""
    numbers = sorted({panel.thickness_class for panel in model.panels} - {0})
    scale = ColourScale(1.0, max([2, *numbers]), "YlGnBu")
    found = {number: tuple(scale.colour(float(number)).tolist()) for number in numbers}
    return {0: EDGE_BEAM, **found}


def panel_colours(model: ExportModel) -> np.ndarray:
    """Return the colour of each panel, (P, 3) of 0 to 255.

    As whole numbers of red, green and blue.
    """
    colours = class_colours(model)
    return np.array([colours[panel.thickness_class] for panel in model.panels], dtype=np.uint8)
