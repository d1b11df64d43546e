"""Bars that are bought: one diameter and spacing for each layer and direction of a class."""

from dataclasses import dataclass

import numpy as np

from foldshell.checks.concrete.detailing import largest_bar_spacing
from foldshell.checks.concrete.layout import DIAMETERS, Layout

STEP = 0.025
"""Spacings are multiples of it, m; below it of a fifth of it."""
PLACES = ("bottom", "top")


@dataclass(frozen=True)
class BarRow:
    """Bars of one layer and direction in one class of thickness.

    `layer` bottom, top or middle; `direction` x or y; `diameter`, `spacing` in m (None for a grid);
    `area` m2/m given, `mass` kg in all panels of the class, `use` the largest needed over given.
    """

    thickness: float
    panels: int
    layer: str
    direction: str
    diameter: float
    spacing: float | None
    area: float
    mass: float
    use: float


def make_schedule(
    needed: np.ndarray,
    two_layers: np.ndarray,
    class_thickness: np.ndarray,
    panel_area: np.ndarray,
    layout: Layout,
) -> list[BarRow]:
    """Choose the lightest bars that hold the largest need of each class, layer and direction.

    Panels of a class that have one mesh and those that have two layers get rows of their own.

    Parameters
    ----------
    needed : (P, 2, 2) m2/m with least steel
    two_layers : (P,) bool
    class_thickness : (P,) m, of the class of each panel
    panel_area : (P,) m2
    """
    rows = []
    for thickness in np.unique(class_thickness):
        for two in (False, True):
            own = (class_thickness == thickness) & (two_layers == two)
            if not own.any():
                continue
            for layer in range(2 if two else 1):
                name = PLACES[layer] if two else "middle"
                for k, direction in enumerate("xy"):
                    most = float(needed[own, layer, k].max())
                    if most <= 0:
                        continue
                    diameter, spacing, given = choose_bars(most, float(thickness), two, layout)
                    mass = given * float(panel_area[own].sum()) * layout.density
                    rows.append(BarRow(
                        float(thickness), int(own.sum()), name, direction, diameter, spacing,
                        given, mass, most / given,
                    ))  # fmt: skip
    return rows


def choose_bars(
    area: float, thickness: float, two_layers: bool, layout: Layout
) -> tuple[float, float | None, float]:
    """Return diameter (m), spacing (m) and area (m2/m) of the lightest bars that fit.

    Of a textile, the grid that is needed. Where no bars fit, the thickest that the depth holds at
    their least spacing: less than what is needed, and `fit_use` says so.
    """
    if layout.kind == "textile":
        return layout.diameter, None, area
    widest = float(largest_bar_spacing(np.array(thickness)))
    found = []
    for diameter in DIAMETERS[layout.diameter - 1e-9 <= DIAMETERS]:
        depth = 2 * max(layout.cover, diameter) + (4 if two_layers else 2) * diameter
        if depth > thickness + 1e-9 and diameter > layout.diameter:
            continue
        one = np.pi * diameter**2 / 4
        spacing = max(_round_down(min(one / area, widest)), diameter + layout.clear)
        found.append((one / spacing < area * (1 - 1e-9), one / spacing, float(diameter), spacing))
    too_little = all(one[0] for one in found)
    _, given, diameter, spacing = (
        max(found, key=lambda one: one[1])
        if too_little
        else min(one for one in found if not one[0])
    )
    return diameter, float(spacing), float(given)


def _round_down(spacing: float) -> float:
    step = STEP if spacing >= 2 * STEP else STEP / 5
    return np.floor(spacing / step + 1e-9) * step
