"""The plain path: the same shell, assembled whole with scipy.sparse. Read this one first.

Every facet has its own nodes, with the local unknowns d = (u, v, w, bx, by): displacement in its
axes, and slopes so that the point z above the middle surface moves by u + z bx, v + z by. Facets
meet where they share the unknowns x of the shell: six at a node on a fold or border (three
displacements, three rotations), five at a node inside a facet. So

    d = T x                       a facet moves with the shell's unknowns   `connect_facets`
    S = sum of element matrices   on d, facet by facet                      `assemble`
    K = T' S T + springs          of elastic supports                       `collect_springs`
    K x = T' f                    equilibrium under forces f on d           `solve_plain_loads`
    r = C' (S d - f)              supports, C being T and what they hold    `find_plain_reactions`
    (K + c G(u)) v = 0            buckling: G of first order, least c > 0   `find_plain_factors`
    (K + G(u)) x = T' f           second order: G of the state itself       `find_plain_state`

with G(u) = T' (sum of integrals of N_ab(u) grad_a grad_b) T, the same on u, v and w. What the fast
path does beside this (condensing facets, fronts, block Lanczos, Anderson's mixing) only saves time;
element matrices, loads and membrane forces N are those of `element.py`, `loads.py`, `stress.py`.
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix, csr_matrix, diags
from scipy.sparse.linalg import LinearOperator, SuperLU, eigsh, splu

from crosscheck.discretisation import Discretisation
from crosscheck.frontal import ROUNDING, NotPositiveDefinite
from crosscheck.search import NotSettled
from crosscheck.second_order import ITERATIONS, compute_geometric_matrices
from crosscheck.system import Response, Section, compute_element_matrices, turn_forces

CHANGE = 1e-10
"""Last relative change of second-order displacements."""


@dataclass(frozen=True)
class PlainSystem:
    """A shell with N local unknowns d, n unknowns x, and A with those that are held."""

    grid: Discretisation
    section: Section
    connection: csr_matrix  # (N, n) T
    whole: csr_matrix  # (N, A) C: T, and the columns of what is held
    free: np.ndarray  # (A,) which columns of C make up T
    springs: np.ndarray  # (A,) kN/m of supports, 0 for none
    elements: csr_matrix  # (N, N) S, kN/m
    stiffness: csc_matrix  # (n, n) K
    factor: SuperLU  # of K


def build_plain_system(grid: Discretisation, section: Section) -> PlainSystem:
    """K = T' S T and its factor; raises NotPositiveDefinite for a mechanism.

    One solve under random forces brings out the softest direction: in a mechanism its energy is
    rounding, 1e-17 of what its diagonal would give, in the thinnest shell of the study 1e-5.
    """
    membrane, plate = compute_element_matrices(grid, section)
    elements = assemble(grid, membrane, [0, 1]) + assemble(grid, plate, [2, 3, 4])
    whole, free = connect_facets(grid)
    connection = whole[:, free]
    springs = collect_springs(grid, len(free))
    stiffness = (connection.T @ elements @ connection + diags(springs[free])).tocsc()
    factor = factor_symmetric(stiffness)
    softest = factor.solve(np.random.default_rng(0).normal(size=len(stiffness.indptr) - 1))
    energy, scale = softest @ (stiffness @ softest), softest @ (stiffness.diagonal() * softest)
    if not energy > ROUNDING * scale:
        raise NotPositiveDefinite("a direction has no positive stiffness")
    return PlainSystem(grid, section, connection, whole, free, springs, elements, stiffness, factor)


def assemble(grid: Discretisation, matrices: np.ndarray, components: list[int]) -> csr_matrix:
    """S = sum of element matrices (F, 3, m^2, 9 d, 9 d) on d of the five local unknowns: (N, N)."""
    facets, places = grid.mesh.facet_nodes.shape
    node = np.arange(facets)[:, None, None, None] * places + grid.elements
    unknown = (5 * node[..., None] + components).reshape(*node.shape[:-1], -1)
    rows, columns = np.broadcast_arrays(unknown[..., :, None], unknown[..., None, :])
    size = 5 * facets * places
    entries = (matrices.ravel(), (rows.ravel(), columns.ravel()))
    return coo_matrix(entries, (size, size)).tocsr()


def connect_facets(grid: Discretisation) -> tuple[csr_matrix, np.ndarray]:
    """C (N, A) of d = C y for all A unknowns y, six at each of S nodes first; which are free (A,).

    What supports hold is not free, nor the third rotation at a node that lies in one plane.
    """
    facets, places = grid.mesh.facet_nodes.shape
    border = grid.mesh.reference.outline
    local = np.arange(5 * facets * places).reshape(facets, places, 5)
    unknown = 6 * grid.mesh.facet_nodes[:, :border, None] + np.arange(6)
    rows = np.broadcast_to(local[:, :border, :, None], grid.turn.shape)
    columns = np.broadcast_to(unknown[:, :, None], grid.turn.shape)
    inside = local[:, border:].ravel()  # they are unknowns as they are
    first = 6 * grid.mesh.skeleton
    free = np.ones(first + len(inside), dtype=bool)
    free[unknown] = grid.equations >= 0
    value = np.concatenate([grid.turn.ravel(), np.ones(len(inside))])
    rows = np.concatenate([rows.ravel(), inside])
    columns = np.concatenate([columns.ravel(), first + np.arange(len(inside))])
    return coo_matrix((value, (rows, columns)), (local.size, len(free))).tocsr(), free


def collect_springs(grid: Discretisation, count: int) -> np.ndarray:
    """Stiffness of supports against each unknown: (A,) in kN/m."""
    springs = np.zeros(count)
    if grid.springs is not None:
        unknown = 6 * grid.mesh.facet_nodes[:, : grid.springs.shape[1], None] + np.arange(3)
        np.add.at(springs, unknown, grid.springs)
    return springs


def factor_symmetric(matrix: csc_matrix) -> SuperLU:
    """L U of a symmetric matrix, with its pivots on the diagonal. Raises NotPositiveDefinite."""
    options = {"SymmetricMode": True}
    try:
        return splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
    except RuntimeError:
        raise NotPositiveDefinite("the matrix is singular") from None


def solve_plain_loads(system: PlainSystem, forces: np.ndarray) -> Response:
    """K x = T' f for forces (F, R, 3, c) in kN on facet nodes, global axes."""
    load = turn_forces(system.grid, forces)
    moved = system.factor.solve(system.connection.T @ _flatten(load))
    return _respond(system, moved, system.elements, load)


def solve_plain_sheared(system: PlainSystem, forces: np.ndarray, shear_factor: float) -> Response:
    """The same, forces (F, R, 3, c) in kN, with another shear factor of the plate."""
    section = replace(system.section, shear_factor=shear_factor)
    return solve_plain_loads(build_plain_system(system.grid, section), forces)


def find_plain_reactions(
    system: PlainSystem, elements: csr_matrix, local: np.ndarray, load: np.ndarray
) -> np.ndarray:
    """r = C' (S d - f) of every node on folds and borders: (S, 3, c) in kN, zero where free.

    A spring's is -k u, since there S d - f is what it carries.
    """
    force = system.whole.T @ (elements @ _flatten(local) - _flatten(load))
    force[system.free & (system.springs == 0)] = 0.0  # but for rounding it is
    return force[: 6 * system.grid.mesh.skeleton].reshape(-1, 6, force.shape[1])[:, :3]


def find_plain_factors(system: PlainSystem, first: Response) -> np.ndarray:
    """Least c > 0 with (K + c G) v = 0 for each column of `first`, infinite where none is: (c,).

    -G v = m K v, whose largest m is 1 / c.
    """
    size = system.stiffness.shape[0]
    inverse = LinearOperator((size, size), system.factor.solve)
    start = np.random.default_rng(0).normal(size=size)
    factors = []
    for case in range(first.local.shape[-1]):
        geometric = _reduce(system, build_geometric(system, first.local[..., [case]]))
        found = eigsh(-geometric, 2, system.stiffness, Minv=inverse, which="LA", v0=start)[0]
        factors.append(1 / found.max() if found.max() > 0 else np.inf)
    return np.array(factors)


def build_geometric(system: PlainSystem, local: np.ndarray) -> csr_matrix:
    """Sum of the integrals of N_ab(u) grad_a grad_b, on u, v and w alike: (N, N) in kN/m."""
    matrices = compute_geometric_matrices(system, local)[0]
    return sum(assemble(system.grid, matrices, [component]) for component in range(3))


def find_plain_state(system: PlainSystem, forces: np.ndarray, first: Response) -> Response:
    """(K + G(u)) x = T' f for one column of forces (F, R, 3, 1), G of the last x until it stays.

    Raises NotSettled.

    Forces in kN or kNm at the facets' nodes, x in m or rad.
    """
    load, now = turn_forces(system.grid, forces), first.local
    right = system.connection.T @ _flatten(load)
    for _ in range(ITERATIONS):
        geometric = build_geometric(system, now)
        moved = factor_symmetric(system.stiffness + _reduce(system, geometric)).solve(right)
        state = _respond(system, moved, system.elements + geometric, load)
        if np.linalg.norm(state.local - now) < CHANGE * np.linalg.norm(state.local):
            return state
        now = state.local
    raise NotSettled(f"after {ITERATIONS} iterations no state is found")


def _reduce(system: PlainSystem, matrix: csr_matrix) -> csc_matrix:
    """T' A T."""
    return (system.connection.T @ matrix @ system.connection).tocsc()


def _respond(
    system: PlainSystem, moved: np.ndarray, elements: csr_matrix, load: np.ndarray
) -> Response:
    """d = T x in local and global axes, and the reactions."""
    local = (system.connection @ moved).reshape(load.shape)
    displacement = np.einsum("fij,fric->frjc", system.grid.axes, local[:, :, :3])
    reactions = find_plain_reactions(system, elements, local, load)
    return Response(local, displacement, reactions)


def _flatten(values: np.ndarray) -> np.ndarray:
    """(F, R, 5, c) as (N, c)."""
    return values.reshape(-1, values.shape[-1])
