"""Engineering results of an analysis: utilization, displacement, volume, reactions."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from foldshell.shell.analysis import AnalysisResult, ShellModel
from foldshell.shell.geometric import apply_geometric
from foldshell.shell.material import CRITERIA, Material
from foldshell.shell.stress import (
    evaluate,
    internal_forces,
    sample_points,
    stress_resultants,
    surface_stresses,
)


@dataclass(frozen=True)
class Utilization:
    """Utilization, the largest over top, middle and bottom surface at each point.

    `point` (E, cells^2, s^2) is the largest over combinations at sample points, `combination`
    (c, E, cells^2, s^2) that of each; `cell` (E, cells^2) the mean of `point` over a result cell;
    `governing` (E, cells^2) the combination with the largest mean there.
    """

    point: np.ndarray
    combination: np.ndarray
    cell: np.ndarray
    governing: np.ndarray


def compute_utilization(
    model: ShellModel,
    displacement: np.ndarray,
    thickness: np.ndarray,
    material: Material,
) -> Utilization:
    """Evaluate the strength criterion at the sample points of every result cell.

    Parameters
    ----------
    displacement : (dofs, c) m and rad, of the strength combinations
    thickness : (E,) m
    """
    operators = model.operators
    resultants = stress_resultants(operators, displacement, thickness, material.youngs_modulus)
    points = sample_points(model.mesh.cells)
    flat = points.reshape(-1, 2)
    criterion = CRITERIA[material.criterion]
    combination = np.empty((displacement.shape[1], len(thickness), *points.shape[:2]))
    for column in range(displacement.shape[1]):
        own = slice(column, column + 1)
        force = evaluate(operators, resultants.force[..., own], flat)
        moment = evaluate(operators, resultants.moment[..., own], flat)
        value = criterion(surface_stresses(force, moment, thickness), material).max(axis=0)
        combination[column] = value[..., 0].reshape(combination.shape[1:])
    point = combination.max(axis=0)
    governing = combination.mean(axis=3).argmax(axis=0)
    return Utilization(point, combination, point.mean(axis=2), governing)


def panel_area(model: ShellModel) -> np.ndarray:
    """Return the mesh area of each panel, (P,) m2."""
    return np.bincount(model.mesh.panel, model.operators.geometry.area)


def panels_beside_strips(model: ShellModel) -> np.ndarray:
    """Return the sized panel (B,) from whose border each strip of an edge beam hangs."""
    mesh, bare = model.mesh, model.bare
    owner = np.full(mesh.edge_count, -1)
    owner[mesh.element_edges[~bare]] = mesh.panel[~bare][:, None]
    found = owner[mesh.element_edges[bare]].max(axis=1)
    beside = np.full(len(model.fixed_thickness), -1)
    np.maximum.at(beside, mesh.panel[bare] - model.sized_panels, found)
    return beside


def panel_utilization(model: ShellModel, cell: np.ndarray, measure: str) -> np.ndarray:
    """Return (P,): `panel_mean`, the area mean over the cells of a panel, or `element_max`."""
    panel = model.mesh.panel
    if measure == "element_max":
        largest = np.zeros(panel.max() + 1)
        np.maximum.at(largest, panel, cell.max(axis=1))
        return largest
    area = model.operators.geometry.area
    return np.bincount(panel, cell.mean(axis=1) * area) / panel_area(model)


def area_percentile(model: ShellModel, point: np.ndarray, percent: float = 99.0) -> float:
    """Return the value that a share of the mesh area does not exceed.

    `point` (E, ...) holds equally weighted values of each element, or of the first ones only.
    """
    value = point.ravel()
    area = model.operators.geometry.area[: len(point)]
    weight = np.repeat(area, value.size // len(point))
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
        shape = result.displacement
        if result.initial is not None:
            shape = shape + result.initial[:, None]
        push = apply_geometric(model.operators, resultants.force, shape)
        internal = internal + push
    reaction = translations(model, internal - result.loads)
    return reaction[model.supported_nodes]


def reaction_imbalance(model: ShellModel, result: AnalysisResult, reactions: np.ndarray) -> float:
    """Return |sum of reactions + loads| / |sum of loads|, the largest of all combinations."""
    load = translations(model, result.loads).sum(axis=0)
    gap = np.linalg.norm(reactions.sum(axis=0) + load, axis=0)
    scale = np.linalg.norm(load, axis=0)
    return float((gap / np.where(scale > 0, scale, 1.0)).max())
