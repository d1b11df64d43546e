"""The shell analysis of one thickness vector: what Karamba did in the paper's loop."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from foldshell.loads.cases import SurfaceLoad, combination_matrix, surface_loads
from foldshell.settings.analysis import Analysis
from foldshell.settings.field import Factors
from foldshell.settings.material import Material
from foldshell.shell.assembly import (
    LowerPattern,
    assemble_stiffness,
    find_pattern,
    translation_dofs,
)
from foldshell.shell.boundary import find_acting
from foldshell.shell.buckling import BucklingResult, find_buckling_factors
from foldshell.shell.geometric import apply_geometric, make_geometric_products
from foldshell.shell.linear_solver import Factor, NotPositiveDefiniteError, factorise
from foldshell.shell.mesh import ShellMesh
from foldshell.shell.near_null import find_near_null_vector, is_singular
from foldshell.shell.nodal_loads import nodal_forces
from foldshell.shell.second_order import SecondOrderResult, solve_second_order
from foldshell.shell.stiffness import ShellOperators, build_operators
from foldshell.shell.stress import membrane_forces


@dataclass(frozen=True)
class ShellModel:
    """A geometry ready for any thickness: mesh, operators, pattern, supported nodes.

    `fixed_thickness` (B,) m is that of the last B panels: not sized, they carry nothing but their
    own weight (the panels of an edge beam). Supports act on the S supported nodes along the
    directions of `acting` (S, 3) bool, along all where it is None.
    """

    mesh: ShellMesh
    operators: ShellOperators
    pattern: LowerPattern
    supported_nodes: np.ndarray
    fixed_thickness: np.ndarray = field(default_factory=lambda: np.empty(0))
    acting: np.ndarray | None = None

    @property
    def sized_panels(self) -> int:
        """Number of panels that are sized; they stand first."""
        return int(self.mesh.panel.max()) + 1 - len(self.fixed_thickness)

    @property
    def self_weight_only(self) -> np.ndarray:
        """Whether each element carries nothing but its own weight, (E,) bool."""
        return self.mesh.panel >= self.sized_panels

    def to_elements(self, thickness: np.ndarray) -> np.ndarray:
        """Return the thickness of each element (E,) from that of the sized panels (P,), m."""
        return np.concatenate([thickness, self.fixed_thickness])[self.mesh.panel]


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


def build_model(
    mesh: ShellMesh,
    supported_nodes: np.ndarray,
    poissons_ratio: float,
    fixed: np.ndarray | None = None,
    fixed_thickness: np.ndarray | None = None,
    springs: np.ndarray | None = None,
) -> ShellModel:
    """Build what depends on the geometry only.

    Parameters
    ----------
    supported_nodes : nodes held in all three directions
    fixed : further freedoms that are held (`translation_dofs`, `rotation_dofs`)
    fixed_thickness : (B,) m of the last B panels, which are not sized; see `ShellModel`
    springs : (dofs,) kN/m of elastic supports

    Raises
    ------
    ValueError
        if nothing but nodes on one line is held.
    """
    supported = np.asarray(supported_nodes, dtype=np.int64)
    held = translation_dofs(supported)
    acting = None
    if fixed is not None or springs is not None:
        held = held if fixed is None else np.union1d(held, fixed)
        supported, acting = find_acting(mesh, held, springs)
    elif len(supported) < 3 or _on_one_line(mesh.nodes[supported]):
        raise ValueError("the supports lie on one line and leave a rotation about it free")
    operators = build_operators(mesh, poissons_ratio)
    pattern = find_pattern(operators, held, springs)
    own = np.empty(0) if fixed_thickness is None else np.asarray(fixed_thickness, dtype=float)
    return ShellModel(mesh, operators, pattern, supported, own, acting)


def _on_one_line(points: np.ndarray) -> bool:
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return bool(spread[1] < 1e-9 * spread[0])


def analyse_shell(
    model: ShellModel,
    thickness: np.ndarray,
    material: Material,
    cases: Sequence[SurfaceLoad],
    combinations: Factors,
    options: Analysis | None = None,
    start_modes: np.ndarray | None = None,
) -> AnalysisResult:
    """Factorise K once; first order, buckling factors and second order of all combinations.

    Parameters
    ----------
    thickness : (E,) m
    cases : load cases, which the combinations know by name
    options : by default the settings at their defaults
    start_modes : (free, c) buckling modes of an earlier, similar state
    """
    options = options or Analysis()
    names = tuple(combinations)
    normal = model.operators.geometry.frame[:, 2]
    surface = surface_loads(normal, thickness, cases, model.self_weight_only)
    forces = nodal_forces(model.operators, surface)
    factors = combination_matrix(combinations, [case.case for case in cases])
    values = assemble_stiffness(model.operators, model.pattern, thickness, material.youngs_modulus)
    try:
        solution = _Solution(model, thickness, material, values, options.solver)
    except NotPositiveDefiniteError:
        return _mechanism(model, names, forces @ factors, values, options.solver)
    first_order_cases = solution.solve(forces)
    first_order = first_order_cases @ factors
    total = forces @ factors
    if not options.second_order:
        return AnalysisResult("ok", "first order only", names, first_order, first_order, total)
    buckling = solution.buckling(first_order_cases, factors, start_modes)
    lowest = int(np.argmin(buckling.factors))
    if buckling.factors[lowest] <= 1:
        reason = f"buckling factor {buckling.factors[lowest]:.4g} of {names[lowest]} is below 1"
        return AnalysisResult("unstable", reason, names, first_order, first_order, total, buckling)
    imperfection = _initial_shape(model, buckling, lowest, total, options.imperfection)
    second = solution.second_order(first_order, options, imperfection)
    displacement = np.zeros_like(first_order)
    displacement[model.pattern.dofs] = second.displacement
    state, reason = _judge(names, second, buckling)
    found = displacement, first_order, total, buckling, second
    return AnalysisResult(state, reason, names, *found, imperfection=imperfection)


def _judge(names, second: SecondOrderResult, buckling: BucklingResult) -> tuple[str, str]:
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


def _initial_shape(model, buckling, column: int, loads, size: float) -> np.ndarray | None:
    """Return the scaled mode of one combination (dofs,), or None for none."""
    if size == 0 or not np.isfinite(buckling.factors[column]):
        return None
    shape = np.zeros(model.mesh.dof_count)
    shape[model.pattern.free] = buckling.modes[:, column]
    moved = shape[: 3 * len(model.mesh.nodes)].reshape(-1, 3)
    sign = -1.0 if shape @ loads[:, column] < 0 else 1.0
    return shape * (sign * size / np.linalg.norm(moved, axis=1).max())


class _Solution:
    """K factorised for one thickness vector, and the three ways in which it is used."""

    def __init__(self, model, thickness, material, values, solver) -> None:
        self._model, self._thickness = model, thickness
        self._modulus = material.youngs_modulus
        self._factor: Factor = factorise(model.pattern, values, solver)
        if is_singular(self._factor.solve, model.pattern, values):
            raise NotPositiveDefiniteError(0)
        self._dofs = model.pattern.dofs

    def solve(self, forces: np.ndarray) -> np.ndarray:
        """Return first-order displacements (dofs, c)."""
        displacement = np.zeros_like(forces)
        displacement[self._dofs] = self._factor.solve(forces[self._dofs])
        return displacement

    def forces(self, displacement: np.ndarray) -> np.ndarray:
        """Return membrane forces (E, 3, m, c) kN/m."""
        return membrane_forces(self._model.operators, displacement, self._thickness, self._modulus)

    def buckling(self, first_order_cases, factors, start) -> BucklingResult:
        """Return the buckling factor and the mode of every combination."""
        # as few geometric stiffnesses as the combinations are independent
        mixing, weights, independent = np.linalg.svd(factors, full_matrices=False)
        rank = int((weights > 1e-12 * weights[0]).sum())
        factors = weights[:rank, None] * independent[:rank]
        forces = self.forces(first_order_cases @ mixing[:, :rank])
        dofs = self._dofs
        multiply = make_geometric_products(self._model.operators, forces, dofs)
        # modes are kept in ascending order of freedoms, the factor works in its own
        place = np.argsort(dofs)
        if start is not None:
            own = np.empty_like(start, dtype=float)
            own[place] = start
            start = own
        found = find_buckling_factors(self._factor.solve, multiply, factors, len(dofs), start)
        return replace(found, modes=found.modes[place])

    def second_order(
        self, first_order: np.ndarray, options: Analysis, imperfection: np.ndarray | None
    ) -> SecondOrderResult:
        """Return second-order displacements, from an imperfect shape where there is one."""
        dofs, operators = self._dofs, self._model.operators

        def correction(displacement: np.ndarray, _columns: np.ndarray) -> np.ndarray:
            """Return -K^-1 K_g(N(u)) u of displacements u (free, k), m and rad."""
            full = np.zeros((len(first_order), displacement.shape[1]))
            full[dofs] = displacement
            shape = full if imperfection is None else full + imperfection[:, None]
            force = apply_geometric(operators, self.forces(full), shape)
            return -self._factor.solve(force[dofs])

        return solve_second_order(
            first_order[dofs],
            correction,
            options.second_order_tolerance,
            options.second_order_iterations_max,
        )


def _mechanism(model, names, loads, values, solver) -> AnalysisResult:
    """Report where the stiffness gives way, and no numbers."""
    nothing = np.full(loads.shape, np.nan)
    reason, node = "the stiffness matrix is not positive definite", None
    vector = find_near_null_vector(model.pattern, values, solver)
    if vector is not None:
        full = np.zeros(model.mesh.dof_count)
        full[model.pattern.dofs] = vector
        moved = np.linalg.norm(full[: 3 * len(model.mesh.nodes)].reshape(-1, 3), axis=1)
        node = int(moved.argmax())
        x, y, z = model.mesh.nodes[node]
        reason += f": a mechanism moves most at node {node}, ({x:.3f}, {y:.3f}, {z:.3f}) m"
    return AnalysisResult("mechanism", reason, names, nothing, nothing, loads, mechanism_node=node)
