"""What limits the thickness of panels, linearised about an analysed state.

Every constraint reads g <= 1: utilization of a panel over its limit, downward displacement of a
node over its limit, least buckling factor asked for over the one found. Derivatives follow from
one adjoint solve each, K a = dg/du, so that dg/dt = dg/dt|u + a^T (dF/dt - dK/dt u); the
displacements are those of second order, the tangent is that of first order.
Source: Haftka & Gurdal (1992) Elements of Structural Optimization, sections 7.2 and 7.4.
"""

import numpy as np

from foldshell.checks.utilization import Utilization, panel_utilization
from foldshell.settings.material import Material
from foldshell.settings.sizing import Sizing
from foldshell.shell.analysis import AnalysisResult, ShellModel
from foldshell.shell.results import panel_area, translations
from foldshell.sizing.adjoint import AdjointModel, open_adjoint
from foldshell.sizing.constraints import Constraints
from foldshell.sizing.stress_adjoint import utilization_gradient

ACTIVE = 0.7
"""Share of its limit from which a panel or a node takes part."""

FACTOR_ACTIVE = 3.0
"""Multiple of the least buckling factor up to which a combination takes part."""

NODES_MAX = 40
"""Nodes of each deflection combination, the largest downward one of as many panels."""


def linearise_constraints(
    model: ShellModel,
    result: AnalysisResult,
    thickness: np.ndarray,
    material: Material,
    factors: np.ndarray,
    utilization: Utilization,
    sizing: Sizing,
    span: float,
    factor_min: float,
) -> Constraints:
    """Return all constraints near their limit with their gradients.

    Parameters
    ----------
    thickness : (E,) m
    factors : (5, c) load-case factors of the combinations, strength first
    span : m, whose fraction is the displacement limit
    factor_min : buckling factor that every combination keeps
    """
    adjoint = open_adjoint(model, result, thickness, material, factors)
    strength = utilization.combination.shape[0]
    parts = [
        _utilization(adjoint, utilization, strength, sizing),
        _displacement(adjoint, strength, span / sizing.displacement_limit_span_over),
        _buckling(adjoint, factor_min),
    ]
    value, gradient = (np.concatenate(items) for items in zip(*parts, strict=True))
    sized = slice(0, model.sized_panels)
    return Constraints(value, gradient[:, sized], panel_area(model)[sized])


def _utilization(adjoint: AdjointModel, utilization: Utilization, strength: int, sizing: Sizing):
    measured = panel_utilization(adjoint.model, utilization.cell, sizing.measure)
    share = measured / sizing.utilization_max
    panels = np.flatnonzero(share > ACTIVE)
    gradient = utilization_gradient(adjoint, utilization, panels, strength, sizing.measure)
    return share[panels], gradient / sizing.utilization_max


def _displacement(adjoint: AdjointModel, strength: int, limit: float):
    """Take the lowest node of each panel in each deflection combination, once each."""
    mesh = adjoint.model.mesh
    down = -translations(adjoint.model, adjoint.result.displacement)[:, 2, strength:] / limit
    pairs = []
    for column in range(down.shape[1]):
        lowest = mesh.elements[np.arange(len(mesh.elements)), down[mesh.elements, column].argmax(1)]
        nodes = np.unique(lowest)
        nodes = nodes[np.argsort(-down[nodes, column], kind="stable")][:NODES_MAX]
        pairs += [(node, column) for node in nodes if down[node, column] > ACTIVE]
    pairs = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    right = np.zeros((mesh.dof_count, len(pairs)))
    right[3 * pairs[:, 0] + 2, np.arange(len(pairs))] = -1 / limit
    gradient = adjoint.implicit(adjoint.solve(right), strength + pairs[:, 1])
    return down[pairs[:, 0], pairs[:, 1]], adjoint.sum_panels(gradient)


def _buckling(adjoint: AdjointModel, factor_min: float):
    """g = factor_min / lambda for combinations whose factor lambda is low."""
    count = len(adjoint.model.mesh.panel)
    buckling = adjoint.result.buckling
    if buckling is None or factor_min <= 0:
        return np.empty(0), np.empty((0, int(adjoint.model.mesh.panel.max()) + 1))
    low = np.flatnonzero(buckling.factors < FACTOR_ACTIVE * factor_min)
    slope = np.array([adjoint.buckling_slope(column) for column in low]).reshape(-1, count)
    value = factor_min / buckling.factors[low]
    gradient = adjoint.sum_panels(slope.T)
    return value, -gradient * (value / buckling.factors[low])[:, None]
