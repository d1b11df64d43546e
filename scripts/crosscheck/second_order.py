"""Second order and buckling with one factor of the first-order stiffness.

Second order (Th.II): (K + Kg(N(u))) u = F, small displacements, N the membrane forces of u
itself. Buckling: (K + f Kg(N(u1))) mode = 0 with the membrane forces N(u1) of first order.
Kg is the integral of N_ab (u,a . u,b): all three components, since a facet also sways in its
own plane. Columns c are load combinations throughout.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix

from crosscheck.discretisation import Discretisation
from crosscheck.search import NotSettled, Steps, run_alone
from crosscheck.stress import compute_gradients, compute_membrane_forces
from crosscheck.system import Response, System, complete_response, turn_forces

TOLERANCE = 1e-6  # last change of displacements
ITERATIONS = 80
MEMORY = 6  # steps that the acceleration looks back
DIVERGED = 1e6  # times the first-order answer


@dataclass(frozen=True)
class SecondOrder:
    """The state reached, how many iterations it took and the last relative change."""

    response: Response
    iterations: int
    change: np.ndarray  # (c,)


def compute_geometric_matrices(system: System, local: np.ndarray) -> np.ndarray:
    """Integral of N_ab grad_a grad_b over each element: (c, F, 3, m^2, 9, 9) from (F, R, 5, c)."""
    quadrature = system.grid.quadrature
    change = _find_gradients(system.grid, local)
    force = compute_membrane_forces(system.section, change)
    force = np.moveaxis(force * quadrature.area[..., None, None, None], -1, 0)
    flat = quadrature.gradient.reshape(*quadrature.gradient.shape[:3], 18, 9)
    result = np.empty((len(force), *flat.shape[:3], 9, 9))
    for case, tensor in enumerate(force):
        weighted = (tensor @ quadrature.gradient).reshape(flat.shape)
        np.matmul(np.swapaxes(flat, -1, -2), weighted, out=result[case])
    return result


def _find_gradients(grid: Discretisation, local: np.ndarray) -> np.ndarray:
    """Gradients of (u, v, w) at the Gauss points: (F, 3, m^2, 9, 2, 3, c) from (F, R, 5, c)."""
    count, places, _, cases = local.shape
    change = compute_gradients(grid, local[:, :, :3].reshape(count, places, 3 * cases))
    return change.reshape(*change.shape[:-1], 3, cases)


def assemble_geometric(grid: Discretisation, matrices: np.ndarray) -> list[csr_matrix]:
    """Kg of each case over the nodes of all facets, one facet after the other: (F R, F R) in kN/m.

    From the `matrices` (c, F, 3, m^2, 9, 9) of elements; one field serves u, v and w. A sparse
    product is quicker than one by elements, which gathers and adds up what they share.
    """
    count, places = grid.mesh.facet_nodes.shape
    nodes = grid.elements.reshape(-1, 9)
    entry = (nodes[:, :, None] * places + nodes[:, None]).ravel()
    known, which = np.unique(entry, return_inverse=True)
    once = (np.ones(len(entry)), (which.ravel(), np.arange(len(entry))))
    adding = csr_matrix(once, (len(known), len(entry)))
    row, column = np.divmod(known, places)
    columns = (np.arange(count)[:, None] * places + column).ravel()
    ends = np.cumsum(np.tile(np.bincount(row, minlength=places), count))
    starts = np.concatenate([[0], ends])
    return [
        csr_matrix(
            ((adding @ matrix.reshape(count, -1).T).T.ravel(), columns, starts),
            (count * places, count * places),
        )
        for matrix in matrices
    ]


def apply_geometric(operators: Sequence[csr_matrix], local: np.ndarray) -> np.ndarray:
    """Kg u as forces on the facets' own nodes: (F, R, 5, c b), not yet summed between facets.

    `local` (F, R, 5, c b) holds b vectors in a row for each of the c `operators`.
    """
    result = np.zeros_like(local)
    for case, operator in enumerate(operators):
        part = _pick_vectors(local, case, len(operators))
        moved = part.reshape(operator.shape[0], -1)
        _pick_vectors(result, case, len(operators))[...] = (operator @ moved).reshape(part.shape)
    return result


def _pick_vectors(local: np.ndarray, case: int, cases: int) -> np.ndarray:
    """View on the translations (F, R, 3, b) of one case in columns (F, R, 5, c b)."""
    return local[:, :, :3].reshape(*local.shape[:2], 3, cases, -1)[..., case, :]


def apply_own_geometric(system: System, local: np.ndarray) -> np.ndarray:
    """Kg(N(u)) u for each column of (F, R, 5, c), as `apply_geometric` gives it.

    From stress to force at the Gauss points, since the matrices would serve once only.

    Displacements in m and rad, forces in kN and kNm.
    """
    quadrature = system.grid.quadrature
    change = _find_gradients(system.grid, local)
    force = compute_membrane_forces(system.section, change)
    pull = np.empty_like(change)
    for a in range(2):
        across = [force[..., a, b, None, :] * change[..., b, :, :] for b in range(2)]
        np.add(*across, out=pull[..., a, :, :])
    pull *= quadrature.area[..., None, None, None]
    flat = quadrature.gradient.reshape(*quadrature.gradient.shape[:3], 18, 9)
    result = np.zeros_like(local)
    nodal = np.swapaxes(flat, -1, -2) @ pull.reshape(*flat.shape[:-1], -1)
    result[:, :, :3] = sum_elements(system.grid, nodal).reshape(result[:, :, :3].shape)
    return result


def sum_elements(grid: Discretisation, force: np.ndarray) -> np.ndarray:
    """Forces on element nodes (F, 3, m^2, 9, k) as those on the facets' nodes (F, R, k)."""
    count, places = grid.mesh.facet_nodes.shape
    return (grid.summing @ force.reshape(-1, force.shape[-1])).reshape(count, places, -1)


def solve_second_order(
    system: System, forces: np.ndarray, first: Response, tolerance: float = TOLERANCE
) -> SecondOrder:
    """Find the second-order state by `search_second_order` alone. Raises NotSettled.

    forces (F, R, 3, c) kN at facet nodes, one column per combination.
    """
    return run_alone(system, search_second_order(system, forces, first, tolerance))


def search_second_order(
    system: System, forces: np.ndarray, first: Response, tolerance: float = TOLERANCE
) -> Steps:
    """Fixed point u <- inverse(K) (F - Kg(N(u)) u), with Anderson acceleration per combination.

    `forces` (F, R, 3, c) act on facet nodes; `first` is the first-order answer, where it starts.
    Returns a SecondOrder, raises NotSettled.

    Forces in kN at facet nodes, one column per combination.
    """
    load, now = turn_forces(system.grid, forces), first.local
    history: list[tuple[np.ndarray, np.ndarray]] = []
    for count in range(1, ITERATIONS + 1):
        solution = yield load - apply_own_geometric(system, now)
        new = solution.local
        residual = new - now
        size = _norm(new)
        if not np.isfinite(size).all() or (size > DIVERGED * _norm(first.local)).any():
            break
        change = _norm(residual) / size
        if (change < tolerance).all():
            return SecondOrder(complete_response(system, solution), count, change)
        history = [*history[-MEMORY:], (new, residual)]
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
