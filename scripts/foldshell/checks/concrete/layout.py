"""What lies in a sheet: kind, cover and depth of the bars, and which of its places fit."""

from dataclasses import dataclass

import numpy as np

from foldshell.checks.concrete.detailing import (
    least_clear_distance,
    least_cover,
    least_thickness_of_layers,
)
from foldshell.checks.concrete.sandwich import Levels
from foldshell.checks.concrete.strengths import Strengths, find_strengths, refuse_strength
from foldshell.settings.reinforcement import Reinforcement

DIAMETERS = np.array([6, 8, 10, 12, 14, 16, 20, 25, 28, 32]) / 1e3
"""Bars that are made, in m (EN 10080)."""


@dataclass(frozen=True)
class Layout:
    """Reinforcement as it is asked for.

    Attributes
    ----------
    kind : bars, central_mesh or textile
    cover, diameter : m, of the outer bars
    cover_needed : m, by exposure, class and diameter
    two_from : m, thickness from which two layers fit; inf where one mesh is asked for
    least : m, thickness from which one mesh has the cover that it needs
    clear : m, least clear distance of bars
    density : kg/m3
    strengths : of concrete and steel
    """

    kind: str
    cover: float
    diameter: float
    cover_needed: float
    two_from: float
    least: float
    clear: float
    density: float
    strengths: Strengths

    @property
    def levels(self) -> Levels:
        """Where the covers of two layers act: at the middle of bars that cross."""
        found = self.strengths
        return Levels(self.cover + self.diameter, found.fcd, found.strut)

    def has_two_layers(self, thickness: np.ndarray) -> np.ndarray:
        """Whether two layers fit, (P,) bool; thickness (P,) m."""
        return np.asarray(thickness) >= self.two_from - 1e-9


def lay_out(asked: Reinforcement) -> Layout:
    """Read cover, diameter and strengths of bars, one mesh or textile.

    The depth of textile is that of its own cover: carbon does not rust.
    """
    grid = asked.kind == "textile"
    cover = asked.textile.cover if grid else asked.cover
    diameter = asked.textile.diameter if grid else asked.diameter
    needed = cover
    if not grid:
        needed = least_cover(
            asked.exposure, asked.structural_class, diameter, asked.cover_deviation
        )
    two_from = least_thickness_of_layers(cover, diameter, asked.layer_gap)
    return Layout(
        kind=asked.kind,
        cover=cover,
        diameter=diameter,
        cover_needed=needed,
        two_from=np.inf if asked.kind == "central_mesh" else two_from,
        least=2 * needed + 2 * diameter,
        clear=0.0 if grid else least_clear_distance(diameter, asked.aggregate),
        density=asked.textile.density if grid else asked.steel_density,
        strengths=_find_strengths(asked),
    )


def _find_strengths(asked: Reinforcement) -> Strengths:
    if asked.kind == "textile":
        own = asked.textile
        return find_strengths(
            asked.fck, own.strength, asked.gamma_c, 1.0, asked.alpha_cc, own.youngs_modulus
        )
    return find_strengths(
        asked.fck, asked.fyk, asked.gamma_c, asked.gamma_s, asked.alpha_cc, asked.steel_modulus
    )


def refuse_layout(asked: Reinforcement, thickness: np.ndarray) -> str:
    """Return a sentence where nothing can be designed, else an empty text; thickness (P,) m.

    A strength outside the code's range, a cover that a sheet does not hold, an exposure that no
    place in it meets: each is a result of the design.
    """
    refused = refuse_strength(asked.fck, asked.fyk, asked.kind)
    if refused:
        return refused
    layout, thinnest = lay_out(asked), float(np.min(thickness))
    if layout.cover >= thinnest:
        return (
            f"cover of {1e3 * layout.cover:g} mm is not less than the sheet's "
            f"{1e3 * thinnest:.4g} mm"
        )
    if 2 * layout.diameter >= thinnest:
        return (
            f"bars of {1e3 * layout.diameter:g} mm that cross do not fit a sheet of "
            f"{1e3 * thinnest:.4g} mm"
        )
    if layout.cover_needed > layout.cover + 1e-9:
        return (
            f"exposure {asked.exposure} needs a cover of {1e3 * layout.cover_needed:g} mm, "
            f"cover_mm is {1e3 * layout.cover:g}"
        )
    return ""


def describe_fit(layout: Layout, thickness: np.ndarray) -> str:
    """Return a sentence of the panels in which one mesh has not its cover, else how bars fit.

    thickness (P,) m.
    """
    thinnest, too_thin = float(np.min(thickness)), np.asarray(thickness) < layout.least - 1e-9
    if not too_thin.any():
        return "bars do not fit between their least distances"
    return (
        f"{int(too_thin.sum())} panels from {1e3 * thinnest:.4g} mm have no place for crossing "
        f"bars of {1e3 * layout.diameter:g} mm under {1e3 * layout.cover_needed:g} mm of cover, "
        f"which take {1e3 * layout.least:g} mm"
    )
