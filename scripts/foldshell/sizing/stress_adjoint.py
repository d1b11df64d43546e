"""Gradient of the utilization of panels, by one adjoint per panel and governing combination."""

import numpy as np

from foldshell.checks.measures import StressState
from foldshell.checks.strength import CRITERIA
from foldshell.checks.utilization import Utilization
from foldshell.shell.results import panel_area
from foldshell.shell.stress import sample_basis, surface_stresses
from foldshell.sizing.adjoint import AdjointModel
from foldshell.sizing.strip_adjoint import BLOCK, gradient_of_strips, slope_of_criterion


def utilization_gradient(
    adjoint: AdjointModel, stress: StressState, panels: np.ndarray, measure: str
) -> np.ndarray:
    """Return d(utilization of a panel)/dt of every panel, (len(panels), P) 1/m.

    The combination and the surface that govern at a point are held, as is the cell of the largest
    value for `element_max` and the row of the largest mean for `strip`: the gradient of a maximum
    where it has one.

    panels (k,) are numbers.
    """
    if measure == "strip" and len(panels):
        return gradient_of_strips(adjoint, stress, panels)
    mesh = adjoint.model.mesh
    gradient = np.zeros((len(panels), int(mesh.panel.max()) + 1))
    if not len(panels):
        return gradient
    utilization, strength = stress.utilization, stress.displacement.shape[1]
    elements = np.flatnonzero(np.isin(mesh.panel, panels))
    row = np.searchsorted(panels, mesh.panel[elements])
    weight = _weights(adjoint, utilization, elements, measure)
    slope, bending, column, surface = _stress_slopes(adjoint, elements, strength)
    slope *= weight[..., None]
    t = adjoint.thickness[elements]
    explicit = (slope * bending).sum((1, 2)) / t
    np.add.at(gradient, (row, mesh.panel[elements]), explicit)
    used = column[..., None] == np.arange(strength)
    force, moment = _strain_slopes(adjoint, elements, slope, surface, used)
    governing = (used & (weight > 0)[..., None]).any(axis=1)
    element, combination = np.nonzero(governing)
    pairs = np.unique(row[element] * strength + combination)
    for start in range(0, len(pairs), BLOCK):
        panel, combination = np.divmod(pairs[start : start + BLOCK], strength)
        item, place = np.nonzero(row[None] == panel[:, None])
        parts = []
        for part in (force, moment):
            block = np.zeros((len(mesh.panel), *part.shape[1:3], len(panel)))
            block[elements[place], :, :, item] = part[place, :, :, combination[item]]
            parts.append(block)
        change = adjoint.implicit(adjoint.solve(adjoint.push(*parts)), combination)
        np.add.at(gradient, panel, adjoint.sum_panels(change))
    return gradient


def _weights(adjoint, utilization: Utilization, elements, measure: str) -> np.ndarray:
    """Return the weight (E', points) of each sample point in the measure of its panel."""
    panel = adjoint.model.mesh.panel
    cell = utilization.cell[elements]
    points = utilization.point.shape[2]
    if measure == "panel_mean":
        area = adjoint.model.operators.geometry.area / panel_area(adjoint.model)[panel]
        share = np.broadcast_to(area[elements, None] / cell.shape[1], cell.shape)
    else:
        largest = np.zeros(panel.max() + 1)
        np.maximum.at(largest, panel, utilization.cell.max(axis=1))
        share = (cell == largest[panel[elements], None]).astype(float)
    return np.repeat(share / points, points, axis=1)


def _stress_slopes(adjoint, elements: np.ndarray, strength: int):
    """Return at the governing combination and surface of each sample point, (E', points, ...):
    d(criterion)/d(stress) 1/kPa, the bending stress kPa, the combination, the surface -1, 0, 1."""
    mesh, material = adjoint.model.mesh, adjoint.material
    psi = sample_basis(mesh.order, mesh.cells)
    own = adjoint.thickness[elements]
    force, moment = (
        np.einsum("qm,ecmk->eqkc", psi, part[elements][..., :strength], optimize=True)
        for part in (adjoint.resultants.force, adjoint.resultants.moment)
    )
    criterion = CRITERIA[material.criterion]
    stress = surface_stresses(force, moment, own)
    value = np.moveaxis(criterion(stress, material), 0, -1)
    governing = value.reshape(*value.shape[:2], -1).argmax(axis=2)
    column, surface = np.divmod(governing, 3)
    element, point = np.indices(governing.shape)
    chosen = stress[surface, element, point, column]
    bending = chosen - force[element, point, column] / own[:, None, None]
    return slope_of_criterion(chosen, material), bending, column, surface - 1


def _strain_slopes(adjoint, elements, slope, surface, used):
    """Return dg/d(eps) and dg/d(kappa) of elements by combination, (E', 3, m, c) each, for
    weighted stress slopes: sigma = N / t + 6 s M / t^2, N = E t D eps, M = E t^3 / 12 D kappa."""
    mesh, operators = adjoint.model.mesh, adjoint.model.operators
    psi = sample_basis(mesh.order, mesh.cells)
    strain = adjoint.material.youngs_modulus * slope @ operators.elasticity
    bent = strain * (surface * adjoint.thickness[elements][:, None] / 2)[..., None]
    return tuple(
        np.stack([(density * mask[..., None]).transpose(0, 2, 1) @ psi for mask in masks], axis=3)
        for density, masks in ((strain, np.moveaxis(used, 2, 0)), (bent, np.moveaxis(used, 2, 0)))
    )
