"""Steel and struts at points of a shell, with two layers of bars or one mesh in the middle."""

from dataclasses import dataclass

import numpy as np

from foldshell.checks.concrete.central_mesh import resolve_central_mesh
from foldshell.checks.concrete.layout import Layout
from foldshell.checks.concrete.sandwich import resolve_covers


@dataclass(frozen=True)
class Demand:
    """What is needed at the points of elements.

    `steel` (E, q, c, 2, 2) kN/m, bottom and top, bars along x and y; one mesh stands in the place
    of the bottom. `strut_use` (E, q, c) share of the strength of the concrete.
    """

    steel: np.ndarray
    strut_use: np.ndarray


def find_demand(
    force: np.ndarray, moment: np.ndarray, thickness: np.ndarray, layout: Layout, ratio: float
) -> Demand:
    """Design two layers where they fit, else one mesh with its lever of `ratio` t.

    Parameters
    ----------
    force, moment : (3, E, q, c) kN/m and kNm/m, xx, yy, xy in the axes of the bars
    thickness : (E,) m
    """
    steel = np.zeros((*force.shape[1:], 2, 2))
    strut_use = np.zeros(force.shape[1:])
    two = layout.has_two_layers(thickness)
    for chosen in (two, ~two):
        if not chosen.any():
            continue
        part = slice(None) if chosen.all() else chosen
        half = np.broadcast_to(thickness[chosen][:, None, None] / 2, strut_use[part].shape)
        given = force[:, part], moment[:, part], half
        if chosen is two:
            covers = resolve_covers(*given, layout.levels)
            for layer, cover in enumerate(covers):
                for axis, bars in enumerate(cover.pull.bars(*cover.force[:2])):
                    steel[part, ..., layer, axis] = bars
            strut_use[part] = np.maximum(*(cover.strut_use for cover in covers))
        else:
            found = resolve_central_mesh(*given, ratio, layout.levels)
            for axis, bars in enumerate(found.steel):
                steel[part, ..., 0, axis] = bars
            strut_use[part] = np.maximum(*found.strut_use)
    return Demand(steel, strut_use)


def principal_tension(force: np.ndarray, moment: np.ndarray, thickness: np.ndarray) -> np.ndarray:
    """s_1 of n / t +- 6 m / t^2, the larger of both faces: (E, q, c) kPa.

    force, moment (3, E, q, c) kN/m and kNm/m, thickness (E,) m.
    """
    t = thickness[:, None, None]
    membrane, bending = force / t, moment * (6 / t**2)
    return np.maximum(_largest(membrane + bending), _largest(membrane - bending))


def _largest(stress: np.ndarray) -> np.ndarray:
    """Return the larger principal value (...) of stresses (3, ...), in their unit."""
    x, y, xy = stress
    return (x + y) / 2 + np.sqrt(((x - y) / 2) ** 2 + xy**2)
