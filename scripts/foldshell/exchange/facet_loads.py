"""Load cases as exports write them: what no program has a word for, as loads on whole facets."""

from collections.abc import Sequence

import numpy as np

from foldshell.exchange.model import SpreadLoad
from foldshell.loads.cases import (
    PRESSURE,
    SETTLEMENT,
    TEMPERATURE,
    SurfaceLoad,
    group_cases,
)
from foldshell.loads.extent import SheetElements
from foldshell.shell.placed_loads import place_on_sheet, quadrature_table

WORDED = ("sheet", "plan_abs")
"""Areas that programs, or a share in the value, can say."""


def spread_cases(
    cases: Sequence[SurfaceLoad],
    corners: np.ndarray,
    panel: np.ndarray,
    thickness: np.ndarray,
    loaded: np.ndarray,
) -> tuple[SurfaceLoad, ...]:
    """Return one load a case: the load itself where it is uniform, else its mean on each facet.

    The mean keeps the resultant of zones that cut facets, of lines and of points, not their moment
    about a facet's middle. Temperature and settlements are left out.

    Parameters
    ----------
    corners : (F, 3, 3) m of the facets
    panel : (F,) numbers
    thickness : (F,) m
    loaded : (F,) bool, facets that carry more than their own weight
    """
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(cross, axis=1)
    facet = np.arange(len(corners))
    sheet = SheetElements(corners, cross / size[:, None], size / 2, facet, panel, loaded)
    found: list[SurfaceLoad] = []
    for name, own in group_cases(cases).items():
        forces = [one for one in own if one.kind not in (TEMPERATURE, SETTLEMENT)]
        if len(own) == 1 and own[0].is_uniform and own[0].area in WORDED:
            found.append(own[0])
        elif forces:
            fixed, weight = place_on_sheet(sheet, 1, forces)
            mean = fixed[:, 0] if fixed.shape[1] == 1 else _average(fixed)
            loads = (mean + weight * thickness[:, None, None])[..., 0]
            found.append(SpreadLoad(name, PRESSURE, 1.0, (0.0, 0.0, -1.0), action=own[0].action,
                                    words=own[0].words, facet_loads=loads))  # fmt: skip
    return tuple(found)


def _average(fixed: np.ndarray) -> np.ndarray:
    return np.einsum("q,eqxc->exc", quadrature_table(1)[0], fixed)
