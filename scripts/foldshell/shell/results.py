"""Engineering results of an analysis: utilization, displacement, volume, reactions."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from foldshell.shell.analysis import AnalysisResult, ShellModel
from foldshell.shell.geometric import apply_geometric, geometric_operator
from foldshell.shell.material import CRITERIA, Material
from foldshell.shell.stress import (
    cell_values,
    internal_forces,
    stress_resultants,
    surface_stresses,
)


@dataclass(frozen=True)
class Utilization:
    """Utilization of the result cells (E, cells^2), per combination and their maximum.

    `cell` (E, cells^2) is the largest over surfaces and combinations, `combination` (c, E,
    cells^2) over surfaces only; `governing` (E, cells^2) numbers the combination.
    """

    cell: np.ndarray
    combination: np.ndarray
    governing: np.ndarray


def compute_utilization(
    model: ShellModel,
    displacement: np.ndarray,
    thickness: np.ndarray,
    material: Material,
) -> Utilization:
    """Evaluate the strength criterion at the top, middle and bottom of every cell.

    Parameters
    ----------
    displacement : (dofs, c) m and rad, of the strength combinations
    thickness : (E,) m
    """
    resultants = stress_resultants(
        model.operators, displacement, thickness, material.youngs_modulus
    )
    force = cell_values(model.operators, resultants.force)
    moment = cell_values(model.operators, resultants.moment)
    stress = surface_stresses(force, moment, thickness)
    value = CRITERIA[material.criterion](stress, material).max(axis=0)
    combination = np.moveaxis(value, -1, 0)
    return Utilization(combination.max(axis=0), combination, combination.argmax(axis=0))


def panel_area(model: ShellModel) -> np.ndarray:
    """Return the mesh area of each panel, (P,) m2."""
    return np.bincount(model.mesh.panel, model.operators.geometry.area)


def panel_utilization(model: ShellModel, cell: np.ndarray, measure: str) -> np.ndarray:
    """Return one utilization a panel: `panel_mean`, the area mean of its cells, or `element_max`."""
    panel = model.mesh.panel
    if measure == "element_max":
        largest = np.zeros(panel.max() + 1)
        np.maximum.at(largest, panel, cell.max(axis=1))
        return largest
    area = model.operators.geometry.area
    return np.bincount(panel, cell.mean(axis=1) * area) / panel_area(model)


def area_percentile(model: ShellModel, cell: np.ndarray, percent: float = 99.0) -> float:
    """Return the value that cells of the given share of the mesh area do not exceed."""
    weight = np.repeat(model.operators.geometry.area, cell.shape[1])
    value = cell.ravel()
    order = np.argsort(value)
    share = np.cumsum(weight[order])
    return float(value[order][np.searchsorted(share, percent / 100 * share[-1])])


def translations(model: ShellModel, displacement: np.ndarray) -> np.ndarray:
    """Return node displacements (N, 3, c) m of a field (dofs, c)."""
    count = len(model.mesh.nodes)
    return displacement[: 3 * count].reshape(count, 3, -1)


def largest_downward(
    model: ShellModel, displacement: np.ndarray, names: Sequence[str]
) -> tuple[float, int, str]:
    """Return the largest downward displacement (m), its node and its combination."""
    down = -translations(model, displacement)[:, 2]
    node, column = np.unravel_index(int(down.argmax()), down.shape)
    return float(down[node, column]), int(node), names[column]


def support_reactions(
    model: ShellModel, result: AnalysisResult, thickness: np.ndarray, material: Material
) -> np.ndarray:
    """Return the reactions (S, 3, c) kN of the supported nodes, from element resultants.

    They are summed anew from stresses, not taken from the solver, so their balance with the
    loads tests both.
    """
    resultants = stress_resultants(
        model.operators, result.displacement, thickness, material.youngs_modulus
    )
    internal = internal_forces(model.operators, resultants)
    if result.second_order is not None:
        geometric = geometric_operator(model.operators)
        internal = internal + apply_geometric(geometric, resultants.force, result.displacement)
    reaction = translations(model, internal - result.loads)
    return reaction[model.supported_nodes]


def reaction_imbalance(model: ShellModel, result: AnalysisResult, reactions: np.ndarray) -> float:
    """Return |sum of reactions + sum of loads| / |sum of loads|, the largest of all combinations."""
    load = translations(model, result.loads).sum(axis=0)
    gap = np.linalg.norm(reactions.sum(axis=0) + load, axis=0)
    scale = np.linalg.norm(load, axis=0)
    return float((gap / np.where(scale > 0, scale, 1.0)).max())
