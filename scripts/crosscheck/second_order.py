"""Second order and buckling with one factor of the first-order stiffness.

Second order (Th.II): (K + Kg(N(u))) u = F, small displacements, N the membrane forces of u
itself. Buckling: (K + f Kg(N(u1))) mode = 0 with the membrane forces N(u1) of first order.
Kg is the integral of N_ab (u,a . u,b): all three components, since a facet also sways in its
own plane. Columns c are load combinations throughout.
"""

from dataclasses import dataclass

import numpy as np

from crosscheck.stress import compute_membrane_forces
from crosscheck.system import Response, System, solve_local

TOLERANCE = 1e-6  # last change of displacements
ITERATIONS = 80
MEMORY = 6  # steps that the acceleration looks back
DIVERGED = 1e6  # times the first-order answer


class NotSettled(ValueError):
    """The iteration found no state: the load is beyond buckling, or next to it."""


@dataclass(frozen=True)
class SecondOrder:
    """The state reached, how many iterations it took and the last relative change."""

    response: Response
    iterations: int
    change: np.ndarray  # (c,)


def compute_geometric_matrices(system: System, local: np.ndarray) -> np.ndarray:
    """Integral of N_ab grad_a grad_b over each element: (F, 3, m^2, c, 9, 9) from (F, R, 5, c)."""
    grid = system.grid
    gradient = np.swapaxes(grid.quadrature.gradient, -1, -2)  # point, x|y, node
    flat = gradient.reshape(*gradient.shape[:3], 18, 9)
    result = []
    for case in range(local.shape[-1]):
        force = compute_membrane_forces(grid, system.section, local[..., case])
        force = force * grid.quadrature.area[..., None]
        tensor = force[..., [[0, 2], [2, 1]]]  # point, 2, 2
        weighted = (tensor @ gradient).reshape(flat.shape)
        result.append(np.swapaxes(flat, -1, -2) @ weighted)
    return np.stack(result, axis=3)


def apply_geometric(system: System, matrices: np.ndarray, local: np.ndarray) -> np.ndarray:
    """Kg u as forces on the facets' own nodes: (F, R, 5, c), not yet summed between facets."""
    elements = system.grid.elements
    moved = np.moveaxis(local[:, elements, :3], -1, -3)  # F, 3, m^2, c, 9, 3
    force = np.moveaxis(matrices @ moved, -3, -1)  # F, 3, m^2, 9, 3, c
    total = np.zeros_like(local)
    for block in range(3):
        for k, nodes in enumerate(elements[block]):
            total[:, nodes, :3] += force[:, block, k]
    return total


def solve_second_order(
    system: System, forces: np.ndarray, first: Response, tolerance: float = TOLERANCE
) -> SecondOrder:
    """Fixed point u <- inverse(K) (F - Kg(N(u)) u), with Anderson acceleration a combination.

    `forces` (F, R, 3, c) act on facet nodes; `first` is the first-order answer, where it starts.
    Raises NotSettled.
    """
    local = np.einsum("fij,frjc->fric", system.grid.axes, forces, optimize=True)
    load = np.concatenate([local, np.zeros_like(local[:, :, :2])], axis=2)
    now = first.local
    history: list[tuple[np.ndarray, np.ndarray]] = []
    for count in range(1, ITERATIONS + 1):
        matrices = compute_geometric_matrices(system, now)
        response = solve_local(system, load - apply_geometric(system, matrices, now))
        residual = response.local - now
        size = _norm(response.local)
        if not np.isfinite(size).all() or (size > DIVERGED * _norm(first.local)).any():
            break
        change = _norm(residual) / size
        if (change < tolerance).all():
            return SecondOrder(response, count, change)
        history = [*history[-MEMORY:], (response.local, residual)]
        now = _accelerate(history)
    raise NotSettled(f"after {count} iterations no state is found")


def _norm(local: np.ndarray) -> np.ndarray:
    """Root of the sum of squared translations, a column: (c,)."""
    return np.sqrt((local[:, :, :3] ** 2).sum(axis=(0, 1, 2)))


def _accelerate(history: list[tuple[np.ndarray, np.ndarray]]) -> np.ndarray:
    """Anderson: the mix of past steps with the least residual, for each column."""
    new, residual = history[-1]
    if len(history) == 1:
        return new
    result = np.empty_like(new)
    for case in range(new.shape[-1]):
        steps = np.array([(residual - r)[..., case].ravel() for _, r in history[:-1]])
        gram = steps @ steps.T
        right = steps @ residual[..., case].ravel()
        weight = np.linalg.lstsq(gram, right, rcond=1e-14)[0]
        result[..., case] = new[..., case]
        for w, (past, _) in zip(weight, history[:-1], strict=True):
            result[..., case] -= w * (new - past)[..., case]
    return result
