"""What load cases sum to on a design: resultants, moments, and loads of panels."""

from dataclasses import dataclass

import numpy as np

from foldshell.loads.cases import SurfaceLoad, group_cases
from foldshell.loads.words import describe_load, unit_of
from foldshell.shell.nodal_loads import mean_loads, sum_loads
from foldshell.shell.placed_loads import place_loads
from foldshell.shell.stiffness import ShellOperators


@dataclass(frozen=True)
class CaseSum:
    """A load case on a sheet.

    Attributes
    ----------
    name, words : of the case; the words of all its loads
    force : (3,) kN, its resultant
    moment : (3,) kNm, about the origin
    panel_force : (P, 3) kN, of each panel
    strains : whether it heats or moves supports, in place of loading the sheet or beside it
    """

    name: str
    words: str
    force: np.ndarray
    moment: np.ndarray
    panel_force: np.ndarray
    strains: bool


def sum_load_cases(
    operators: ShellOperators,
    loads: tuple[SurfaceLoad, ...],
    thickness: np.ndarray,
    self_weight_only: np.ndarray,
) -> list[CaseSum]:
    """Return the sums of each case on a mesh, in the order of the cases.

    Parameters
    ----------
    operators : of the mesh
    loads : of `make_load_cases`
    thickness : (E,) m
    self_weight_only : (E,) bool, elements that carry nothing but their own weight
    """
    placed = place_loads(operators, self_weight_only, loads)
    surface = placed.at(thickness)
    force, moment = sum_loads(operators, surface)
    each = mean_loads(operators, surface) * operators.geometry.area[:, None, None]
    panel, groups = operators.mesh.panel, group_cases(loads)
    found = []
    for k, name in enumerate(placed.names):
        own = np.stack([np.bincount(panel, each[:, x, k]) for x in range(3)], axis=1)
        words = "; ".join(f"{one.value:.4g} {unit_of(one)}, {describe_load(one).partition(': ')[2]}"
                          for one in groups[name])  # fmt: skip
        strains = any(one.kind in ("temperature", "settlement") for one in groups[name])
        found.append(CaseSum(name, words, force[:, k], moment[:, k], own, strains))
    return found
