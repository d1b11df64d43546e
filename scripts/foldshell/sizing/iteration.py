"""One iteration of the sizing loop: analyse, judge, and gather what its files hold."""

import time
from dataclasses import dataclass, replace

import numpy as np

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
from foldshell.shell.analysis import ShellModel, analyse_shell
from foldshell.shell.placed_loads import PlacedLoads
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


@dataclass(frozen=True)
class IterationTask:
    """What one analysis of the loop works on; `thickness` (P,) m, `previous` what the analysis
    before found (None for the first), `edited_panels` those that a person has changed (None where
    nobody has touched the workbook)."""

    iteration: int
    span: float
    thickness: np.ndarray
    previous: AnalysisRecord | None = None
    previous_arrays: AnalysisArrays | None = None
    edited_panels: tuple[int, ...] | None = None

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

    def run(
        self, task: IterationTask, alone: bool = False
    ) -> tuple[AnalysisRecord, AnalysisArrays]:
        """Analyse one thickness vector: what analysis.json and analysis.npz hold.

        The last analysis of a loop, and one that stands `alone`, says what its model does not hold.
        With `factor_min` the arrays of an analysis after which the loop goes on hold the linearised
        constraints.
        """
        began = time.perf_counter()
        done = _analyse(self, task)
        record, arrays = _describe(done), collect_arrays(done)
        if done.utilization is not None:
            record = describe_edge_beam(done, describe_sheet(done, record))
        if alone or not record.goes_on:
            record = replace(record, model_warnings=find_warnings(done))
        if alone or not record.goes_on:
            arrays = add_final_fields(done, arrays)
        elif self.factor_min is not None and done.result.state == "ok":
            arrays = _add_constraints(done, self.factor_min, arrays)
        return replace(record, seconds=time.perf_counter() - began), arrays


def _analyse(case: AnalysisCase, task: IterationTask) -> Analysed:
    model, material, groups = case.model, case.material, case.combinations
    thickness = model.to_elements(task.thickness)
    modes = task.previous_arrays.buckling_modes if task.previous_arrays else None
    result = analyse_shell(model, thickness, material, case.placed, groups.all, case.options, modes)
    done = Analysed(case, task, thickness, result)
    if result.state not in ("ok", "not_converged"):
        return done
    strength = result.displacement[:, : len(groups.strength)]
    found = model, strength, thickness, material
    utilization = compute_utilization(*found, result.imposed)
    stress = StressState(*found, utilization, case.strips, result.imposed)
    panels, edge_beam_panels = {}, {}
    for name in dict.fromkeys([*ALWAYS, case.sizing.measure]):
        values = MEASURES[name].panels(stress)
        panels[name], edge_beam_panels[name] = np.split(values, [model.sized_panels])
    return replace(done, stress=stress, panels=panels, edge_beam_panels=edge_beam_panels)


def _describe(done: Analysed) -> AnalysisRecord:
    """Return what every analysis says of itself, whatever its state."""
    model, task, result = done.case.model, done.task, done.result
    sized, fixed = split_area(model)
    volume = float(sized @ task.thickness) + float(fixed @ model.fixed_thickness)
    verdict = _judge(done, volume)
    return AnalysisRecord(
        iteration=task.iteration,
        state=result.state,
        volume_m3=volume,
        area_m2=float(sized.sum()),
        buckling_factor=list_factors(result),
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
