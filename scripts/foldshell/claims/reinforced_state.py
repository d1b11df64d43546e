"""A design sized until it stands as reinforced concrete: its state, steel and mesh error."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from foldshell.checks.concrete.quantities import sum_steel
from foldshell.claims.flat_equal import analyse_flat
from foldshell.claims.measures import Layout, measure_state, summarise_local
from foldshell.records.measures import FlatEqualRecord
from foldshell.records.mesh_convergence import MeshConvergenceRecord
from foldshell.records.reinforced_claims import ReinforcedRecord
from foldshell.records.sheet_arrays import MeshArrays
from foldshell.results.engineering_record import check_final_state
from foldshell.settings.design import Design
from foldshell.settings.sizing import REINFORCED
from foldshell.settings.stage import StageSettings
from foldshell.settings.support_row import Holding
from foldshell.shell.edge_beams import make_edge_beam
from foldshell.shell.effort import FULL
from foldshell.shell.mesh_files import mesh_folded_sheet
from foldshell.sizing.case import make_case
from foldshell.sizing.iteration import AnalysisCase, IterationTask, evaluate, prepare_analysis
from foldshell.sizing.loop import run_loop
from foldshell.workbook.panels import make_panel_grid, mirror_panels

QUANTITIES = ("displacement", "utilization", "utilization_panel_mean_max",
              "utilization_variation", "steel_kg_m2")  # fmt: skip
"""What a finer mesh is asked for; `utilization` is the mean over panels."""


@dataclass(frozen=True)
class SheetToSize:
    """A design with its supports, the arrays of its folded.npz, the subdivisions that it is sized
    on, and the mesh errors of the state that the paper's criteria sized, which the engineering
    verdict asks for."""

    design: Design
    support: Holding
    folded: Mapping[str, np.ndarray]
    subdivisions: int
    errors: MeshConvergenceRecord

    @property
    def layout(self) -> Layout:
        """Counts of polylines and supports."""
        return Layout(self.design.zigzag, self.design.strip, self.design.support)

    def make_mesh(self, times: int) -> dict[str, np.ndarray]:
        """Return the arrays of mesh.npz on `times` the subdivisions."""
        design, count = self.design, times * self.subdivisions
        beam = make_edge_beam(design.edge_beam_depth, design.edge_beam_thickness)
        return mesh_folded_sheet(dict(self.folded), self.support, count, edge_beam=beam)


def size_reinforced(
    sheet: SheetToSize, settings: StageSettings, flat: tuple[str, Mapping] | None = None
) -> ReinforcedRecord:
    """Run the loop, judge what it delivers, and measure its mesh error.

    `settings` are those of the stages `size` and `checks`, of a design's own file, `flat` the name
    and the arrays of folded.npz of the flat sheet that is given the same volume.
    """
    design, sizing, layout = sheet.design, settings.sizing, sheet.layout
    mesh = sheet.make_mesh(1)
    case = make_case(mesh, settings)
    limits = mirror_panels(make_panel_grid(layout.zigzag_count, layout.strip_count),
                           sizing.symmetry)  # fmt: skip
    result = run_loop(case, design.span, sizing, limits)
    final, arrays = result.final, result.arrays
    state = layout, final, arrays, settings.combinations, sizing.measure
    measures = measure_state(mesh, *state)
    shell = MeshArrays(**mesh)
    judged, _ = check_final_state(case, settings, arrays, shell, design.span, sheet.errors, final)
    steel = judged.reinforcement
    return ReinforcedRecord(
        design=design.name,
        settings=design.settings,
        measures=replace(measures, steel_kg_m2=steel and steel.steel_kg_m2),
        mesh_errors=find_mesh_errors(sheet, case, settings, arrays.thickness),
        engineering=judged.verdict,
        engineering_reason=judged.reason,
        steel_kg_m3=steel and steel.steel_kg_m3,
        governing_share=steel.governing_share if steel else {},
        over_one_share=steel.over_one_share if steel else {},
        flat=None if flat is None else _analyse_flat(sheet, flat, final.volume_m3, settings),
    )


def _analyse_flat(
    sheet: SheetToSize, flat: tuple[str, Mapping], volume: float, settings: StageSettings
) -> FlatEqualRecord:
    """Analyse the flat sheet of equal volume by the paper's measure: it needs no steel to bend."""
    plain = settings.changed(settings.sizing.changed(measure="panel_mean"))
    name, folded = flat
    return analyse_flat(
        name, folded, sheet.layout, volume, sheet.design.span, sheet.subdivisions, plain
    )


def find_mesh_errors(
    sheet: SheetToSize, case: AnalysisCase, settings: StageSettings, thickness: np.ndarray
) -> dict[str, float | None]:
    """Return |f(2n) / f(n) - 1| of `QUANTITIES` at first order; thickness (P,) m."""
    finer_case = make_case(sheet.make_mesh(2), settings)
    coarse, finer = (measure_first_order(one, sheet.design.span, thickness)
                     for one in (case, finer_case))  # fmt: skip
    if coarse is None or finer is None:
        return dict.fromkeys(QUANTITIES)
    return {name: abs(finer[name] / coarse[name] - 1) if coarse[name] else None
            for name in QUANTITIES}  # fmt: skip


def measure_first_order(
    case: AnalysisCase, span: float, thickness: np.ndarray
) -> dict[str, float] | None:
    """Return `QUANTITIES` of a state at first order, None for a mechanism; span m, thickness (P,) m
    of a case whose measure is `reinforced`."""
    first = replace(case, options=case.options.changed(second_order=False))
    task = IterationTask(0, span, thickness)
    done = evaluate(first, task, prepare_analysis(first, task).run(FULL), FULL)
    if done.stress is None:
        return None
    use, area = done.stress.reinforced, case.concrete.area
    used = summarise_local(use.largest, area, REINFORCED)
    steel = sum_steel(use.steel.area, area, case.concrete.layout.density) / float(area.sum())
    values = (done.downward[0], used["utilization_reinforced_mean"],
              used["utilization_reinforced_max"], used["utilization_reinforced_variation"],
              steel)  # fmt: skip
    return dict(zip(QUANTITIES, map(float, values), strict=True))


def list_errors(
    found: Mapping[str, float | None], paper: Mapping[str, Sequence[float | None]]
) -> dict[str, tuple[float | None, float | None]]:
    """Return relative mesh error and cross-check difference of each quantity.

    `found` are the mesh errors of the reinforced state, `paper` both of the state that the paper's
    criteria sized, whose cross-check stands for quantities of its kind, and whose mesh error for
    buckling factors.
    """
    made = {name: (error, paper["displacement" if name == "displacement" else "utilization"][1])
            for name, error in found.items()}  # fmt: skip
    return made | {"buckling": tuple(paper["buckling"])}
