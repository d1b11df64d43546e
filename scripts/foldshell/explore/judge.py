"""The engineering verdict on a sized candidate: what it says, and what steel takes and costs."""

from collections.abc import Mapping

import numpy as np

from foldshell.records.arrays import make_typed_arrays
from foldshell.records.mesh_convergence import MeshConvergenceRecord, MeshStudy, ReferenceMesh
from foldshell.records.sheet_arrays import MeshArrays
from foldshell.results.engineering_record import check_final_state
from foldshell.settings.sizing import REINFORCED
from foldshell.settings.stage import StageSettings
from foldshell.sizing.iteration import AnalysisCase
from foldshell.sizing.loop import LoopResult

Judged = dict[str, float | str | None]


def judge_loop(
    case: AnalysisCase,
    loop: LoopResult,
    settings: StageSettings,
    mesh: Mapping[str, np.ndarray],
    span: float,
) -> Judged:
    """Return verdict, steel (kg), CO2 (kg), cost, volume with steel (m3) of what a loop delivers.

    `mesh` are the arrays of mesh.npz, span m. No error of the mesh is known in a search: the
    verdict takes none off. Of a shell that is not sized by `measure: reinforced` there is no volume
    with steel, since its concrete is that of another measure.
    """
    subdivisions = case.options.subdivisions
    study = MeshStudy(
        subdivisions=(subdivisions, subdivisions), reference=ReferenceMesh(), combinations={}
    )
    errors = MeshConvergenceRecord(
        mesh_error=None, buckling_mesh_error=None, subdivisions=subdivisions, errors={},
        study=study,
    )  # fmt: skip
    shell = make_typed_arrays(MeshArrays, mesh)
    record, _ = check_final_state(case, settings, loop.arrays, shell, span, errors, loop.final)
    found: Judged = {"engineering": record.verdict, "engineering_reason": record.reason}
    steel = record.reinforcement
    if steel is None:
        return found
    found |= {"steel_kg": steel.steel_kg, "co2_kg": steel.co2_kg, "cost": steel.cost}
    if settings.sizing.measure == REINFORCED:
        density = settings.reinforcement.steel_density
        found["engineering_volume_m3"] = loop.final.volume_m3 + steel.steel_kg / density
    return found
