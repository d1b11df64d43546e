"""Engineering results of an analysis: areas, displacement, reactions."""

from collections.abc import Sequence

import numpy as np

from foldshell.settings.material import Material
from foldshell.shell.analysis import AnalysisResult, ShellModel
from foldshell.shell.geometric import apply_geometric
from foldshell.shell.stiffness import ShellOperators
from foldshell.shell.stress import internal_forces, stress_resultants


def panel_area(model: ShellModel) -> np.ndarray:
    """Return the mesh area of each panel, (P,) m2."""
    return np.bincount(model.mesh.panel, model.operators.geometry.area)


def panel_centroids(operators: ShellOperators) -> tuple[np.ndarray, np.ndarray]:
    """Return the centroid (P, 3) m of each panel, and the unit mean of its normals (P, 3)."""
    panel, area = operators.mesh.panel, operators.geometry.area
    corners = operators.mesh.nodes[operators.mesh.corners].mean(axis=1)
    fields = np.concatenate([corners, operators.geometry.frame[:, 2]], axis=1) * area[:, None]
    sums = np.stack([np.bincount(panel, column) for column in fields.T], axis=1)
    normal = sums[:, 3:] / np.linalg.norm(sums[:, 3:], axis=1)[:, None]
    return sums[:, :3] / np.bincount(panel, area)[:, None], normal


def panels_beside_edge_beam(model: ShellModel) -> np.ndarray:
    """Return the sized panel (B,) from whose border each panel of an edge beam hangs.

    As numbers.
    """
    mesh, self_weight_only = model.mesh, model.self_weight_only
    owner = np.full(mesh.edge_count, -1)
    owner[mesh.element_edges[~self_weight_only]] = mesh.panel[~self_weight_only][:, None]
    found = owner[mesh.element_edges[self_weight_only]].max(axis=1)
    beside = np.full(len(model.fixed_thickness), -1)
    np.maximum.at(beside, mesh.panel[self_weight_only] - model.sized_panels, found)
    return beside


def translations(model: ShellModel, displacement: np.ndarray) -> np.ndarray:
    """Return node displacements (N, 3, c) m of a field (dofs, c)."""
    count = len(model.mesh.nodes)
    return displacement[: 3 * count].reshape(count, 3, -1)


def largest_downward(
    model: ShellModel, displacement: np.ndarray, names: Sequence[str]
) -> tuple[float, int, str]:
    """Return the largest downward displacement (m), its node and its combination.

    displacement (dofs, c) m and rad.
    """
    down = -translations(model, displacement)[:, 2]
    node, column = np.unravel_index(int(down.argmax()), down.shape)
    return float(down[node, column]), int(node), names[column]


def support_reactions(
    model: ShellModel, result: AnalysisResult, thickness: np.ndarray, material: Material
) -> np.ndarray:
    """Return the reactions (S, 3, c) kN of the supported nodes, from element resultants.

    They are summed anew from stresses in the elements there, not taken from the solver, so their
    balance with the loads tests both. What an elastic support exerts, -k u, is part of it; along
    directions in which no support acts there is none.
    """
    chosen, operators = model.beside_supports
    moved, own = result.displacement, thickness[chosen]
    imposed = None if result.imposed is None else result.imposed[chosen]
    resultants = stress_resultants(operators, moved, own, material.youngs_modulus, imposed)
    internal = internal_forces(operators, resultants)
    if result.second_order is not None:
        if result.imperfection is not None:
            moved = moved + result.imperfection[:, None]
        internal = internal + apply_geometric(operators, resultants.force, moved)
    reaction = translations(model, internal - result.loads)[model.supported_nodes]
    if model.acting is None:
        return reaction
    return np.where(model.acting[:, :, None], reaction, 0.0)


def reaction_imbalance(model: ShellModel, result: AnalysisResult, reactions: np.ndarray) -> float:
    """Return |sum of reactions + loads| / |sum of loads|, the largest of all combinations.

    reactions (S, 3, c) kN.
    """
    load = translations(model, result.loads).sum(axis=0)
    gap = np.linalg.norm(reactions.sum(axis=0) + load, axis=0)
    scale = np.linalg.norm(load, axis=0)
    return float((gap / np.where(scale > 0, scale, 1.0)).max())
