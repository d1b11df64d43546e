"""From columns of a design to a sized shell in memory: pattern, fold, mesh, thickness loop."""

import base64
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from foldshell.explore.measures import (
    GEOMETRIC,
    find_broken,
    measure_creases,
    measure_depth,
)
from foldshell.folding.files import folded_arrays
from foldshell.folding.fold import FoldResult, fold_sheet
from foldshell.folding.targets import make_target, measure_turning
from foldshell.pattern.design import design_sheet
from foldshell.pattern.sheet import Sheet
from foldshell.records.analysis import AnalysisRecord
from foldshell.records.arrays import list_arrays
from foldshell.records.candidate import ANGLES, CandidateRecord, ScreenedRecord
from foldshell.settings.design import Design
from foldshell.settings.exploration import Exploration, Search
from foldshell.settings.field import Plain
from foldshell.settings.stage import StageSettings
from foldshell.shell.edge_beams import make_edge_beam
from foldshell.shell.mesh_files import mesh_folded_sheet
from foldshell.sizing.case import AnalysisCase, make_case
from foldshell.sizing.iteration import IterationTask
from foldshell.sizing.loop import run_loop

CHEAP_SUBDIVISIONS = 1
CHEAP_EXPONENT, CHEAP_UTILIZATION = 0.7, 0.8
"""How thickness goes with utilization at fixed forces, between a plate in bending (1/2) and a
membrane (1), and what the dead band leaves in the mean."""
STEPS = 65535


@dataclass(frozen=True)
class FoldedCandidate:
    """A sheet that was folded for a search."""

    design: Design
    sheet: Sheet
    result: FoldResult

    def mesh(self, subdivisions: int) -> dict[str, np.ndarray]:
        """Return the arrays of mesh.npz; raises `ValueError` for supports that hold nothing."""
        design = self.design
        beam = make_edge_beam(design.edge_beam_depth, design.edge_beam_thickness)
        folded = list_arrays(folded_arrays(self.sheet, self.result))
        return mesh_folded_sheet(folded, design.holding, subdivisions, edge_beam=beam)


def fold_candidate(design: Design, settings: StageSettings) -> FoldedCandidate:
    """Make the pattern of a design and fold it; raises `ValueError` where there is no sheet."""
    target = make_target(design.surface, design.span, design.height)
    angle = design.sector_angle_deg or float(np.degrees(settings.pattern.sector_angle))
    sheet = design_sheet(
        design.pattern, target.section_lengths(), design.zigzag, design.strip, round(angle, 10), 0,
        measure_turning(target), design.rest_fold_angle_deg, design.strip_grading,
    )  # fmt: skip
    return FoldedCandidate(
        design, sheet, fold_sheet(sheet, target, design.fold_mode, settings.fold)
    )


def choose_settings(settings: StageSettings, exploration: Exploration) -> StageSettings:
    """Return the settings of the search: its rule, and the buckling factor that it keeps."""
    sizing, search = settings.sizing, exploration.search
    factor = exploration.limits.buckling_factor_min
    changed = sizing.changed(
        rule=search.rule,
        thinning_buckling_factor_min=max(sizing.thinning_buckling_factor_min, factor),
    )
    return settings.changed(changed)


def prepare_case(folded: FoldedCandidate, settings: StageSettings, n: int) -> AnalysisCase:
    """Mesh a folded candidate with n subdivisions and open it for analyses."""
    analysis = settings.analysis.changed(subdivisions=n)
    return make_case(folded.mesh(n), settings.changed(analysis))


def estimate_volume(folded: FoldedCandidate, settings: StageSettings) -> float:
    """V = sum A t0 clip((u / 0.8)^0.7, t_min / t0, t_max / t0) from one analysis at t0, n = 1 [m3].

    A cheap answer that ranks designs; nan where that analysis finds no state.
    """
    sizing = settings.sizing
    case = prepare_case(folded, settings, CHEAP_SUBDIVISIONS)
    start = sizing.start_thickness
    thickness = np.full(case.model.sized_panels, start)
    _, arrays = case.run(IterationTask(0, folded.design.span, thickness))
    used = arrays.utilization_panel_mean
    if used is None:
        return float("nan")
    facets = folded.result.shape.vertices[folded.sheet.grid.facets]
    normal = np.cross(facets[:, 1] - facets[:, 0], facets[:, 2] - facets[:, 0])
    area = np.linalg.norm(normal, axis=1).reshape(-1, 2).sum(axis=1) / 2
    wish = start * (used / CHEAP_UTILIZATION) ** CHEAP_EXPONENT
    return float(area @ np.clip(wish, sizing.least_thickness, sizing.largest_thickness))


def measure_sheet(folded: FoldedCandidate) -> dict[str, float | None]:
    """Return what is known of a candidate once it is folded, by the keys of its record."""
    quality, grid = folded.result.quality, folded.sheet.grid
    creases = np.flatnonzero(np.isin(grid.assignments, ["M", "V"]))
    return {
        "plan_coverage": quality.plan_coverage,
        "edge_strain_max": quality.edge_strain_max,
        "planarity_max": quality.planarity_max,
        **{key: folded.sheet.settings.get(key) for key in ANGLES},
        "depth_m": measure_depth(folded.sheet.rest),
        "panels": grid.panels,
        "crease_length_m": measure_creases(folded.result.shape.vertices, grid.edges, creases),
    }


def evaluate(
    name: str, row: Mapping[str, object], settings: StageSettings, exploration: Exploration
) -> CandidateRecord:
    """Size one candidate; whatever becomes of it is a record with its reason.

    row : columns of designs.tsv; `settings` : Pattern, Fold and those of an analysis
    """
    search = exploration.search
    values = {key: value for key, value in row.items() if key not in ("design", "tags")}
    blank = CandidateRecord(
        candidate=name, columns=values, state="crumpled", reason="", feasible=False, broken=(),
        mesh_subdivisions=search.subdivisions,
    )  # fmt: skip
    settings = choose_settings(settings, exploration)
    try:
        folded = fold_candidate(Design.from_row({"tags": "", **row}), settings)
        record = replace(blank, **measure_sheet(folded), geometry=pack_geometry(folded))
        if folded.result.state == "crumpled":
            return _finish(replace(record, reason=folded.result.reason), exploration)
        record = replace(record, cheap_m3=_finite(estimate_volume(folded, settings)))
        record = _size(record, folded, settings, search)
    except ValueError as error:
        return replace(blank, state="not_reached", reason=str(error))
    return _finish(record, exploration)


def screen(
    row: Mapping[str, object], settings: StageSettings, exploration: Exploration
) -> ScreenedRecord:
    """Fold a candidate and analyse it once: what it promises, and which limits it breaks.

    row : columns of designs.tsv; `settings` : Pattern, Fold and those of an analysis
    """
    columns = {key: value for key, value in row.items() if key not in ("design", "tags")}
    settings = choose_settings(settings, exploration)
    try:
        folded = fold_candidate(Design.from_row({"tags": "", **row}), settings)
        broken = find_broken(measure_sheet(folded), exploration.limits)
        if folded.result.state == "crumpled":
            return ScreenedRecord(
                columns=columns, cheap_m3=None, broken=("crumpled",), reason=folded.result.reason
            )
        cheap = _finite(estimate_volume(folded, settings))
    except ValueError as error:
        return ScreenedRecord(columns=columns, cheap_m3=None, broken=(), reason=str(error))
    return ScreenedRecord(
        columns=columns, cheap_m3=cheap, broken=tuple(name for name in broken if name in GEOMETRIC)
    )


def _size(
    record: CandidateRecord, folded: FoldedCandidate, settings: StageSettings, search: Search
) -> CandidateRecord:
    case = prepare_case(folded, settings, search.subdivisions)
    loop = run_loop(case, folded.design.span, settings.sizing)
    final = loop.final
    if folded.result.state != "ok":
        state, reason = folded.result.state, folded.result.reason
    else:
        state, reason = _judge(final), final.reason
    return replace(
        record,
        state=state,
        reason=reason,
        verdict=final.verdict,
        area_m2=final.area_m2,
        volume_m3=final.volume_m3,
        buckling_factor_min=find_least_factor(final),
        displacement_vertical_max_m=final.displacement_vertical_max_m,
        utilization_panel_mean_max=final.utilization_panel_mean_max,
        iterations=len(loop.analyses),
    )


def _judge(final: AnalysisRecord) -> str:
    """Return the state of a sized candidate: a verdict of success, or what became of it."""
    if final.verdict in ("converged", "at_minimum_thickness"):
        return "sized"
    return final.verdict if final.state == "ok" else final.state


def find_least_factor(final: AnalysisRecord) -> float | None:
    """Return the least buckling factor of all combinations, None where nothing buckles."""
    factors = [factor for factor in final.buckling_factor.values() if factor is not None]
    return min(factors, default=None)


def _finish(record: CandidateRecord, exploration: Exploration) -> CandidateRecord:
    broken = find_broken(vars(record), exploration.limits)
    return replace(record, broken=broken, feasible=record.state == "sized" and not broken)


def _finite(value: float) -> float | None:
    return value if np.isfinite(value) else None


def pack_geometry(folded: FoldedCandidate) -> str:
    """Return vertices and panels of a candidate as text, for thumbnails.

    Little endian: three uint32 (vertices, panels, strips), six float32 (lowest corner, size; m),
    uint16 V x 3 in shares of the box; then P x 4 of the panels, where strips is 0. Else they are
    those of a grid whose rows have so many vertices.
    """
    vertices, grid = folded.result.shape.vertices, folded.sheet.grid
    low, size = vertices.min(axis=0), np.maximum(np.ptp(vertices, axis=0), 1e-9)
    packed = np.round((vertices - low) / size * STEPS).astype("<u2")
    number = np.arange(len(vertices)).reshape(-1, grid.strip_count)
    corners = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
    plain = np.array_equal(grid.quads, np.stack([one.ravel() for one in corners], axis=1))
    strips, rest = (grid.strip_count, b"") if plain else (0, grid.quads.astype("<u2").tobytes())
    head = np.array([len(vertices), len(grid.quads), strips], "<u4").tobytes()
    box = np.concatenate([low, size]).astype("<f4").tobytes()
    return base64.b64encode(head + box + packed.tobytes() + rest).decode()


def make_design(columns: Plain, name: str = "candidate") -> Design:
    """Return the design of the columns of a candidate."""
    return Design.from_row({"tags": "", **columns, "design": name})
