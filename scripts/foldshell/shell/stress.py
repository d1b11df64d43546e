"""Membrane forces, moments, stresses and reactions of a displacement field.

Arrays of resultants are (E, 3, m, c): components xx, yy, xy in the element's frame, coefficients
of the orthonormal basis, load columns. Forces in kN/m, moments in kNm/m, stresses in kPa.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from foldshell.shell.nodal import gather_forces
from foldshell.shell.reference import orthonormal_basis, reference_triangle
from foldshell.shell.stiffness import ShellOperators

SAMPLES = 12
"""Points along an element edge at which utilization is sampled."""


@dataclass(frozen=True)
class StressResultants:
    """Membrane forces and moments (E, 3, m, c); `jump` (E, 3p, c) moments of the edge springs."""

    force: np.ndarray
    moment: np.ndarray
    jump: np.ndarray

    def column(self, number: int) -> "StressResultants":
        """Return those of one load column."""
        return self.columns(slice(number, number + 1))

    def columns(self, part: slice) -> "StressResultants":
        """Return those of some load columns."""
        return StressResultants(self.force[..., part], self.moment[..., part], self.jump[..., part])

    def elements(self, part: slice) -> "StressResultants":
        """Return those of some elements."""
        return StressResultants(self.force[part], self.moment[part], self.jump[part])


def stress_resultants(
    operators: ShellOperators,
    displacement: np.ndarray,
    thickness: np.ndarray,
    youngs_modulus: float,
    imposed: np.ndarray | None = None,
) -> StressResultants:
    """N = t E D (eps(u) - eps_0), M = t^3/12 E D (kappa(u) - kappa_0), with kappa = +grad grad w.

    Parameters
    ----------
    displacement : (dofs, c) m and rad
    thickness : (E,) m
    imposed : (E, 2, c) strain eps_0 (-) and curvature kappa_0 (1/m), alike in all directions
    """
    force = membrane_forces(operators, displacement, thickness, youngs_modulus)
    local = _deflections_and_rotations(operators, displacement)
    stiffness = (youngs_modulus * thickness**3)[:, None, None]
    curvature = stiffness / 12 * np.matmul(operators.curvature, local)
    moment = _apply_elasticity(operators, curvature)
    spring = stiffness * operators.slope_spring[:, :, None]
    found = StressResultants(force, moment, spring * np.matmul(operators.slope_jump, local))
    if imposed is None:
        return found
    free = imposed_resultants(operators, imposed, thickness, youngs_modulus)
    return StressResultants(force - free.force, moment - free.moment, found.jump)


def imposed_resultants(
    operators: ShellOperators, imposed: np.ndarray, thickness: np.ndarray, youngs_modulus: float
) -> StressResultants:
    """N_0 = t E D eps_0, M_0 = t^3/12 E D kappa_0 of imposed strains (E, 2, c), - and 1/m.

    thickness (E,) m.
    """
    count, functions = len(thickness), operators.curvature.shape[1] // 3
    scale = np.stack([thickness * youngs_modulus, thickness**3 * youngs_modulus / 12], axis=1)
    size = operators.elasticity[:2, :2].sum(axis=1)[0] * scale[:, :, None] * imposed
    parts = np.zeros((2, count, 3, functions, imposed.shape[2]))
    parts[:, :, :2, 0] = np.moveaxis(size, 1, 0)[:, :, None]
    jump = np.zeros((*operators.slope_spring.shape, imposed.shape[2]))
    return StressResultants(parts[0], parts[1], jump)


def membrane_forces(
    operators: ShellOperators,
    displacement: np.ndarray,
    thickness: np.ndarray,
    youngs_modulus: float,
) -> np.ndarray:
    """N = t E D eps(u), (E, 3, m, c) kN/m; linear in the displacements (dofs, c)."""
    mesh = operators.mesh
    table = reference_triangle(mesh.order).gradient
    functions, columns = table.shape[1], displacement.shape[1]
    moved = displacement[: 3 * len(mesh.nodes)].reshape(len(mesh.nodes), -1)
    local = moved[mesh.elements]
    slope = np.matmul(table.reshape(2 * functions, -1), local)
    slope = slope.reshape(len(local), 2, functions, 3, columns).transpose(0, 1, 3, 2, 4)
    stiffness = (youngs_modulus * thickness)[:, None, None] * operators.elasticity
    axes = np.matmul(stiffness, operators.strain_axes.reshape(-1, 3, 6))
    force = np.matmul(axes, slope.reshape(len(local), 6, -1))
    return force.reshape(-1, 3, functions, columns)


def internal_forces(operators: ShellOperators, resultants: StressResultants) -> np.ndarray:
    """Return K u (dofs, c) from the resultants: int B^T N + kappa^T M, element by element."""
    mesh, area = operators.mesh, operators.geometry.area[:, None, None]
    count, _, functions, columns = resultants.force.shape
    table = reference_triangle(mesh.order).gradient
    axes = operators.strain_axes.reshape(count, 3, 6).transpose(0, 2, 1)
    flow = np.matmul(axes, area * resultants.force.reshape(count, 3, -1))
    flow = flow.reshape(count, 2, 3, functions, columns).transpose(0, 1, 3, 2, 4)
    push = np.matmul(table.reshape(2 * functions, -1).T, flow.reshape(count, 2 * functions, -1))
    moment = area * resultants.moment.reshape(count, -1, columns)
    local = np.matmul(operators.curvature.transpose(0, 2, 1), moment)
    local += np.matmul(operators.slope_jump.transpose(0, 2, 1), resultants.jump)
    nodes = mesh.elements.shape[1]
    normal = operators.geometry.frame[:, None, 2, :, None]
    push = push.reshape(count, nodes, 3, columns) + local[:, :nodes, None] * normal
    turning = local[:, nodes:].reshape(-1, columns)
    numbers = operators.dofs[:, 3 * nodes :].ravel()
    total = gather_forces(mesh, push)
    for column in range(columns):
        total[:, column] += np.bincount(numbers, turning[:, column], mesh.dof_count)
    return total


def _deflections_and_rotations(operators: ShellOperators, displacement: np.ndarray) -> np.ndarray:
    """Return the freedoms (E, n + 3p, c) on which curvature and slope jumps depend."""
    mesh = operators.mesh
    nodes = mesh.elements.shape[1]
    moved = displacement[: 3 * len(mesh.nodes)].reshape(len(mesh.nodes), 3, -1)[mesh.elements]
    deflection = np.einsum("enxc,ex->enc", moved, operators.geometry.frame[:, 2])
    return np.concatenate([deflection, displacement[operators.dofs[:, 3 * nodes :]]], axis=1)


def cell_points(cells: int) -> np.ndarray:
    """Return the centroids (cells^2, 2) of the equal triangles an element is divided into.

    Reference coordinates, without unit.
    """
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

    Reference coordinates, without unit.
    """
    centroids = cell_points(cells)
    inner = cell_points(-(-SAMPLES // cells)) - 1 / 3
    upward = np.arange(cells**2) < cells * (cells + 1) // 2
    sign = np.where(upward, 1.0, -1.0)[:, None, None]
    return centroids[:, None] + sign * inner / cells


@lru_cache(maxsize=8)
def sample_basis(order: int, cells: int) -> np.ndarray:
    """Return the orthonormal functions (cells^2 s^2, m) at the sample points of an element.

    Without unit.
    """
    return orthonormal_basis(order - 1, sample_points(cells).reshape(-1, 2))


def evaluate(operators: ShellOperators, coefficients: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Evaluate (E, 3, m, c) at reference points (q, 2): (E, q, c, 3)."""
    psi = orthonormal_basis(operators.mesh.order - 1, points)
    return np.einsum("qm,ecmk->eqkc", psi, coefficients, optimize=True)


def surface_stresses(force: np.ndarray, moment: np.ndarray, thickness: np.ndarray) -> np.ndarray:
    """sigma = N/t - 12 M z / t^3 at the top, middle and bottom: (3, E, cells^2, c, 3) kPa."""
    t = thickness[:, None, None, None]
    membrane, bending = force / t, 6 * moment / t**2
    return np.stack([membrane - bending, membrane, membrane + bending])


def outer_stresses(
    resultants: StressResultants, thickness: np.ndarray, basis: np.ndarray
) -> np.ndarray:
    """Return N/t -+ 6M/t^2 where the functions are `basis` (q, m): (2, 3, c, E, q) kPa.

    Of the top and the bottom; thickness (E,) m. A convex function of stress is nowhere larger at
    the middle surface, the mean of these two.
    """
    t = thickness[:, None, None, None]
    membrane, bending = resultants.force / t, 6 * resultants.moment / t**2
    both = np.stack([membrane - bending, membrane + bending]).transpose(0, 2, 4, 1, 3)
    return both @ basis.T


def _apply_elasticity(operators: ShellOperators, strain: np.ndarray) -> np.ndarray:
    """Multiply by D (for unit E): (E, 3m, c) to (E, 3, m, c)."""
    count, rows, columns = strain.shape
    blocks = strain.reshape(count, 3, rows // 3 * columns)
    return np.matmul(operators.elasticity, blocks).reshape(count, 3, rows // 3, columns)
