"""What the record of an analysis says: its sheet, its edge beam, its arrays."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from foldshell.checks.measures import MEASURES, StressState
from foldshell.checks.utilization import Utilization, area_percentile
from foldshell.records.analysis import AnalysisRecord
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.shell.analysis import AnalysisResult, ShellModel
from foldshell.shell.results import (
    largest_downward,
    panel_area,
    panels_beside_edge_beam,
    reaction_imbalance,
    support_reactions,
    translations,
)
from foldshell.sizing.panel_limits import bound_panels, name_limits

if TYPE_CHECKING:
    from foldshell.sizing.iteration import AnalysisCase, IterationTask


@dataclass(frozen=True)
class Analysed:
    """What the report of an analysis is made of; `thickness` is that of elements, (E,) m.

    `panels` and `edge_beam_panels` hold the utilization of the sized panels (P,) and of an edge
    beam (B,) by measure. They are empty, and `stress` is None, where the analysis left no
    displacements to rely on. `random_vectors` tells whether buckling was searched for with them.
    """

    case: AnalysisCase
    task: IterationTask
    thickness: np.ndarray
    result: AnalysisResult
    stress: StressState | None = None
    panels: Mapping[str, np.ndarray] = field(default_factory=dict)
    edge_beam_panels: Mapping[str, np.ndarray] = field(default_factory=dict)
    random_vectors: bool = True

    @property
    def utilization(self) -> Utilization | None:
        """Utilization at points and in cells, None where there is none."""
        return self.stress and self.stress.utilization

    @property
    def downward(self) -> tuple[float, int, str]:
        """Largest downward displacement (m) of the deflection combinations, node, combination."""
        groups = self.case.combinations
        deflection = self.result.displacement[:, len(groups.strength) :]
        return largest_downward(self.case.model, deflection, list(groups.deflection))


def collect_arrays(done: Analysed) -> AnalysisArrays:
    """Return the arrays of every analysis: thickness, modes, utilization of panels."""
    buckling, model = done.result.buckling, done.case.model
    beam = len(model.fixed_thickness) > 0 and done.utilization is not None
    named = {f"utilization_{name}": values for name, values in done.panels.items()}
    if beam:
        named |= {
            f"edge_beam_utilization_{k}": values for k, values in done.edge_beam_panels.items()
        }
    return AnalysisArrays(
        thickness=done.task.thickness,
        buckling_modes=None if buckling is None else buckling.modes.astype(np.float32),
        edge_beam_panel=panels_beside_edge_beam(model) if beam else None,
        **named,
        **name_limits(done.task.limits),
    )


def split_area(model: ShellModel) -> list[np.ndarray]:
    """Return the areas of the sized panels (P,) and of the edge beam's (B,), m2."""
    return np.split(panel_area(model), [model.sized_panels])


def list_factors(result: AnalysisResult) -> dict[str, float | None]:
    """Return the buckling factor of each combination, None where none was found."""
    if result.buckling is None:
        return {name: None for name in result.names}
    values = result.buckling.factors
    return {
        name: float(value) if np.isfinite(value) else None
        for name, value in zip(result.names, values, strict=True)
    }


def largest_residual(result: AnalysisResult) -> float | None:
    """Return the largest relative residual of second order, None without one."""
    return float(result.second_order.residual.max()) if result.second_order else None


def describe_sheet(done: Analysed, record: AnalysisRecord) -> AnalysisRecord:
    """Add utilization of the sheet, displacement and reactions."""
    model, sizing, thickness = done.case.model, done.case.sizing, done.task.thickness
    down, node, combination = done.downward
    reactions = support_reactions(model, done.result, done.thickness, done.case.material)
    sums = map(tuple, reactions.sum(axis=0).T.tolist())
    sheet = slice(0, int((~model.self_weight_only).sum()))
    area, cell = model.operators.geometry.area[sheet], done.utilization.cell[sheet]
    least, largest = bound_panels(done.task.limits, thickness, *sizing.bounds)
    at_bound = (thickness <= least) | (thickness >= largest)
    return replace(
        record,
        utilization_max=float(cell.max()),
        utilization_p99=area_percentile(model, done.utilization.point[sheet]),
        utilization_mean=float(area @ cell.mean(axis=1) / area.sum()),
        utilization_panel_mean_max=float(done.panels["panel_mean"].max()),
        utilization_strip_max=_find_largest(done.panels, "strip"),
        utilization_reinforced_max=_find_largest(done.panels, "reinforced"),
        governing_combination=_find_governing(done),
        displacement_vertical_max_m=down,
        displacement_combination=combination,
        displacement_place_m=tuple(model.mesh.nodes[node].tolist()),
        reaction_sum_kn=dict(zip(done.result.names, sums, strict=True)),
        reaction_imbalance=reaction_imbalance(model, done.result, reactions),
        panels_at_bound=int(at_bound.sum()),
        panels_above_one=int((done.panels[sizing.measure] > sizing.utilization_max).sum()),
    )


def _find_largest(panels: Mapping[str, np.ndarray], measure: str) -> float | None:
    return float(panels[measure].max()) if measure in panels else None


def _find_governing(done: Analysed) -> str:
    """Return the strength combination under which the most utilized panel is used most."""
    measure = done.case.sizing.measure
    used = MEASURES[measure].combinations(done.stress, int(done.panels[measure].argmax()))
    return list(done.case.combinations.strength)[int(used.argmax())]


def describe_edge_beam(done: Analysed, record: AnalysisRecord) -> AnalysisRecord:
    """Add volume and utilization of the edge beam where there is one."""
    model = done.case.model
    if not len(model.fixed_thickness):
        return record
    return replace(
        record,
        edge_beam_volume_m3=float(split_area(model)[1] @ model.fixed_thickness),
        edge_beam_utilization_max=float(done.utilization.cell[model.self_weight_only].max()),
        edge_beam_utilization_panel_mean_max=float(done.edge_beam_panels["panel_mean"].max()),
        edge_beam_utilization_strip_max=_find_largest(done.edge_beam_panels, "strip"),
    )


def add_final_fields(done: Analysed, arrays: AnalysisArrays) -> AnalysisArrays:
    """Add the fields that pictures and exports of the last state need."""
    arrays = replace(
        arrays, displacement=done.result.displacement, imposed_strain=done.result.imposed
    )
    if done.utilization is None:
        return arrays
    return replace(
        arrays,
        utilization_cell=done.utilization.cell,
        governing_combination=done.utilization.governing,
        translations=translations(done.case.model, done.result.displacement),
    )
