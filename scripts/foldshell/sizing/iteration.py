"""One iteration of the sizing loop: analyse, judge, and gather what its files hold."""

import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from foldshell.shell.analysis import AnalysisOptions, AnalysisResult, ShellModel, analyse_shell
from foldshell.shell.loads import Loads, combination_matrix
from foldshell.shell.material import Material
from foldshell.shell.results import (
    Utilization,
    area_percentile,
    compute_utilization,
    largest_downward,
    panel_area,
    panel_utilization,
    panels_beside_strips,
    reaction_imbalance,
    support_reactions,
    translations,
)
from foldshell.sizing.criteria import IterationState, StopRule, Verdict, judge_iteration
from foldshell.sizing.linearise import linearise_constraints


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
class LoadPlan:
    """Loads, and combinations of the two groups by name."""

    loads: Loads
    strength: Mapping[str, Mapping[str, float]]
    deflection: Mapping[str, Mapping[str, float]]

    @property
    def combinations(self) -> dict[str, Mapping[str, float]]:
        """All combinations, strength first."""
        return {**self.strength, **self.deflection}


def run_iteration(
    model: ShellModel,
    task: IterationTask,
    material: Material,
    plan: LoadPlan,
    options: AnalysisOptions,
    rule: StopRule,
    factor_min: float | None = None,
) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Return the contents of analysis.json and analysis.npz.

    With `factor_min`, the buckling factor to keep, the arrays of an analysis after which the loop
    goes on hold the linearised constraints.
    """
    began = time.perf_counter()
    thickness = model.spread(task.thickness)
    modes = task.previous_arrays.get("buckling_modes")
    result = analyse_shell(
        model, thickness, material, plan.loads, plan.combinations, options, modes
    )
    report, arrays = _describe(model, task, result)
    usable = result.state in ("ok", "not_converged")
    utilization = _utilization(model, result, thickness, material, plan) if usable else None
    panels, strips = _measure_panels(model, utilization)
    verdict = _judge(task, result, report, (panels, strips), rule, model, plan)
    report |= {
        "verdict": verdict.verdict,
        "reason": verdict.reason,
        "criteria": verdict.criteria,
        "quiet_iterations": verdict.quiet,
    }
    if usable:
        report |= _headline(model, result, thickness, material, plan, utilization, panels)
        report["panels_at_bound"] = _count_at_bound(task.thickness, rule)
        report["panels_above_one"] = int((panels[rule.measure] > rule.utilization_max).sum())
        arrays |= {f"utilization_{name}": values for name, values in panels.items()}
        if len(model.fixed_thickness):
            report |= _describe_edge_beam(model, utilization, strips)
            arrays |= {f"edge_beam_utilization_{name}": strips[name] for name in strips}
            arrays["edge_beam_panel"] = panels_beside_strips(model)
    going_on = verdict.verdict == "continue"
    if factor_min is not None and result.state == "ok" and going_on:
        factors = combination_matrix(plan.combinations)
        arrays |= linearise_constraints(
            model, result, thickness, material, factors, utilization, rule, task.span, factor_min
        ).to_arrays()
    if not going_on:
        arrays |= _final_fields(model, result, plan, utilization)
    report["seconds"] = time.perf_counter() - began
    return report, arrays


def _describe(
    model: ShellModel, task: IterationTask, result: AnalysisResult
) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Return what every analysis says of itself, whatever its state."""
    area = panel_area(model)
    sized, fixed = np.split(area, [model.sized_panels])
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


def _count_at_bound(thickness: np.ndarray, rule: StopRule) -> int:
    at_bound = (thickness <= rule.least_thickness) | (thickness >= rule.largest_thickness)
    return int(at_bound.sum())


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


def _utilization(model, result, thickness, material, plan: LoadPlan) -> Utilization:
    columns = slice(0, len(plan.strength))
    return compute_utilization(model, result.displacement[:, columns], thickness, material)


def _measure_panels(model: ShellModel, utilization: Utilization | None):
    """Return {measure: (P,)} of the sized panels and {measure: (B,)} of the strips."""
    panels: dict[str, np.ndarray | None] = {}
    strips: dict[str, np.ndarray | None] = {}
    for name in ("panel_mean", "element_max"):
        panels[name] = strips[name] = None
        if utilization is not None:
            values = panel_utilization(model, utilization.cell, name)
            panels[name], strips[name] = np.split(values, [model.sized_panels])
    return panels, strips


def _describe_edge_beam(model: ShellModel, utilization: Utilization, strips) -> dict[str, Any]:
    """Return volume and utilization of the strips: largest cell, and largest panel mean."""
    return {
        "edge_beam_volume_m3": float(
            panel_area(model)[model.sized_panels :] @ model.fixed_thickness
        ),
        "edge_beam_utilization_max": float(utilization.cell[model.bare].max()),
        "edge_beam_utilization_panel_mean_max": float(strips["panel_mean"].max()),
    }


def _judge(task, result, report, measured, rule, model, plan) -> Verdict:
    utilization, strips = (values[rule.measure] for values in measured)
    usable = utilization is not None
    deflection = result.displacement[:, len(plan.strength) :]
    down = largest_downward(model, deflection, list(plan.deflection))[0] if usable else np.nan
    return judge_iteration(
        IterationState(
            iteration=task.iteration,
            state=result.state,
            reason=result.reason,
            thickness=task.thickness,
            utilization=utilization,
            displacement=down,
            span=task.span,
            volume=report["volume_m3"],
            previous_volume=task.previous.get("volume_m3"),
            previous_thickness=task.previous_arrays.get("thickness"),
            previous_quiet=task.previous.get("quiet_iterations", 0),
            edge_beam=float(strips.max()) if usable and len(strips) else None,
        ),
        rule,
    )


def _headline(model, result, thickness, material, plan, utilization, panels) -> dict[str, Any]:
    deflection = result.displacement[:, len(plan.strength) :]
    down, node, combination = largest_downward(model, deflection, list(plan.deflection))
    reactions = support_reactions(model, result, thickness, material)
    sheet = slice(0, int((~model.bare).sum()))
    area, cell = model.operators.geometry.area[sheet], utilization.cell[sheet]
    mean = float(area @ cell.mean(axis=1) / area.sum())
    return {
        "utilization_max": float(cell.max()),
        "utilization_p99": area_percentile(model, utilization.point[sheet]),
        "utilization_mean": mean,
        "utilization_panel_mean_max": float(panels["panel_mean"].max()),
        "displacement_vertical_max_m": down,
        "displacement_combination": combination,
        "displacement_place_m": model.mesh.nodes[node].tolist(),
        "reaction_sum_kn": dict(zip(result.names, reactions.sum(axis=0).T.tolist(), strict=True)),
        "reaction_imbalance": reaction_imbalance(model, result, reactions),
    }


def _final_fields(model, result, plan: LoadPlan, utilization) -> dict[str, np.ndarray]:
    """Return the fields that pictures and exports of the last state need."""
    fields = {"displacement": result.displacement}
    if utilization is not None:
        fields["utilization_cell"] = utilization.cell
        fields["governing_combination"] = utilization.governing
        fields["translations"] = translations(model, result.displacement)
    return fields
