"""One iteration of the sizing loop: analyse, judge, and gather what its files hold."""

import time
from dataclasses import dataclass, replace

import numpy as np

from foldshell.checks.concrete.model import ConcreteModel
from foldshell.checks.measures import ALWAYS, MEASURES, StressState
from foldshell.checks.strips import Strips
from foldshell.checks.utilization import compute_utilization
from foldshell.loads.cases import SurfaceLoad, combination_matrix
from foldshell.records.analysis import AnalysisRecord
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.settings.analysis import Analysis
from foldshell.settings.loads import Combinations
from foldshell.settings.material import Material
from foldshell.settings.sizing import Sizing
from foldshell.shell.analysis import AnalysisResult, ShellAnalysis, ShellModel
from foldshell.shell.effort import FULL, START, USUAL, Effort
from foldshell.shell.placed_loads import PlacedLoads
from foldshell.sizing.accuracy import (
    bound_hidden_factor,
    choose_effort,
    is_doubtful,
    is_factor_close,
    is_state_close,
)
from foldshell.sizing.criteria import IterationState, Verdict, judge_iteration
from foldshell.sizing.describe import (
    Analysed,
    add_final_fields,
    collect_arrays,
    describe_edge_beam,
    describe_sheet,
    largest_residual,
    list_factors,
    split_area,
)
from foldshell.sizing.linearise import linearise_constraints
from foldshell.sizing.model_check import find_warnings
from foldshell.sizing.panel_limits import PanelLimits


@dataclass(frozen=True)
class IterationTask:
    """What one analysis of the loop works on; `thickness` (P,) m, `previous` what the analysis
    before found (None for the first), `edited_panels` those that a person has changed (None where
    nobody has touched the workbook), `limits` what that person asks of panels."""

    iteration: int
    span: float
    thickness: np.ndarray
    previous: AnalysisRecord | None = None
    previous_arrays: AnalysisArrays | None = None
    edited_panels: tuple[int, ...] | None = None
    limits: PanelLimits | None = None

    @property
    def modes(self) -> np.ndarray | None:
        """Buckling modes (free, c) of the analysis before, None without any. Without unit."""
        return self.previous_arrays.buckling_modes if self.previous_arrays else None

    @property
    def counted_from(self) -> int:
        """Iteration from which the allowed ones count: a change by a person starts a new count."""
        if self.edited_panels:
            return self.iteration
        return self.previous.counted_from if self.previous else 0


@dataclass(frozen=True)
class AnalysisCase:
    """A design ready for any thickness; `factor_min`, the buckling factor to keep, is None where no
    constraints are asked for, `strips` where the measure needs none; `notes` are what is to be said
    of its supports; `placed` are the loads of `cases` on the mesh."""

    model: ShellModel
    material: Material
    cases: tuple[SurfaceLoad, ...]
    combinations: Combinations
    options: Analysis
    sizing: Sizing
    factor_min: float | None
    notes: tuple[str, ...] = ()
    placed: PlacedLoads | None = None
    strips: Strips | None = None
    concrete: ConcreteModel | None = None

    def run(
        self, task: IterationTask, alone: bool = False, effort: Effort = FULL
    ) -> tuple[AnalysisRecord, AnalysisArrays]:
        """Analyse one thickness vector: what analysis.json and analysis.npz hold.

        The last analysis of a loop, and one that stands `alone`, says what its model does not hold.
        With `factor_min` the arrays of an analysis after which the loop goes on hold the linearised
        constraints.
        """
        began = time.perf_counter()
        result = prepare_analysis(self, task).run(effort, task.modes)
        return _report(evaluate(self, task, result, effort), began, alone)

    def run_in_loop(self, task: IterationTask) -> tuple[AnalysisRecord, AnalysisArrays]:
        """The same with no more effort than the next step needs; all of it where the loop ends."""
        began = time.perf_counter()
        return _report(_analyse_in_loop(self, task), began)


def _report(done: Analysed, began: float, alone: bool = False):
    record, arrays = _describe(done), collect_arrays(done)
    if done.utilization is not None:
        record = describe_edge_beam(done, describe_sheet(done, record))
    if alone or not record.goes_on:
        record = replace(record, model_warnings=find_warnings(done))
        arrays = add_final_fields(done, arrays)
    elif done.case.factor_min is not None and done.result.state == "ok":
        arrays = _add_constraints(done, done.case.factor_min, arrays)
    return replace(record, seconds=time.perf_counter() - began), arrays


def _analyse_in_loop(case: AnalysisCase, task: IterationTask) -> Analysed:
    """Analyse with little effort first, then with as much as its verdict and next step need."""
    sizing, analysis = case.sizing, prepare_analysis(case, task)
    modes, edited = task.modes, bool(task.edited_panels)
    effort = choose_effort(sizing, task.thickness, task.previous, task.previous_arrays, edited)
    if case.options.imperfection:
        effort = FULL  # a mode is part of the shape, and its digits are in every utilization
    result = analysis.run(effort, modes)
    careful = replace(START, second_order_tolerance=effort.second_order_tolerance)
    if effort not in (careful, USUAL, FULL) and is_doubtful(sizing, result.least_factor):
        effort = careful
        result = analysis.run(effort, result.buckling.modes)
    done = evaluate(case, task, result, effort)
    if effort is FULL or (effort is USUAL and _goes_on(done)):
        return done
    rough = effort.second_order_tolerance > 0 and done.utilization is not None
    if rough and _is_close(done) and _goes_on(done):
        effort, buckling = replace(effort, second_order_tolerance=0.0), result.buckling
        del done, result  # large states: there is room for one
        result = analysis.bend(buckling, effort)
        done = evaluate(case, task, result, effort)
    if not _goes_on(done) or is_factor_close(sizing, result.least_factor):
        found = result.buckling.modes if result.buckling else modes
        done = evaluate(case, task, analysis.run(FULL, found), FULL)
    return done


def _is_close(done: Analysed) -> bool:
    sizing = done.case.sizing
    own = [part[sizing.measure] for part in (done.panels, done.edge_beam_panels)]
    return is_state_close(sizing, np.concatenate(own), done.downward[0], done.task.span)


def _goes_on(done: Analysed) -> bool:
    return done.result.state == "ok" and _judge(done, _volume(done)).verdict == "continue"


def prepare_analysis(case: AnalysisCase, task: IterationTask) -> ShellAnalysis:
    """Factorise the stiffness of a thickness vector."""
    thickness, groups = case.model.to_elements(task.thickness), case.combinations.all
    return ShellAnalysis(case.model, thickness, case.material, case.placed, groups, case.options)


def evaluate(
    case: AnalysisCase, task: IterationTask, result: AnalysisResult, effort: Effort
) -> Analysed:
    """Add the utilization of points, cells and panels to the result of an analysis."""
    model, material, groups = case.model, case.material, case.combinations
    thickness = model.to_elements(task.thickness)
    done = Analysed(case, task, thickness, result, random_vectors=effort.random_vectors > 0)
    if result.state not in ("ok", "not_converged"):
        return done
    strength = result.displacement[:, : len(groups.strength)]
    found = model, strength, thickness, material
    utilization = compute_utilization(*found, result.imposed)
    stress = StressState(*found, utilization, case.strips, result.imposed, case.concrete)
    panels, edge_beam_panels = {}, {}
    for name in dict.fromkeys([*ALWAYS, case.sizing.measure]):
        values = MEASURES[name].panels(stress)
        panels[name], edge_beam_panels[name] = np.split(values, [model.sized_panels])
    return replace(done, stress=stress, panels=panels, edge_beam_panels=edge_beam_panels)


def _volume(done: Analysed) -> float:
    sized, fixed = split_area(done.case.model)
    return float(sized @ done.task.thickness) + float(fixed @ done.case.model.fixed_thickness)


def _describe(done: Analysed) -> AnalysisRecord:
    """Return what every analysis says of itself, whatever its state."""
    model, task, result = done.case.model, done.task, done.result
    volume = _volume(done)
    verdict = _judge(done, volume)
    return AnalysisRecord(
        iteration=task.iteration,
        state=result.state,
        volume_m3=volume,
        area_m2=float(split_area(model)[0].sum()),
        buckling_factor=list_factors(result),
        buckling_factor_bound=_bound_factor(done),
        second_order_iterations=result.second_order.iterations if result.second_order else 0,
        second_order_residual=largest_residual(result),
        dofs=model.pattern.size,
        mesh_subdivisions=model.mesh.subdivisions,
        element_order=model.mesh.order,
        verdict=verdict.verdict,
        reason=verdict.reason,
        criteria=verdict.criteria,
        stationary_iterations=verdict.stationary_iterations,
        edited=task.edited_panels is not None,
        edited_panels=task.edited_panels,
        counted_from=task.counted_from,
    )


def _bound_factor(done: Analysed) -> float | None:
    """Return what every factor is known to be above: what random vectors found, or less."""
    task, factor = done.task, done.result.least_factor
    if factor is None or not np.isfinite(factor):
        return None
    if done.random_vectors:
        return factor
    return min(
        factor, bound_hidden_factor(task.previous, task.thickness, task.previous_arrays.thickness)
    )


def _judge(done: Analysed, volume: float) -> Verdict:
    task, result, sizing = done.task, done.result, done.case.sizing
    before, arrays = task.previous, task.previous_arrays
    edge_beam = done.edge_beam_panels.get(sizing.measure, np.empty(0))
    return judge_iteration(
        IterationState(
            iteration=task.iteration,
            state=result.state,
            reason=result.reason,
            thickness=task.thickness,
            utilization=done.panels.get(sizing.measure),
            displacement=np.nan if done.utilization is None else done.downward[0],
            span=task.span,
            volume=volume,
            previous_volume=before.volume_m3 if before else None,
            previous_thickness=arrays.thickness if arrays else None,
            previous_stationary=before.stationary_iterations if before else 0,
            edge_beam=float(edge_beam.max()) if len(edge_beam) else None,
            buckling_factor=result.buckling and float(result.buckling.factors.min()),
            counted_from=task.counted_from,
            limits=task.limits,
        ),
        sizing,
    )


def _add_constraints(done: Analysed, factor_min: float, arrays: AnalysisArrays) -> AnalysisArrays:
    case = done.case
    factors = combination_matrix(case.combinations.all, case.placed.names)
    found = linearise_constraints(
        done.result, done.stress, case.placed.weight @ factors,
        case.sizing, done.task.span, factor_min,
    )  # fmt: skip
    return replace(
        arrays,
        constraint_value=found.value,
        constraint_gradient=found.gradient,
        panel_area=found.area,
        thinning_steps=found.thinning,
    )
