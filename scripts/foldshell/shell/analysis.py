"""The shell analysis of one thickness vector: what Karamba did in the paper's loop."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from foldshell.files.threads import LARGE
from foldshell.loads.cases import SurfaceLoad, combination_matrix
from foldshell.settings.analysis import Analysis
from foldshell.settings.field import Factors
from foldshell.settings.material import Material
from foldshell.shell.assembly import LowerPattern, assemble_stiffness, find_pattern
from foldshell.shell.boundary import find_acting
from foldshell.shell.buckling import BucklingResult
from foldshell.shell.effort import FULL, USUAL, Effort
from foldshell.shell.linear_solver import NotPositiveDefiniteError
from foldshell.shell.mesh import ShellMesh, translation_dofs
from foldshell.shell.nodal_loads import nodal_forces
from foldshell.shell.placed_loads import PlacedLoads, place_loads
from foldshell.shell.solution import (
    AnalysisResult,
    Riders,
    Solution,
    State,
    describe_mechanism,
    initial_shape,
    judge_state,
    settle,
)
from foldshell.shell.stiffness import ShellOperators, build_operators, restrict_operators


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

    @cached_property
    def beside_supports(self) -> tuple[np.ndarray, ShellOperators]:
        """The elements (k,) that touch a supported node, and the operators of these alone.

        As numbers.
        """
        held = np.zeros(len(self.mesh.nodes), dtype=bool)
        held[self.supported_nodes] = True
        chosen = np.flatnonzero(held[self.mesh.elements].any(axis=1))
        return chosen, restrict_operators(self.operators, chosen)

    def to_elements(self, thickness: np.ndarray) -> np.ndarray:
        """Return the thickness of each element (E,) from that of the sized panels (P,), m."""
        return np.concatenate([thickness, self.fixed_thickness])[self.mesh.panel]


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
    effort: Effort = USUAL,
) -> AnalysisResult:
    """Factorise K once; first order, buckling factors and second order of all combinations.

    Parameters
    ----------
    thickness : (E,) m
    cases : load cases, which the combinations know by name, or these as `place_on_model` left them
    options : by default the settings at their defaults
    start_modes : (free, c) buckling modes of an earlier, similar state
    effort : how well factors and second order are to be known
    """
    analysis = ShellAnalysis(model, thickness, material, cases, combinations, options)
    return analysis.run(effort, start_modes)


class ShellAnalysis:
    """A shell of one thickness vector whose stiffness is factorised once, for analyses of it.

    Parameters are those of `analyse_shell`.
    """

    def __init__(self, model, thickness, material, cases, combinations: Factors, options=None):
        self._model, self._options = model, options or Analysis()
        placed = cases if isinstance(cases, PlacedLoads) else place_on_model(model, cases)
        forces = nodal_forces(model.operators, placed.at(thickness))
        self._factors = combination_matrix(combinations, placed.names)
        self._strains = placed.strains(thickness, material.thermal_expansion)
        self._moved = settle(model, placed)
        self._names, self._loads = tuple(combinations), forces @ self._factors
        self._stiffness = model.operators, model.pattern, thickness, material.youngs_modulus
        self._checked = False
        try:
            values, solver = assemble_stiffness(*self._stiffness), self._options.solver
            self._solution = Solution(model, thickness, material, values, solver)
        except NotPositiveDefiniteError:
            self._solution = None
            return
        self._by_case = self._solution.solve(forces, self._strains, self._moved)
        self._first_order = self._by_case @ self._factors
        self._search = self._bending = self._riders = None

    def run(
        self,
        effort: Effort,
        start_modes: np.ndarray | None = None,
        start: np.ndarray | None = None,
    ) -> AnalysisResult:
        """Return first order, buckling factors and second order of all combinations.

        Another run with more effort goes on where the one before ended; none is due after `FULL`.
        start_modes (free, c) are buckling modes of an earlier, similar state, without unit; `start`
        (dofs, c) m and rad are displacements with which second order begins.
        """
        if self._is_mechanism(effort):
            return self._report_mechanism()
        if not self._options.second_order:
            return self._report_first_order()
        found = self._buckle(effort, start_modes, start is None and not self._options.imperfection)
        return self.bend(found, effort, start)

    @property
    def first_order(self) -> np.ndarray | None:
        """Displacements (dofs, c) of first order, None of a mechanism. m and rad."""
        return None if self._solution is None else self._first_order

    def _buckle(
        self, effort: Effort, start_modes: np.ndarray | None, perfect: bool
    ) -> BucklingResult:
        """Search for buckling, or go on; the first correction of second order rides along where
        that begins with the `perfect` state of first order.

        Of a large mesh the vectors of the search take more memory than a new search takes time: the
        next run begins one from the modes that it is given.
        """
        search = self._search
        if search is None:
            if perfect and self._bending is None:
                self._riders = Riders(self._solution.push(*self._perfect_state()))
            state = self._by_case, self._strains, self._factors
            search = self._solution.search_buckling(*state, self._riders)
        large = len(self._model.pattern.dofs) >= LARGE
        self._search = None if effort is FULL or large else search
        return search.run(effort, start_modes)

    def _perfect_state(self) -> tuple[np.ndarray, State, np.ndarray]:
        """Return first-order displacements (free, c), the state that they are of, all columns."""
        free = self._first_order[self._model.pattern.dofs]
        return free, self._state(None), np.arange(free.shape[1])

    def _state(self, imperfection: np.ndarray | None) -> State:
        settled = None if self._moved is None else self._moved @ self._factors
        imposed = None if self._strains is None else self._strains @ self._factors
        return State(imperfection, imposed, settled)

    def bend(
        self, buckling: BucklingResult, effort: Effort, start: np.ndarray | None = None
    ) -> AnalysisResult:
        """Return the result of second order, if the state of first order is stable.

        start (dofs, c) are displacements to begin with, m and rad, by default those of first order.
        """
        model, options, names = self._model, self._options, self._names
        basic = replace(self._report_first_order(), buckling=buckling)
        lowest = int(np.argmin(buckling.factors))
        if buckling.factors[lowest] <= 1:
            reason = f"buckling factor {buckling.factors[lowest]:.4g} of {names[lowest]} is below 1"
            return replace(basic, state="unstable", reason=reason)
        imperfection = initial_shape(model, buckling, lowest, self._loads, options.imperfection)
        state = self._state(imperfection)
        if self._bending is None or imperfection is not None or start is not None:
            known = basic.first_order, state, self._riders, start
            self._bending = self._solution.search_second_order(*known)
        rough = effort.second_order_tolerance > options.second_order_tolerance
        second = self._bending.run(
            effort.second_order_tolerance if rough else options.second_order_tolerance,
            options.second_order_iterations_max, 1 / buckling.factors if rough else None,
        )  # fmt: skip
        displacement = np.zeros_like(basic.first_order)
        if state.settled is not None:
            displacement = state.settled.copy()
        displacement[model.pattern.dofs] = second.displacement
        verdict, reason = judge_state(names, second, buckling)
        return replace(
            basic, state=verdict, reason=reason, displacement=displacement, second_order=second,
            imperfection=imperfection,
        )  # fmt: skip

    def _report_first_order(self) -> AnalysisResult:
        return AnalysisResult(
            "ok", "first order only", self._names, self._first_order, self._first_order,
            self._loads, imposed=self._state(None).imposed,
        )  # fmt: skip

    def _is_mechanism(self, effort: Effort) -> bool:
        if self._solution is not None and effort.check_mechanism and not self._checked:
            if self._solution.is_singular:
                self._solution = None
            self._checked = True
        return self._solution is None

    def _report_mechanism(self) -> AnalysisResult:
        """Report where the stiffness gives way, and no numbers."""
        nothing = np.full(self._loads.shape, np.nan)
        values = assemble_stiffness(*self._stiffness)
        reason, node = describe_mechanism(self._model, values, self._options.solver)
        empty = self._names, nothing, nothing, self._loads
        return AnalysisResult("mechanism", reason, *empty, mechanism_node=node)


def place_on_model(model: ShellModel, cases: Sequence[SurfaceLoad]) -> PlacedLoads:
    """Place load cases on a model, for analyses of any thickness; raises `ValueError`."""

    def held() -> np.ndarray:
        """Return which translations (N, 3) are held."""
        free = np.isin(np.arange(3 * len(model.mesh.nodes)), model.pattern.dofs)
        return ~free.reshape(-1, 3)

    return place_loads(model.operators, model.self_weight_only, cases, held)
