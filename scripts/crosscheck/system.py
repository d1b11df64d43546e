"""The shell as one system of equations: facets condensed, skeleton factored, loads solved."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from crosscheck.discretisation import Discretisation
from crosscheck.element import (
    Quadrature,
    compute_plane_stiffness,
    compute_shear_stiffness,
)
from crosscheck.facet import (
    Substructure,
    allocate,
    condense_facets,
    recover_facets,
    reduce_load,
    store,
)
from crosscheck.frontal import Factor, factor_sum
from crosscheck.holding import Holding, add_springs, find_reactions, make_holding

SHEAR_FACTOR = 100.0
"""Thin limit: shear deformation is that of a plate ten times thinner. 5/6 is the physical plate."""
CHUNK = 192  # elements condensed at once: their matrices stay near the processor
STABILITY = 0.03
"""Shear compliance added in proportion to (element size / thickness)^2, which vanishes with the
mesh and keeps skewed elements from locking. Source: Lyly, Stenberg, Vihinen, Comput. Methods Appl.
Mech. Eng. 110 (1993) 343-357, there 0.1 / (5/6). On the six folded sheets the error at m = 2 falls
from 3-8 % without it to 1.5 % at most."""


@dataclass(frozen=True)
class Section:
    """Stiffness of each facet: thickness in m (F,), E in kPa, Poisson's ratio, shear factor."""

    thickness: np.ndarray
    youngs_modulus: float
    poissons_ratio: float
    shear_factor: float = SHEAR_FACTOR


@dataclass(frozen=True)
class System:
    """A factored shell."""

    grid: Discretisation
    section: Section
    membrane: Substructure
    plate: Substructure
    holding: Holding
    factor: Factor


@dataclass(frozen=True)
class State:
    """Displacements of all facet nodes: local (u, v, w, bx, by) in m and rad, and global in m."""

    local: np.ndarray  # (F, R, 5, c)
    displacement: np.ndarray  # (F, R, 3, c)


@dataclass(frozen=True)
class Response(State):
    """Displacements, and the reactions at S skeleton nodes."""

    reactions: np.ndarray  # (S, 3, c) kN, zero where nothing is held

    @property
    def reaction_sum(self) -> np.ndarray:
        """Sum of the reactions: (3, c) in kN."""
        return self.reactions.sum(axis=0)

    def pick_cases(self, cases: np.ndarray) -> "Response":
        """The response to some of the c cases, by their numbers (k,)."""
        values = (self.local, self.displacement, self.reactions)
        return Response(*(value[..., cases] for value in values))


def compute_element_matrices(
    grid: Discretisation, section: Section, part: slice | np.ndarray = slice(None)
) -> tuple[np.ndarray, np.ndarray]:
    """Membrane (F, 3, m^2, 18, 18) and plate (F, 3, m^2, 27, 27) stiffness of some facets."""
    whole = grid.quadrature
    quadrature = Quadrature(
        whole.shape, whole.gradient[part], whole.area[part], whole.inverse[part]
    )
    plane = compute_plane_stiffness(quadrature, section.poissons_ratio)
    plate = compute_shear_stiffness(grid.coordinates[part], quadrature)
    thickness = section.thickness[part, None, None, None, None]
    modulus = section.youngs_modulus
    plate *= compute_shear_rigidity(grid, section, section.shear_factor, part)[..., None, None]
    bending = modulus * thickness**3 / 12 * plane
    block = plate.reshape(*plate.shape[:-2], 9, 3, 9, 3)
    block[..., 1:, :, 1:] += bending.reshape(*plane.shape[:-2], 9, 2, 9, 2)
    return modulus * thickness * plane, plate


def compute_shear_rigidity(
    grid: Discretisation,
    section: Section,
    shear_factor: float,
    part: slice | np.ndarray = slice(None),
) -> np.ndarray:
    """G t / (1/k + STABILITY h^2 / t^2) of the elements of some facets: (F, 3, m^2) in kN/m."""
    thickness = section.thickness[part, None, None]
    slender = grid.quadrature.area[part].sum(axis=-1) / thickness**2
    factor = 1 / (1 / shear_factor + STABILITY * slender)
    return factor * section.youngs_modulus / (2 * (1 + section.poissons_ratio)) * thickness


def build_system(
    grid: Discretisation, section: Section, geometric: tuple[np.ndarray, np.ndarray] | None = None
) -> System:
    """Condense all facets and factor the skeleton; `geometric` is added to the two fields.

    Raises NotPositiveDefinite for a mechanism or a buckled state.

    The pair is (F, n, n) of membrane and (F, n, n) of plate, kN/m and kNm.
    """
    work = _Condenser(grid, section, geometric)
    place = grid.equations.reshape(len(grid.equations), -1)
    factor = factor_sum(work.condense(), grid.plan, place, grid.spans)
    return System(grid, section, *work.fields, work.holding, factor)


@dataclass
class _Condenser:
    """Condenses facets when the factorisation needs them: few of their matrices exist at a time."""

    grid: Discretisation
    section: Section
    geometric: tuple[np.ndarray, np.ndarray] | None
    fields: list[Substructure] = field(default_factory=list)
    holding: Holding | None = None

    def condense(self) -> Iterator[np.ndarray]:
        """Yield the skeleton stiffness (72m, 72m) of one facet after the other."""
        grid = self.grid
        self.holding = make_holding(grid)
        count = len(grid.equations)
        chunk = max(1, CHUNK // grid.elements.shape[0] // grid.elements.shape[1])
        for start in range(0, count, chunk):
            part = grid.plan.facets[start : start + chunk]
            matrices = compute_element_matrices(grid, self.section, part)
            if self.geometric is not None:
                pairs = zip(matrices, self.geometric, strict=True)
                matrices = tuple(a + b[part] for a, b in pairs)
            outlines = []
            for k, elements in enumerate(matrices):
                outline, field_part = condense_facets(elements, grid.mesh.reference)
                if start == 0:
                    self.fields.append(allocate(field_part, count))
                store(self.fields[k], part, field_part)
                outlines.append(outline)
            total = turn_stiffness(join_fields(*outlines), grid.turn[part])
            if grid.springs is not None:
                add_springs(total, grid.springs[part])
            self.holding.keep(part, total)
            yield from total


def join_fields(membrane: np.ndarray, plate: np.ndarray) -> np.ndarray:
    """Facet matrices (F, n, 5, n, 5) on (u, v, w, bx, by) from the two fields.

    membrane (F, 2n, 2n) in kN/m, plate (F, 3n, 3n) in kN/m, kN and kNm.
    """
    count, nodes = len(membrane), membrane.shape[1] // 2
    total = np.zeros((count, nodes, 5, nodes, 5))
    total[:, :, :2, :, :2] = membrane.reshape(count, nodes, 2, nodes, 2)
    total[:, :, 2:, :, 2:] = plate.reshape(count, nodes, 3, nodes, 3)
    return total


def turn_stiffness(local: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """T^T K T, node block by node block: (F, n, 5, n, 5) to (F, 6n, 6n).

    Units stay: kN/m, kN and kNm.
    """
    count, nodes = turn.shape[:2]
    half = np.moveaxis(local.reshape(count, 5 * nodes, nodes, 5), 2, 1) @ turn
    half = np.moveaxis(half.reshape(count, nodes, nodes, 5, 6), 2, 1)
    half = np.moveaxis(half, 3, 2).reshape(count, nodes, 5, nodes * 6)
    return (np.swapaxes(turn, -1, -2) @ half).reshape(count, 6 * nodes, 6 * nodes)


def solve_loads(system: System, forces: np.ndarray) -> Response:
    """Displacements under facet node forces (F, R, 3, c) in kN, global axes."""
    return solve_local(system, turn_forces(system.grid, forces))


def turn_forces(grid: Discretisation, forces: np.ndarray) -> np.ndarray:
    """Forces (F, R, 3, c) in global axes as local ones on (u, v, w, bx, by): (F, R, 5, c).

    kN and kNm.
    """
    local = np.einsum("fij,frjc->fric", grid.axes, forces, optimize=True)
    return np.concatenate([local, np.zeros_like(local[:, :, :2])], axis=2)


def solve_local(system: System, local: np.ndarray) -> Response:
    """Displacements under local forces (F, R, 5, c) on (u, v, w, bx, by).

    Forces in kN and kNm, displacements in m and rad.
    """
    solution = solve_facets(system, local)
    return complete_response(system, solution)


@dataclass(frozen=True)
class Solution:
    """Local values at all facet nodes, the equations, and local condensed loads on outlines."""

    local: np.ndarray  # (F, R, 5, c)
    found: np.ndarray  # (size, c)
    load: np.ndarray  # (F, 12m, 5, c)


def complete_response(system: System, solution: Solution) -> Response:
    """Global displacements and reactions, which an iteration needs once only."""
    state, grid = place_state(system, solution.local), system.grid
    held = np.zeros((1, solution.found.shape[1]))
    outline = np.concatenate([solution.found, held])[grid.equations]
    load = np.swapaxes(grid.turn, -1, -2) @ solution.load
    reactions = find_reactions(grid, system.holding, outline, load)
    return Response(state.local, state.displacement, reactions)


def place_state(system: System, local: np.ndarray) -> State:
    """Local displacements (F, R, 5, c) in m and rad, and the same along the global axes."""
    axes = system.grid.axes
    return State(local, np.einsum("fij,fric->frjc", axes, local[:, :, :3], optimize=True))


def solve_facets(system: System, local: np.ndarray) -> Solution:
    """Displacements under local forces (F, R, 5, c), without what follows from them.

    Forces in kN and kNm, displacements in m and rad.
    """
    grid, outline = system.grid, system.grid.mesh.reference.outline
    count, places, _, cases = local.shape
    membrane = reduce_load(system.membrane, local[:, :, :2].reshape(count, -1, cases))
    plate = reduce_load(system.plate, local[:, :, 2:].reshape(count, -1, cases))
    load = _join(membrane, plate, outline)
    found = system.factor.solve(grid.gathering @ load.reshape(-1, cases))
    values = (grid.spreading @ found).reshape(load.shape)
    full = _join(
        recover_facets(system.membrane, membrane, values[:, :, :2].reshape(count, -1, cases)),
        recover_facets(system.plate, plate, values[:, :, 2:].reshape(count, -1, cases)),
        places,
    )
    return Solution(full, found, load)


def _join(membrane: np.ndarray, plate: np.ndarray, nodes: int) -> np.ndarray:
    """The first `nodes` of (F, 2R, c) and (F, 3R, c) as (F, nodes, 5, c)."""
    count, cases = len(membrane), membrane.shape[-1]
    in_plane = membrane[:, : 2 * nodes].reshape(count, nodes, 2, cases)
    return np.concatenate([in_plane, plate[:, : 3 * nodes].reshape(count, nodes, 3, cases)], axis=2)
