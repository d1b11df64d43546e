"""Forces, moments, shear and utilization of every combination on the result cells of a design."""

from dataclasses import dataclass

import numpy as np

from foldshell.checks.utilization import utilization_of_combinations
from foldshell.results.fields import facet_axes, rotate_forces
from foldshell.results.state import DesignState
from foldshell.settings.material import Material
from foldshell.shell.element import ElementGeometry
from foldshell.shell.reference import lagrange_basis, lattice_points, orthonormal_basis
from foldshell.shell.stiffness import ShellOperators, build_operators
from foldshell.shell.stress import cell_points, stress_resultants


@dataclass(frozen=True)
class CombinationFields:
    """Fields of c combinations at the centroids of C result cells, in the facets' axes.

    `axes` (C, 3, 3) are rows x, y, normal; `force` (c, C, 3) nx, ny, nxy kN/m, `moment` (c, C, 3)
    mx, my, mxy kNm/m, `shear` (c, C, 2) vx, vy kN/m; `utilization` (s, C) of the s strength
    combinations is the mean over a cell of the largest over top, middle and bottom surface.
    """

    axes: np.ndarray
    force: np.ndarray
    moment: np.ndarray
    shear: np.ndarray
    utilization: np.ndarray


def evaluate_combinations(
    state: DesignState, material: Material, operators: ShellOperators | None = None
) -> CombinationFields:
    """N = t E D eps, M = t^3/12 E D kappa, V = div M at the centroid of every cell.

    A moment is positive where the lower side (against the normal) is in tension. `operators` of
    the state's mesh are built where they are not given.
    """
    mesh = state.mesh
    operators = operators or build_operators(mesh, material.poissons_ratio)
    geometry, thickness = operators.geometry, state.panel_thickness[mesh.panel]
    moved = state.final.displacement
    imposed, count = state.final.imposed_strain, len(state.strength)
    found = stress_resultants(operators, moved, thickness, material.youngs_modulus, imposed)
    strength = None if imposed is None else imposed[..., :count]
    values = utilization_of_combinations(operators, moved[:, :count], thickness, material, strength)
    utilization = values.mean(axis=3).reshape(len(state.strength), -1)
    points = cell_points(mesh.cells)
    psi = orthonormal_basis(mesh.order - 1, points)
    force, moment = (
        np.einsum("qm,ecmk->keqc", psi, values, optimize=True)
        for values in (found.force, found.moment)
    )
    axes = facet_axes(geometry.frame[:, 2])
    return CombinationFields(
        np.repeat(axes, len(points), axis=0),
        _turn(force, geometry.frame, axes),
        _turn(moment, geometry.frame, axes),
        _shear(found.moment, mesh.order, points, geometry, axes),
        utilization,
    )


def _shear(
    moment: np.ndarray, order: int, points: np.ndarray, geometry: ElementGeometry, axes: np.ndarray
) -> np.ndarray:
    """vx = mxx,x + mxy,y, vy = mxy,x + myy,y from coefficients (E, 3, m, c): (c, E q, 2)."""
    slope = basis_gradient(order - 1, points)
    local = np.einsum("rqm,era->eaqm", slope, geometry.inverse)
    mx, my, mxy = np.moveaxis(moment, 1, 0)
    along = np.stack([local[:, 0] @ mx + local[:, 1] @ mxy, local[:, 0] @ mxy + local[:, 1] @ my])
    turn = np.einsum("eax,ebx->eab", axes[:, :2], geometry.frame[:, :2])
    shear = np.einsum("eab,beqk->keqa", turn, along, optimize=True)
    return shear.reshape(len(shear), -1, 2)


def basis_gradient(degree: int, points: np.ndarray) -> np.ndarray:
    """Return d/dr and d/ds of the orthonormal basis of a degree at points (q, 2): (2, q, m)."""
    if degree == 0:
        return np.zeros((2, len(points), 1))
    slopes = lagrange_basis(degree, points)[1]
    return slopes @ orthonormal_basis(degree, lattice_points(degree))


def _turn(values: np.ndarray, frame: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """Return tensors (c, E, q, 3) turned to facet axes, as (c, E q, 3)."""
    return np.stack([rotate_forces(one, frame, axes).reshape(-1, 3) for one in values])
