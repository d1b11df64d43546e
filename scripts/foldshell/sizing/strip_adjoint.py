"""Gradient of the utilization of strips: that of the mean forces of one row of a panel."""

from dataclasses import replace

import numpy as np

from foldshell.checks.measures import StressState
from foldshell.checks.strength import CRITERIA
from foldshell.checks.strips import Strips, spread_to_coefficients, strip_means
from foldshell.settings.material import Material
from foldshell.sizing.adjoint import AdjointModel

BLOCK = 128
"""Adjoint right-hand sides solved at once."""

STRESS_STEP = 1.0
"""Step in kPa of the central difference of the strength criterion: exact to 1e-8 of it."""


def slope_of_criterion(stress: np.ndarray, material: Material) -> np.ndarray:
    """Return d(criterion)/d(stress) 1/kPa at stresses (..., 3) kPa, of the same shape."""
    criterion, steps = CRITERIA[material.criterion], STRESS_STEP * np.eye(3)
    difference = [criterion(stress + h, material) - criterion(stress - h, material) for h in steps]
    return np.stack(difference, axis=-1) / (2 * STRESS_STEP)


def gradient_of_strips(
    adjoint: AdjointModel, stress: StressState, panels: np.ndarray
) -> np.ndarray:
    """Return d(largest strip mean of a panel)/dt of every panel, (len(panels), P) 1/m.

    With the means n, m of the row that governs a panel: g = f(n / t + 6 s m / t^2), so that
    dg/dn = f' / t, dg/dm = 6 s f' / t^2, and 6 s m f' / t^3 is what t itself changes.

    panels (k,) are numbers.
    """
    mesh, count = adjoint.model.mesh, len(panels)
    row, combination = _find_governing(stress, panels)
    strips, pieces = take_rows(stress.strips, row)
    own = stress.thickness[stress.strips.element[stress.strips.first[row]]][:, None]
    force, bending, surface = _mean_stresses(stress, row, combination, own)
    slope = slope_of_criterion(force + bending, stress.material)
    gradient = np.zeros((count, int(mesh.panel.max()) + 1))
    gradient[np.arange(count), panels] = (slope * bending).sum(axis=1) / own[:, 0]
    pull = [slope / own, 6 * surface[:, None] * slope / own**2]
    parts = [spread_to_coefficients(strips, part[..., None], len(pieces))[..., 0] for part in pull]
    parts = _to_strains(adjoint, parts, stress.strips.element[pieces])
    belongs = np.repeat(np.arange(count), np.diff(np.append(strips.first, len(pieces))))
    for start in range(0, count, BLOCK):
        chosen = np.flatnonzero((belongs >= start) & (belongs < start + BLOCK))
        blocks, columns = [], combination[start : start + BLOCK]
        for part in parts:
            block = np.zeros((len(mesh.panel), *part.shape[1:], len(columns)))
            place = stress.strips.element[pieces[chosen]], belongs[chosen] - start
            block[place[0], :, :, place[1]] = part[chosen]
            blocks.append(block)
        change = adjoint.implicit(adjoint.solve(adjoint.push(*blocks)), columns)
        gradient[start : start + BLOCK] += adjoint.sum_panels(change)
    return gradient


def take_rows(strips: Strips, row: np.ndarray) -> tuple[Strips, np.ndarray]:
    """Return some rows (k,) of strips with each piece as an element of its own, and which pieces
    (Q,) those are. Numbers."""
    end = np.append(strips.first, len(strips.element))[row + 1]
    size = end - strips.first[row]
    first = np.cumsum(size) - size
    pieces = np.arange(size.sum()) + np.repeat(strips.first[row] - first, size)
    chosen = replace(
        strips,
        element=np.arange(len(pieces)),
        first=first,
        turn=strips.turn[pieces],
        weights=strips.weights[pieces],
    )
    return chosen, pieces


def _find_governing(stress: StressState, panels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return for each panel (k,) the row and the combination of its largest value."""
    largest = stress.strip_utilization.max(axis=1)
    order = np.lexsort((-largest, stress.strips.panel))
    row = order[np.searchsorted(stress.strips.panel[order], panels)]
    return row, stress.strip_utilization[row].argmax(axis=1)


def _mean_stresses(stress: StressState, row, combination, own: np.ndarray):
    """Return of each row membrane and bending stress (k, 3) kPa at its governing surface, and that
    surface, -1, 0 or 1."""
    n, m = (
        strip_means(stress.strips, part)[row, :, combination]
        for part in (stress.resultants.force, stress.resultants.moment)
    )
    membrane, bending = n / own, 6 * m / own**2
    sides = np.stack([membrane - bending, membrane, membrane + bending])
    surface = CRITERIA[stress.material.criterion](sides, stress.material).argmax(axis=0) - 1
    return membrane, surface[:, None] * bending, surface


def _to_strains(adjoint: AdjointModel, parts, element: np.ndarray):
    """Turn dg/dN and dg/dM into dg/d(eps) and dg/d(kappa): N = E t D eps, M = E t^3 / 12 D kappa.

    Coefficients (Q, 3, m) of elements (Q,).
    """
    modulus, t = adjoint.material.youngs_modulus, adjoint.thickness[element][:, None, None]
    force, moment = (
        np.einsum("ab,qbm->qam", modulus * adjoint.model.operators.elasticity, one) for one in parts
    )
    return [force * t, moment * t**3 / 12]
