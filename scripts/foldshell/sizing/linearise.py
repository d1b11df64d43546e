"""What limits the thickness of panels, linearised about an analysed state.

Every constraint reads g <= 1: utilization of a panel over its limit, downward displacement of a
node over its limit, least buckling factor asked for over the one found. Derivatives follow from
one adjoint solve each, K a = dg/du, so that dg/dt = dg/dt|u + a^T (dF/dt - dK/dt u); the
displacements are those of second order, the tangent is that of first order.
Source: Haftka & Gurdal (1992) Elements of Structural Optimization, sections 7.2 and 7.4.
"""

import numpy as np

from foldshell.checks.measures import MEASURES, StressState
from foldshell.settings.sizing import Sizing
from foldshell.shell.analysis import AnalysisResult, ShellModel
from foldshell.shell.results import panel_area, translations
from foldshell.sizing.adjoint import AdjointModel, open_adjoint
from foldshell.sizing.constraints import Constraints
from foldshell.sizing.stress_adjoint import utilization_gradient

FILTER = "filtered_dead_band"
"""The rule that asks for displacement and buckling alone, and for panels that bulge."""

ACTIVE = 0.7
"""Share of its limit from which a panel or a node takes part."""

FACTOR_ACTIVE = 3.0
"""Multiple of the least buckling factor up to which a combination takes part."""

BULGES = (0.02, 0.05)
"""What second order moves a panel against its own mean, over the displacement limit: above the
first a panel thins by one step where it may thin by two, above the second by none. Such a panel is
near a buckling mode of its own, which need not be the lowest one that the factor tells of. Of a
12 m arch in steel, panels at 4 % went to 13 % and to no answer within two steps more."""

NODES_MAX, NODES_OF_FILTER = 40, 8
"""Nodes of each deflection combination, the largest downward one of as many panels; fewer for the
rule `filtered_dead_band`."""


def linearise_constraints(
    result: AnalysisResult,
    stress: StressState,
    load_slope: np.ndarray,
    sizing: Sizing,
    span: float,
    factor_min: float,
) -> Constraints:
    """Return the constraints near their limit with their gradients, those that the rule asks for:
    `filtered_dead_band` leaves utilization to its band.

    Parameters
    ----------
    load_slope : (E, 3, c) kN/m3, change with thickness of the loads of the combinations, strength
        first
    span : m, whose fraction is the displacement limit
    factor_min : buckling factor that every combination keeps
    """
    model, strength = stress.model, stress.displacement.shape[1]
    limit, filters = span / sizing.displacement_limit_span_over, sizing.rule == FILTER
    down = -translations(model, result.displacement)[:, 2, strength:] / limit
    pairs = _find_low_nodes(model, down, NODES_OF_FILTER if filters else NODES_MAX)
    low = _find_low_factors(result, factor_min)
    share = MEASURES[sizing.measure].panels(stress) / sizing.utilization_max
    panels = np.flatnonzero((share > ACTIVE) & (not filters))
    area, sized = panel_area(model), slice(0, model.sized_panels)
    value, gradient = np.empty(0), np.empty((0, len(area)))
    if len(pairs) + len(low) + len(panels):
        adjoint = open_adjoint(model, result, stress.thickness, stress.material, load_slope)
        slope = utilization_gradient(adjoint, stress, panels, sizing.measure)
        parts = [
            (share[panels], slope / sizing.utilization_max),
            _displacement(adjoint, down, pairs, limit),
            _buckling(adjoint, low, factor_min),
        ]
        value, gradient = (np.concatenate(items) for items in zip(*parts, strict=True))
    thinning = None
    if filters:
        bulge = measure_bulges(model, result)[sized] / limit
        thinning = len(BULGES) - np.searchsorted(BULGES, bulge)
    return Constraints(value, gradient[:, sized], area[sized], thinning, panels, pairs, low)


def measure_bulges(model: ShellModel, result: AnalysisResult) -> np.ndarray:
    """Return the largest displacement that second order adds to a panel's own mean, (P,) m."""
    moved = translations(model, result.displacement - result.first_order)
    panel, own = model.mesh.panel, moved[model.mesh.elements]
    count = np.bincount(panel)
    mean = np.zeros((len(count), *moved.shape[1:]))
    np.add.at(mean, panel, own.mean(axis=1))
    mean /= count[:, None, None]
    largest = np.zeros(len(count))
    away = np.linalg.norm(own - mean[panel][:, None], axis=2)
    np.maximum.at(largest, panel, away.max(axis=(1, 2)))
    return largest


def _find_low_nodes(model: ShellModel, down: np.ndarray, most: int) -> np.ndarray:
    """Return (node, deflection combination) (k, 2): the lowest node of each panel, once each.

    down (N, c) is over the limit.
    """
    mesh, pairs = model.mesh, []
    for column in range(down.shape[1]):
        lowest = mesh.elements[np.arange(len(mesh.elements)), down[mesh.elements, column].argmax(1)]
        nodes = np.unique(lowest)
        nodes = nodes[np.argsort(-down[nodes, column], kind="stable")][:most]
        pairs += [(node, column) for node in nodes if down[node, column] > ACTIVE]
    return np.array(pairs, dtype=np.int64).reshape(-1, 2)


def _displacement(adjoint: AdjointModel, down: np.ndarray, pairs: np.ndarray, limit: float):
    strength = len(adjoint.result.names) - down.shape[1]
    right = np.zeros((adjoint.model.mesh.dof_count, len(pairs)))
    right[3 * pairs[:, 0] + 2, np.arange(len(pairs))] = -1 / limit
    gradient = adjoint.implicit(adjoint.solve(right), strength + pairs[:, 1])
    return down[pairs[:, 0], pairs[:, 1]], adjoint.sum_panels(gradient)


def _find_low_factors(result: AnalysisResult, factor_min: float) -> np.ndarray:
    """Return the combinations (k,) whose buckling factor is low."""
    if result.buckling is None or factor_min <= 0:
        return np.empty(0, dtype=np.int64)
    return np.flatnonzero(result.buckling.factors < FACTOR_ACTIVE * factor_min)


def _buckling(adjoint: AdjointModel, low: np.ndarray, factor_min: float):
    """g = factor_min / lambda of combinations low (k,)."""
    count = len(adjoint.model.mesh.panel)
    if not len(low):
        return np.empty(0), np.empty((0, int(adjoint.model.mesh.panel.max()) + 1))
    slope = np.array([adjoint.buckling_slope(column) for column in low]).reshape(-1, count)
    factors = adjoint.result.buckling.factors[low]
    value = factor_min / factors
    return value, -adjoint.sum_panels(slope.T) * (value / factors)[:, None]
