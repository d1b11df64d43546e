"""The shell analysis of one thickness vector: what Karamba did in the paper's loop."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from foldshell.loads.cases import SurfaceLoad, combination_matrix
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
from foldshell.shell.buckling import BucklingResult
from foldshell.shell.linear_solver import NotPositiveDefiniteError
from foldshell.shell.mesh import ShellMesh
from foldshell.shell.near_null import find_near_null_vector
from foldshell.shell.nodal_loads import nodal_forces
from foldshell.shell.placed_loads import PlacedLoads, place_loads
from foldshell.shell.second_order import SecondOrderResult
from foldshell.shell.solution import Solution, State
from foldshell.shell.stiffness import ShellOperators, build_operators


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
    cases: Sequence[SurfaceLoad] | PlacedLoads,
    combinations: Factors,
    options: Analysis | None = None,
    start_modes: np.ndarray | None = None,
) -> AnalysisResult:
    """Factorise K once; first order, buckling factors and second order of all combinations.

    Parameters
    ----------
    thickness : (E,) m
    cases : load cases, which the combinations know by name, or these as `place_on_model` left them
    options : by default the settings at their defaults
    start_modes : (free, c) buckling modes of an earlier, similar state
    """
    options, names = options or Analysis(), tuple(combinations)
    placed = cases if isinstance(cases, PlacedLoads) else place_on_model(model, cases)
    forces = nodal_forces(model.operators, placed.at(thickness))
    factors = combination_matrix(combinations, placed.names)
    strains = placed.strains(thickness, material.thermal_expansion)
    moved = _settle(model, placed)
    values = assemble_stiffness(model.operators, model.pattern, thickness, material.youngs_modulus)
    try:
        solution = Solution(model, thickness, material, values, options.solver)
    except NotPositiveDefiniteError:
        return _mechanism(model, names, forces @ factors, values, options.solver)
    by_case = solution.solve(forces, strains, moved)
    basic = AnalysisResult(
        "ok", "first order only", names, by_case @ factors, by_case @ factors, forces @ factors,
        imposed=None if strains is None else strains @ factors,
    )  # fmt: skip
    if not options.second_order:
        return basic
    buckling = solution.buckling(by_case, strains, factors, start_modes)
    settled = None if moved is None else moved @ factors
    return _go_on(solution, replace(basic, buckling=buckling), options, settled)


def place_on_model(model: ShellModel, cases: Sequence[SurfaceLoad]) -> PlacedLoads:
    """Place load cases on a model, for analyses of any thickness; raises `ValueError`."""

    def held() -> np.ndarray:
        """Return which translations (N, 3) are held."""
        free = np.isin(np.arange(3 * len(model.mesh.nodes)), model.pattern.dofs)
        return ~free.reshape(-1, 3)

    return place_loads(model.operators, model.self_weight_only, cases, held)


def _settle(model: ShellModel, placed: PlacedLoads) -> np.ndarray | None:
    """Return the displacements of supports as fields (dofs, C), or None."""
    if placed.settled is None:
        return None
    moved = np.zeros((model.mesh.dof_count, len(placed.names)))
    moved[: 3 * len(model.mesh.nodes)] = placed.settled.reshape(-1, len(placed.names))
    return moved


def _go_on(
    solution: Solution, basic: AnalysisResult, options: Analysis, settled: np.ndarray | None
) -> AnalysisResult:
    """Go on to second order from the state of first order, if it is stable."""
    model, buckling, names = solution.model, basic.buckling, basic.names
    lowest = int(np.argmin(buckling.factors))
    if buckling.factors[lowest] <= 1:
        reason = f"buckling factor {buckling.factors[lowest]:.4g} of {names[lowest]} is below 1"
        return replace(basic, state="unstable", reason=reason)
    imperfection = _initial_shape(model, buckling, lowest, basic.loads, options.imperfection)
    state = State(imperfection, basic.imposed, settled)
    second = solution.second_order(basic.first_order, options, state)
    displacement = np.zeros_like(basic.first_order) if settled is None else settled.copy()
    displacement[model.pattern.dofs] = second.displacement
    verdict, reason = _judge(names, second, buckling)
    return replace(
        basic, state=verdict, reason=reason, displacement=displacement, second_order=second,
        imperfection=imperfection,
    )  # fmt: skip


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
