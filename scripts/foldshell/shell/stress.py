"""Membrane forces, moments, stresses and reactions of a displacement field.

Arrays of resultants are (E, 3, m, c): components xx, yy, xy in the element's frame, coefficients
of the orthonormal basis, load columns. Forces in kN/m, moments in kNm/m, stresses in kPa.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.shell.reference import orthonormal_basis
from foldshell.shell.stiffness import ShellOperators

SAMPLES = 12
"""Points along an element edge at which utilization is sampled."""


@dataclass(frozen=True)
class StressResultants:
    """Membrane forces and moments (E, 3, m, c); `jump` (E, 3p, c) moments of the edge springs."""

    force: np.ndarray
    moment: np.ndarray
    jump: np.ndarray


def stress_resultants(
    operators: ShellOperators,
    displacement: np.ndarray,
    thickness: np.ndarray,
    youngs_modulus: float,
) -> StressResultants:
    """N = t E D eps(u), M = t^3/12 E D kappa(u), with kappa = +grad grad w.

    Parameters
    ----------
    displacement : (dofs, c) m and rad
    thickness : (E,) m
    """
    local = displacement[operators.dofs]
    force = membrane_forces(operators, displacement, thickness, youngs_modulus)
    stiffness = (youngs_modulus * thickness**3)[:, None, None]
    curvature = stiffness / 12 * np.matmul(operators.curvature, local)
    moment = _apply_elasticity(operators, curvature)
    spring = stiffness * operators.slope_spring[:, :, None]
    return StressResultants(force, moment, spring * np.matmul(operators.slope_jump, local))


def membrane_forces(
    operators: ShellOperators,
    displacement: np.ndarray,
    thickness: np.ndarray,
    youngs_modulus: float,
) -> np.ndarray:
    """N = t E D eps(u), (E, 3, m, c) kN/m; linear in the displacements (dofs, c)."""
    width = operators.membrane_strain.shape[2]
    local = displacement[operators.dofs[:, :width]]
    strain = np.matmul(operators.membrane_strain, local)
    strain *= (youngs_modulus * thickness)[:, None, None]
    return _apply_elasticity(operators, strain)


def internal_forces(operators: ShellOperators, resultants: StressResultants) -> np.ndarray:
    """Return K u (dofs, c) from the resultants: int B^T N + kappa^T M, element by element."""
    area = operators.geometry.area[:, None, None]
    count, _, _, columns = resultants.force.shape
    flat = (count, -1, columns)
    moment = area * resultants.moment.reshape(flat)
    element = np.matmul(operators.curvature.transpose(0, 2, 1), moment)
    element += np.matmul(operators.slope_jump.transpose(0, 2, 1), resultants.jump)
    force = area * resultants.force.reshape(flat)
    width = operators.membrane_strain.shape[2]
    element[:, :width] += np.matmul(operators.membrane_strain.transpose(0, 2, 1), force)
    return scatter(operators, element)


def scatter(operators: ShellOperators, element: np.ndarray) -> np.ndarray:
    """Sum element vectors (E, d, c) into global ones (dofs, c); d may be the displacements only."""
    numbers = operators.dofs[:, : element.shape[1]].ravel()
    flat = element.reshape(-1, element.shape[2])
    total = [np.bincount(numbers, column, operators.mesh.dof_count) for column in flat.T]
    return np.array(total).T


def cell_points(cells: int) -> np.ndarray:
    """Return the centroids (cells^2, 2) of the equal triangles an element is divided into."""
    upward = [(r, s) for s in range(cells) for r in range(cells - s)]
    downward = [(r, s) for s in range(cells - 1) for r in range(cells - 1 - s)]
    first = (np.array(upward) + 1 / 3) / cells
    second = (np.array(downward).reshape(-1, 2) + 2 / 3) / cells
    return np.concatenate([first, second])


def sample_points(cells: int) -> np.ndarray:
    """Return points (cells^2, s^2, 2) that sample every result cell evenly.

    An element has `SAMPLES` points along an edge, or as many as it has cells if those are more.
    Stresses peak at folds and fold vertices: a mean or a percentile over fewer points would
    depend on where they lie.
    """
    centroids = cell_points(cells)
    inner = cell_points(-(-SAMPLES // cells)) - 1 / 3
    upward = np.arange(cells**2) < cells * (cells + 1) // 2
    sign = np.where(upward, 1.0, -1.0)[:, None, None]
    return centroids[:, None] + sign * inner / cells


def evaluate(operators: ShellOperators, coefficients: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Evaluate (E, 3, m, c) at reference points (q, 2): (E, q, c, 3)."""
    psi = orthonormal_basis(operators.mesh.order - 1, points)
    return np.einsum("qm,ecmk->eqkc", psi, coefficients, optimize=True)


def cell_values(operators: ShellOperators, coefficients: np.ndarray) -> np.ndarray:
    """Evaluate (E, 3, m, c) at the centroids of the result cells: (E, cells^2, c, 3)."""
    return evaluate(operators, coefficients, cell_points(operators.mesh.cells))


def surface_stresses(force: np.ndarray, moment: np.ndarray, thickness: np.ndarray) -> np.ndarray:
    """sigma = N/t - 12 M z / t^3 at the top, middle and bottom: (3, E, cells^2, c, 3) kPa."""
    t = thickness[:, None, None, None]
    membrane, bending = force / t, 6 * moment / t**2
    return np.stack([membrane - bending, membrane, membrane + bending])


def _apply_elasticity(operators: ShellOperators, strain: np.ndarray) -> np.ndarray:
    """Multiply by D (for unit E): (E, 3m, c) to (E, 3, m, c)."""
    count, rows, columns = strain.shape
    blocks = strain.reshape(count, 3, rows // 3 * columns)
    return np.matmul(operators.elasticity, blocks).reshape(count, 3, rows // 3, columns)
