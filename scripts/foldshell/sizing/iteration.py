"""One iteration of the sizing loop: analyse, judge, and gather what its files hold."""

import time
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from foldshell.checks.utilization import (
    Utilization,
    area_percentile,
    compute_utilization,
    panel_utilization,
)
from foldshell.loads.cases import SurfaceLoad, combination_matrix
from foldshell.settings.analysis import Analysis
from foldshell.settings.field import list_settings
from foldshell.settings.loads import Combinations
from foldshell.settings.material import Material
from foldshell.settings.sizing import Sizing
from foldshell.shell.analysis import AnalysisResult, ShellModel, analyse_shell
from foldshell.shell.results import (
    largest_downward,
    panel_area,
    panels_beside_edge_beam,
    reaction_imbalance,
    support_reactions,
    translations,
)
from foldshell.sizing.criteria import IterationState, Verdict, judge_iteration
from foldshell.sizing.linearise import linearise_constraints

MEASURES = list_settings(Sizing)["measure"].choices
"""Utilization of a panel: area mean over its cells, or its largest cell; see
`panel_utilization`."""


@dataclass(frozen=True)
class IterationTask:
    """What one analysis of the loop works on; `thickness` (P,) m, `previous` as in analysis.json
    and analysis.npz of the iteration before (empty for the first)."""

    iteration: int
    span: float
    thickness: np.ndarray
    previous: Mapping[str, Any]
    previous_arrays: Mapping[str, np.ndarray]


@dataclass(frozen=True)
class AnalysisCase:
    """A design ready for any thickness; `factor_min`, the buckling factor to keep, is None where no
    constraints are asked for."""

    model: ShellModel
    material: Material
    cases: tuple[SurfaceLoad, ...]
    combinations: Combinations
    options: Analysis
    sizing: Sizing
    factor_min: float | None

    def run(self, task: IterationTask) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
        """Analyse one thickness vector: contents of analysis.json and analysis.npz.

        With `factor_min` the arrays of an analysis after which the loop goes on hold the linearised
        constraints.
        """
        began = time.perf_counter()
        done = _analyse(self, task)
        report, arrays = _describe(done)
        verdict = _judge(done, report["volume_m3"])
        report |= {
            "verdict": verdict.verdict,
            "reason": verdict.reason,
            "criteria": verdict.criteria,
            "stationary_iterations": verdict.stationary_iterations,
        }
        if done.utilization is not None:
            for more, fields in (_describe_sheet(done), _describe_edge_beam(done)):
                report |= more
                arrays |= fields
        if verdict.verdict != "continue":
            arrays |= _final_fields(done)
        elif self.factor_min is not None and done.result.state == "ok":
            arrays |= _linearise(done, self.factor_min)
        report["seconds"] = time.perf_counter() - began
        return report, arrays


@dataclass(frozen=True)
class _Analysed:
    """What the report of an analysis is made of; `thickness` is that of elements, (E,) m.

    `panels` and `edge_beam_panels` hold the utilization of the sized panels (P,) and of an edge
    beam (B,) by measure. They are empty, and `utilization` is None, where the analysis left no
    displacements to rely on.
    """

    case: AnalysisCase
    task: IterationTask
    thickness: np.ndarray
    result: AnalysisResult
    utilization: Utilization | None = None
    panels: Mapping[str, np.ndarray] = field(default_factory=dict)
    edge_beam_panels: Mapping[str, np.ndarray] = field(default_factory=dict)

    @property
    def downward(self) -> tuple[float, int, str]:
        """Largest downward displacement (m) of the deflection combinations, node, combination."""
        groups = self.case.combinations
        deflection = self.result.displacement[:, len(groups.strength) :]
        return largest_downward(self.case.model, deflection, list(groups.deflection))


def _analyse(case: AnalysisCase, task: IterationTask) -> _Analysed:
    model, material, groups = case.model, case.material, case.combinations
    thickness = model.to_elements(task.thickness)
    modes = task.previous_arrays.get("buckling_modes")
    result = analyse_shell(model, thickness, material, case.cases, groups.all, case.options, modes)
    done = _Analysed(case, task, thickness, result)
    if result.state not in ("ok", "not_converged"):
        return done
    strength = result.displacement[:, : len(groups.strength)]
    utilization = compute_utilization(model, strength, thickness, material)
    panels, edge_beam_panels = {}, {}
    for name in MEASURES:
        values = panel_utilization(model, utilization.cell, name)
        panels[name], edge_beam_panels[name] = np.split(values, [model.sized_panels])
    return replace(done, utilization=utilization, panels=panels, edge_beam_panels=edge_beam_panels)


def _describe(done: _Analysed) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Return what every analysis says of itself, whatever its state."""
    model, task, result = done.case.model, done.task, done.result
    sized, fixed = _split_area(model)
    report = {
        "iteration": task.iteration,
        "state": result.state,
        "volume_m3": float(sized @ task.thickness) + float(fixed @ model.fixed_thickness),
        "area_m2": float(sized.sum()),
        "buckling_factor": _factors(result),
        "second_order_iterations": result.second_order.iterations if result.second_order else 0,
        "second_order_residual": _largest_residual(result),
        "dofs": model.pattern.size,
        "mesh_subdivisions": model.mesh.subdivisions,
        "element_order": model.mesh.order,
    }
    arrays = {"thickness": task.thickness}
    if result.buckling is not None:
        arrays["buckling_modes"] = result.buckling.modes.astype(np.float32)
    return report, arrays


def _split_area(model: ShellModel) -> list[np.ndarray]:
    """Return the areas of the sized panels (P,) and of the edge beam's (B,), m2."""
    return np.split(panel_area(model), [model.sized_panels])


def _factors(result: AnalysisResult) -> dict[str, float | None]:
    if result.buckling is None:
        return {name: None for name in result.names}
    values = result.buckling.factors
    return {
        name: float(value) if np.isfinite(value) else None
        for name, value in zip(result.names, values, strict=True)
    }


def _largest_residual(result: AnalysisResult) -> float | None:
    return float(result.second_order.residual.max()) if result.second_order else None


def _judge(done: _Analysed, volume: float) -> Verdict:
    task, result, sizing = done.task, done.result, done.case.sizing
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
            previous_volume=task.previous.get("volume_m3"),
            previous_thickness=task.previous_arrays.get("thickness"),
            previous_stationary=task.previous.get("stationary_iterations", 0),
            edge_beam=float(edge_beam.max()) if len(edge_beam) else None,
        ),
        sizing,
    )


def _describe_sheet(done: _Analysed) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Return utilization of the sheet, displacement and reactions."""
    model, sizing, thickness = done.case.model, done.case.sizing, done.task.thickness
    down, node, combination = done.downward
    reactions = support_reactions(model, done.result, done.thickness, done.case.material)
    sums = reactions.sum(axis=0).T.tolist()
    sheet = slice(0, int((~model.self_weight_only).sum()))
    area, cell = model.operators.geometry.area[sheet], done.utilization.cell[sheet]
    least, largest = sizing.least_thickness, sizing.largest_thickness
    at_bound = (thickness <= least) | (thickness >= largest)
    report = {
        "utilization_max": float(cell.max()),
        "utilization_p99": area_percentile(model, done.utilization.point[sheet]),
        "utilization_mean": float(area @ cell.mean(axis=1) / area.sum()),
        "utilization_panel_mean_max": float(done.panels["panel_mean"].max()),
        "displacement_vertical_max_m": down,
        "displacement_combination": combination,
        "displacement_place_m": model.mesh.nodes[node].tolist(),
        "reaction_sum_kn": dict(zip(done.result.names, sums, strict=True)),
        "reaction_imbalance": reaction_imbalance(model, done.result, reactions),
        "panels_at_bound": int(at_bound.sum()),
        "panels_above_one": int((done.panels[sizing.measure] > sizing.utilization_max).sum()),
    }
    return report, {f"utilization_{name}": values for name, values in done.panels.items()}


def _describe_edge_beam(done: _Analysed) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Return volume and utilization of the edge beam's panels, and the panels that they
    hang from; nothing where there is no edge beam."""
    model = done.case.model
    if not len(model.fixed_thickness):
        return {}, {}
    report = {
        "edge_beam_volume_m3": float(_split_area(model)[1] @ model.fixed_thickness),
        "edge_beam_utilization_max": float(done.utilization.cell[model.self_weight_only].max()),
        "edge_beam_utilization_panel_mean_max": float(done.edge_beam_panels["panel_mean"].max()),
    }
    arrays = {
        f"edge_beam_utilization_{name}": values for name, values in done.edge_beam_panels.items()
    }
    return report, arrays | {"edge_beam_panel": panels_beside_edge_beam(model)}


def _linearise(done: _Analysed, factor_min: float) -> dict[str, np.ndarray]:
    case = done.case
    factors = combination_matrix(case.combinations.all, [one.case for one in case.cases])
    return linearise_constraints(
        case.model, done.result, done.thickness, case.material, factors, done.utilization,
        case.sizing, done.task.span, factor_min,
    ).to_arrays()  # fmt: skip


def _final_fields(done: _Analysed) -> dict[str, np.ndarray]:
    """Return the fields that pictures and exports of the last state need."""
    fields = {"displacement": done.result.displacement}
    if done.utilization is not None:
        fields["utilization_cell"] = done.utilization.cell
        fields["governing_combination"] = done.utilization.governing
        fields["translations"] = translations(done.case.model, done.result.displacement)
    return fields
