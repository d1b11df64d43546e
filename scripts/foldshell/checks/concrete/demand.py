"""Steel and struts at points of a shell, with two layers of bars or one mesh in the middle."""

from dataclasses import dataclass

import numpy as np

from foldshell.checks.concrete.central_mesh import design_central_mesh
from foldshell.checks.concrete.layout import Layout
from foldshell.checks.concrete.sandwich import design_sandwich


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
    force, moment : (E, q, c, 3) kN/m and kNm/m in the axes of the bars
    thickness : (E,) m
    """
    steel = np.zeros((*force.shape[:-1], 2, 2))
    strut_use = np.zeros(force.shape[:-1])
    two = layout.has_two_layers(thickness)
    for chosen in (two, ~two):
        if not chosen.any():
            continue
        given = force[chosen], moment[chosen], thickness[chosen][:, None, None]
        if chosen is two:
            found = design_sandwich(*given, layout.levels)
            steel[chosen] = found.steel
        else:
            found = design_central_mesh(*given, ratio, layout.levels)
            steel[chosen, ..., 0, :] = found.steel
        strut_use[chosen] = found.strut_use.max(axis=-1)
    return Demand(steel, strut_use)


def principal_tension(force: np.ndarray, moment: np.ndarray, thickness: np.ndarray) -> np.ndarray:
    """s_1 of n / t +- 6 m / t^2, the larger of both faces: (E, q, c) kPa.

    force, moment (E, q, c, 3) kN/m and kNm/m, thickness (E,) m.
    """
    t = thickness[:, None, None, None]
    faces = [force / t + sign * 6 * moment / t**2 for sign in (1, -1)]
    return np.maximum(*[
        (one[..., 0] + one[..., 1]) / 2
        + np.hypot((one[..., 0] - one[..., 1]) / 2, one[..., 2])
        for one in faces
    ])  # fmt: skip
