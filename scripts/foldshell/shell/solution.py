"""K of one thickness vector, factorised, and the ways in which an analysis uses it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from foldshell.files.threads import divide, run_parts
from foldshell.shell.buckling import LEAST_COLUMNS, BucklingResult, find_buckling_factors
from foldshell.shell.effort import Effort
from foldshell.shell.geometric import GeometricProducts, apply_geometric
from foldshell.shell.linear_solver import Factor, factorise
from foldshell.shell.near_null import find_near_null_vector, is_singular
from foldshell.shell.second_order import SecondOrderResult, solve_second_order
from foldshell.shell.stress import (
    imposed_resultants,
    internal_forces,
    membrane_forces,
    stress_resultants,
)

if TYPE_CHECKING:
    from foldshell.shell.analysis import ShellModel


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

    def buckling(
        self, first_order_cases, strains, factors, start, effort: Effort
    ) -> BucklingResult:
        """Return the buckling factor and the mode of every combination."""
        # as few geometric stiffnesses as the combinations are independent
        mixing, weights, independent = np.linalg.svd(factors, full_matrices=False)
        rank = int((weights > 1e-12 * weights[0]).sum())
        factors = weights[:rank, None] * independent[:rank]
        mixing = mixing[:, :rank]
        imposed = None if strains is None else strains @ mixing
        forces = self.forces(first_order_cases @ mixing, imposed)
        dofs = self._dofs
        products = GeometricProducts(self.model.operators, forces, dofs)
        # modes are kept in ascending order of freedoms, the factor works in its own
        place = self.model.pattern.ascending
        if start is not None:
            own = np.empty_like(start, dtype=float)
            own[place] = start
            start = own
        solve, size = self._factor.solve, len(dofs)
        found = find_buckling_factors(
            solve, products.each, factors, size, start, effort, apply_mixed=products.mix
        )
        return replace(found, modes=found.modes[place])

    def second_order(
        self,
        first_order: np.ndarray,
        tolerance: float,
        iterations_max: int,
        state: State,
        start: np.ndarray | None = None,
    ) -> SecondOrderResult:
        """Return second-order displacements, from an imperfect shape where there is one.

        first_order (dofs, c) m and rad, as is `start`, near the answer, to begin with.
        """
        dofs, operators = self._dofs, self.model.operators

        def correction(displacement: np.ndarray, columns: np.ndarray) -> np.ndarray:
            """Return -K^-1 K_g(N(u)) u of displacements u (free, k), m and rad."""
            parts = divide(len(columns), len(dofs), LEAST_COLUMNS)
            pushed = list(run_parts(lambda p: push(displacement[:, p], columns[p]), parts))
            return -self._factor.solve(pushed[0] if len(pushed) == 1 else np.hstack(pushed))

        def push(displacement: np.ndarray, columns: np.ndarray) -> np.ndarray:
            full = np.zeros((len(first_order), displacement.shape[1]))
            if state.settled is not None:
                full = state.settled[:, columns]
            full[dofs] = displacement
            imposed = None if state.imposed is None else state.imposed[..., columns]
            shape = full if state.imperfection is None else full + state.imperfection[:, None]
            return apply_geometric(operators, self.forces(full, imposed), shape)[dofs]

        begin = None if start is None else start[dofs]
        return solve_second_order(first_order[dofs], correction, tolerance, iterations_max, begin)


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
