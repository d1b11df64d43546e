"""K of one thickness vector, factorised, and the ways in which an analysis uses it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from foldshell.files.threads import divide, run_parts
from foldshell.shell.buckling import BucklingResult, BucklingSearch
from foldshell.shell.effort import Effort
from foldshell.shell.geometric import GeometricProducts, apply_geometric
from foldshell.shell.linear_solver import Factor, factorise
from foldshell.shell.near_null import find_near_null_vector, is_singular
from foldshell.shell.second_order import SecondOrderResult, SecondOrderSearch
from foldshell.shell.stress import (
    imposed_resultants,
    internal_forces,
    membrane_forces,
    stress_resultants,
)
from foldshell.shell.subspace import LEAST_COLUMNS

if TYPE_CHECKING:
    from foldshell.shell.analysis import ShellModel
    from foldshell.shell.placed_loads import PlacedLoads


@dataclass(frozen=True)
class AnalysisResult:
    """Displacements of every combination, and how they came about.

    Attributes
    ----------
    state : "ok", "unstable" (a buckling factor below 1), "mechanism" (K is not positive definite)
        or "not_converged"; `reason` says more
    names : combination names; c of them
    displacement : (dofs, c) m and rad, second order where asked for
    first_order : (dofs, c) displacement of first order
    loads : (dofs, c) kN
    buckling : factors and modes (free, c), or None
    second_order : iterations and residual, or None
    mechanism_node : node that moves most in a mechanism, else None
    imperfection : (dofs,) initial shape in m and rad, or None
    imposed : (E, 2, c) strain and curvature (1/m) that temperature imposes, or None
    """

    state: str
    reason: str
    names: tuple[str, ...]
    displacement: np.ndarray
    first_order: np.ndarray
    loads: np.ndarray
    buckling: BucklingResult | None = None
    second_order: SecondOrderResult | None = None
    mechanism_node: int | None = None
    imperfection: np.ndarray | None = None
    imposed: np.ndarray | None = None

    @property
    def least_factor(self) -> float | None:
        """Least buckling factor of all combinations, inf where nothing is compressed."""
        return None if self.buckling is None else float(self.buckling.factors.min())


@dataclass(frozen=True)
class State:
    """What second order knows beside displacements: an imperfect shape (dofs,), and of each
    combination imposed strains (E, 2, c) and settlements (dofs, c); None each for none."""

    imperfection: np.ndarray | None
    imposed: np.ndarray | None
    settled: np.ndarray | None


class Solution:
    """K factorised for one thickness vector, and the ways in which it is used."""

    def __init__(self, model, thickness, material, values, solver) -> None:
        self.model, self._thickness = model, thickness
        self._modulus = material.youngs_modulus
        self._factor: Factor = factorise(model.pattern, values, solver)
        self._diagonal = values[model.pattern.indptr[:-1]]
        self._dofs = model.pattern.dofs

    @property
    def is_singular(self) -> bool:
        """Whether the factor is one of round-off."""
        return is_singular(self._factor.solve, self._diagonal)

    def solve(
        self, forces: np.ndarray, strains: np.ndarray | None, moved: np.ndarray | None
    ) -> np.ndarray:
        """Return first-order displacements (dofs, c): K u = F + int B^T N_0 - K u_0."""
        operators, t, modulus = self.model.operators, self._thickness, self._modulus
        displacement = np.zeros_like(forces) if moved is None else moved.copy()
        if strains is not None or moved is not None:
            state = stress_resultants(operators, displacement, t, modulus, strains)
            forces = forces - internal_forces(operators, state)
        displacement[self._dofs] = self._factor.solve(forces[self._dofs])
        return displacement

    def forces(self, displacement: np.ndarray, imposed: np.ndarray | None) -> np.ndarray:
        """Return membrane forces (E, 3, m, c) kN/m."""
        operators, t, modulus = self.model.operators, self._thickness, self._modulus
        force = membrane_forces(operators, displacement, t, modulus)
        if imposed is None:
            return force
        return force - imposed_resultants(operators, imposed, t, modulus).force

    def search_buckling(
        self, first_order_cases, strains, factors, riders: Riders | None = None
    ) -> OrderedSearch:
        """Return the search for the buckling factors and modes of all combinations."""
        # as few geometric stiffnesses as the combinations are independent
        mixing, weights, independent = np.linalg.svd(factors, full_matrices=False)
        rank = int((weights > 1e-12 * weights[0]).sum())
        factors = weights[:rank, None] * independent[:rank]
        mixing = mixing[:, :rank]
        imposed = None if strains is None else strains @ mixing
        forces = self.forces(first_order_cases @ mixing, imposed)
        products = GeometricProducts(self.model.operators, forces, self._dofs)
        solve = self._factor.solve if riders is None else riders.along(self._factor.solve)
        search = BucklingSearch(solve, products, factors, len(self._dofs))
        return OrderedSearch(search, self.model.pattern.ascending)

    def push(self, displacement: np.ndarray, state: State, columns: np.ndarray) -> np.ndarray:
        """Return K_g(N(u)) u (free, k) of displacements u (free, k) of some columns (k,), kN.

        Displacements in m and rad, columns as numbers.
        """
        full = np.zeros((self.model.mesh.dof_count, displacement.shape[1]))
        if state.settled is not None:
            full = state.settled[:, columns]
        full[self._dofs] = displacement
        imposed = None if state.imposed is None else state.imposed[..., columns]
        shape = full if state.imperfection is None else full + state.imperfection[:, None]
        return apply_geometric(self.model.operators, self.forces(full, imposed), shape)[self._dofs]

    def search_second_order(
        self,
        first_order: np.ndarray,
        state: State,
        riders: Riders | None = None,
        start: np.ndarray | None = None,
    ) -> SecondOrderSearch:
        """Return the search for second-order displacements, from an imperfect shape if there is
        one; first_order (dofs, c) m and rad, `riders` what has been solved of it already, `start`
        (dofs, c) m and rad where it begins if not with first order."""

        def correction(displacement: np.ndarray, columns: np.ndarray) -> np.ndarray:
            """Return -K^-1 K_g(N(u)) u of displacements u (free, k), m and rad."""
            parts = divide(len(columns), len(self._dofs), LEAST_COLUMNS)
            own = run_parts(lambda p: self.push(displacement[:, p], state, columns[p]), parts)
            pushed = list(own)
            return -self._factor.solve(pushed[0] if len(pushed) == 1 else np.hstack(pushed))

        dofs = self._dofs
        if start is not None:
            return SecondOrderSearch(first_order[dofs], correction, start=start[dofs])
        begin = None if riders is None or riders.answer is None else -riders.answer
        return SecondOrderSearch(first_order[dofs], correction, begin)


class Riders:
    """Right-hand sides (free, k) that ride along with the first that are solved for.

    Most of the time of a solution goes to reading the factor, which is done once for all.
    """

    def __init__(self, forces: np.ndarray) -> None:
        self._waiting: np.ndarray | None = forces
        self.answer: np.ndarray | None = None

    def along(self, solve: Callable[[np.ndarray], np.ndarray]) -> Callable[..., np.ndarray]:
        """Return a `solve` on (free, k) whose first call serves the riders too.

        In kN and kNm, the result in m and rad.
        """

        def solve_both(forces: np.ndarray) -> np.ndarray:
            """Return K^-1 forces; the first time the riders are answered in the same call."""
            if self._waiting is None:
                return solve(forces)
            both = solve(np.hstack([forces, self._waiting]))
            own, self.answer = np.split(both, [forces.shape[1]], axis=1)
            self._waiting = None
            return own

        return solve_both


@dataclass(frozen=True)
class OrderedSearch:
    """A search for buckling whose modes are kept in ascending order of freedoms.

    The factor works in its own; `place` (size,) are its rows in ascending order, as numbers.
    """

    search: BucklingSearch
    place: np.ndarray

    def run(self, effort: Effort, start: np.ndarray | None) -> BucklingResult:
        """Return the factor and the mode of every combination, from modes (size, c) if given.

        Modes have no unit.
        """
        if start is not None:
            own = np.empty_like(start, dtype=float)
            own[self.place] = start
            start = own
        found = self.search.run(effort, start)
        return replace(found, modes=found.modes[self.place])


def settle(model: ShellModel, placed: PlacedLoads) -> np.ndarray | None:
    """Return the displacements of supports as fields (dofs, C), or None."""
    if placed.settled is None:
        return None
    moved = np.zeros((model.mesh.dof_count, len(placed.names)))
    moved[: 3 * len(model.mesh.nodes)] = placed.settled.reshape(-1, len(placed.names))
    return moved


def initial_shape(
    model: ShellModel, buckling: BucklingResult, column: int, loads: np.ndarray, size: float
) -> np.ndarray | None:
    """Return the mode of one combination (dofs,) of largest translation `size` m, None for none.

    It is turned to the side to which the loads (dofs, c), in kN, of that combination push it.
    """
    if size == 0 or not np.isfinite(buckling.factors[column]):
        return None
    shape = np.zeros(model.mesh.dof_count)
    shape[model.pattern.free] = buckling.modes[:, column]
    moved = shape[: 3 * len(model.mesh.nodes)].reshape(-1, 3)
    sign = -1.0 if shape @ loads[:, column] < 0 else 1.0
    return shape * (sign * size / np.linalg.norm(moved, axis=1).max())


def describe_mechanism(
    model: ShellModel, values: np.ndarray, solver: str
) -> tuple[str, int | None]:
    """Say where the stiffness gives way, and name the node that moves most, if one is found.

    values (nnz,) of its lower triangle in kN/m, kN and kNm.
    """
    reason, node = "the stiffness matrix is not positive definite", None
    vector = find_near_null_vector(model.pattern, values, solver)
    if vector is not None:
        full = np.zeros(model.mesh.dof_count)
        full[model.pattern.dofs] = vector
        moved = np.linalg.norm(full[: 3 * len(model.mesh.nodes)].reshape(-1, 3), axis=1)
        node = int(moved.argmax())
        x, y, z = model.mesh.nodes[node]
        reason += f": a mechanism moves most at node {node}, ({x:.3f}, {y:.3f}, {z:.3f}) m"
    return reason, node


def judge_state(
    names: Sequence[str], second: SecondOrderResult, buckling: BucklingResult
) -> tuple[str, str]:
    """Return the state, and in words what did not converge."""
    if not second.converged:
        worst = int(np.argmax(second.residual))
        return "not_converged", (
            f"second order of {names[worst]} stands at a relative change of "
            f"{second.residual[worst]:.1e} after {second.iterations} iterations"
        )
    if not buckling.converged:
        change = buckling.change.max()
        return "not_converged", f"buckling factors still change by {change:.1e}"
    return "ok", ""
