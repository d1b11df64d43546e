"""What engineering.json and engineering.npz say of a judged state."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from typing import Any

import numpy as np

from foldshell.checks.stability import RequiredFactor, require_factor
from foldshell.checks.strength import CRITERIA
from foldshell.checks.strips import largest_of_panels, utilization_of_strips
from foldshell.checks.utilization import panel_utilization
from foldshell.loads.combinations import engineering_combinations
from foldshell.records.analysis import AnalysisRecord
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.records.arrays import list_arrays
from foldshell.records.engineering import (
    CombinationFactors,
    EngineeringArrays,
    EngineeringRecord,
    Measures,
)
from foldshell.records.mesh_convergence import MeshConvergenceRecord
from foldshell.records.sheet_arrays import MeshArrays
from foldshell.results.engineering import Judged, judge_state
from foldshell.results.engineering_state import EngineeringState, analyse_final_state
from foldshell.results.reinforcement import Reinforced, reinforce_state
from foldshell.results.section_forces import COMPONENTS, average_panels
from foldshell.settings.checks import Checks
from foldshell.settings.material import Material
from foldshell.settings.stage import StageSettings
from foldshell.shell.held_supports import sum_supports
from foldshell.shell.nodal_loads import sum_loads
from foldshell.shell.results import panel_area
from foldshell.shell.stress import cell_points, evaluate, stress_resultants, surface_stresses
from foldshell.sizing.iteration import AnalysisCase

POINTS = 6
"""Points along an element edge for panel means: 36 an element, within 1 % of 144."""
TABLED = ("von_mises", "rankine")
"""Criteria whose measures stand side by side in every table."""


def check_final_state(
    case: AnalysisCase,
    settings: StageSettings,
    final: AnalysisArrays,
    shell: MeshArrays,
    span: float,
    errors: MeshConvergenceRecord,
    report: AnalysisRecord,
) -> tuple[EngineeringRecord, EngineeringArrays]:
    """Analyse the state of final.npz under the engineering combinations and judge it; span m.

    `settings` are those of the stages `size` and `checks`, `shell` the arrays of mesh.npz. Loads of
    which the code's rule makes no combinations leave the verdict not applicable.
    """
    checks = settings.checks
    try:
        combinations = engineering_combinations(settings.loads, settings.codes)
    except ValueError as error:
        return leave_open(str(error), settings.material, checks), EngineeringArrays()
    state = analyse_final_state(case, combinations, final.thickness, checks, final.buckling_modes)
    reinforced = reinforce_state(state, settings, errors.reinforcement_errors)
    judged = judge_state(state, checks, span, errors, report.model_warnings or (), reinforced)
    measures, strips = measure_loop_state(state, final, len(settings.combinations.strength))
    record, arrays = make_record(state, judged, checks, measures, shell, reinforced)
    if strips is None:
        return record, arrays
    own = {"utilization_strip": tuple(strips.tolist())}
    return replace(record, panels={**record.panels, **own}), arrays


def leave_open(reason: str, material: Material, checks: Checks) -> EngineeringRecord:
    """Return the record of a verdict that is not applicable: nothing was analysed."""
    required = require_factor(checks, material.kind)
    return EngineeringRecord(
        verdict="not_applicable",
        reason=reason,
        material_kind=material.kind,
        checks={},
        buckling_terms=describe_terms(required),
        loop_criterion=material.criterion,
        measures={},
        combinations=CombinationFactors(strength={}, characteristic={}, quasi_permanent={}),
        buckling_factor={},
        loads={},
        reactions={},
        analyses=0,
        panels={},
    )


def describe_terms(required: RequiredFactor) -> dict[str, float]:
    """Return the terms of the buckling factor that is required, their product and the factor."""
    return {**asdict(required), "product": required.product, "required": required.value}


def measure_loop_state(
    state: EngineeringState, final: AnalysisArrays, count: int
) -> tuple[dict[str, Measures], np.ndarray | None]:
    """Return `Measures` of the loop's own strength combinations, the first `count` columns of the
    displacements of final.npz, by criterion; and the largest strip of each panel (P,), without
    unit, by that of the loop."""
    model, material = state.case.model, state.case.material
    if state.strips is None or final.displacement is None or final.utilization_cell is None:
        return {}, None
    moved = final.displacement[:, :count]
    imposed = None if final.imposed_strain is None else final.imposed_strain[..., :count]
    found = stress_resultants(
        model.operators, moved, state.thickness, material.youngs_modulus, imposed
    )
    flat = cell_points(POINTS)
    force, moment = (evaluate(model.operators, one, flat) for one in (found.force, found.moment))
    stress = surface_stresses(force, moment, state.thickness)
    names = dict.fromkeys((*TABLED, material.criterion))
    own = utilization_of_strips(state.strips, found, state.thickness, material).max(axis=1)
    panels = largest_of_panels(state.strips, own)[: model.sized_panels]
    return {name: _measure(state, found, stress, final, name) for name in names}, panels


def _measure(state, found, stress, final: AnalysisArrays, name: str) -> Measures:
    model, material = state.case.model, state.case.material
    sized, criterion = model.sized_panels, CRITERIA[name]
    if name == material.criterion:
        mean = final.utilization_panel_mean
    else:
        point = criterion(stress, material).max(axis=(0, 3))
        mean = panel_utilization(model, point, "panel_mean")[:sized]
    rows = state.strips.panel < sized
    strips = utilization_of_strips(state.strips, found, state.thickness, material, criterion)
    area = panel_area(model)[:sized]
    return Measures(
        utilization_panel_mean_max=float(mean.max()),
        utilization_strip_max=float(strips[rows].max()),
        panels_above_one=int((mean > 1).sum()),
        area_share_above_one=float(area[mean > 1].sum() / area.sum()),
    )


def make_record(
    state: EngineeringState,
    judged: Judged,
    checks: Checks,
    measures: Mapping[str, Measures],
    shell: MeshArrays,
    reinforced: Reinforced | None = None,
) -> tuple[EngineeringRecord, EngineeringArrays]:
    """Return the record and the arrays of a judged state; `shell` are those of mesh.npz."""
    required = require_factor(checks, state.case.material.kind)
    arrays, edges = collect_arrays(state, shell)
    record = EngineeringRecord(
        verdict=judged.verdict,
        reason=judged.reason,
        material_kind=state.case.material.kind,
        checks=dict(judged.checks),
        buckling_terms=describe_terms(required),
        loop_criterion=state.case.material.criterion,
        measures=dict(measures),
        combinations=CombinationFactors(**{
            name: {key: dict(one) for key, one in getattr(state.combinations, name).items()}
            for name in ("strength", "characteristic", "quasi_permanent")
        }),
        buckling_factor=_list_factors(state),
        **sum_cases(state),
        reactions=edges,
        analyses=state.analyses,
        panels=describe_panels(state, judged, arrays) | _list_steel(reinforced, judged),
        reinforcement=reinforced and reinforced.record,
    )  # fmt: skip
    return record, arrays


def _list_steel(reinforced: Reinforced | None, judged: Judged) -> dict[str, tuple[Any, ...]]:
    """Return the columns of reinforcement; BU is the factor that is due over the one found."""
    if reinforced is None or not reinforced.columns:
        return {}
    columns = {name: tuple(values.tolist()) for name, values in reinforced.columns.items()}
    held = judged.checks["stability"]
    share = held.limit / held.value if held.value else None
    first = list(columns).index("SC")
    items = list(columns.items())
    items.insert(first, ("BU", (share,) * len(items[0][1])))
    return dict(items)


def _list_factors(state: EngineeringState) -> dict[str, float | None]:
    if state.short.buckling is None:
        return {}
    pairs = zip(state.short.names, state.short.buckling.factors.tolist(), strict=True)
    return {name: factor if np.isfinite(factor) else None for name, factor in pairs}


def sum_cases(state: EngineeringState) -> dict[str, dict[str, tuple[float, ...]]]:
    """Return `loads`, the resultant of each load case over the shell, kN, and `load_moments` about
    the origin, kNm."""
    placed, operators = state.case.placed, state.case.model.operators
    sums = sum_loads(operators, placed.at(state.thickness))
    return {
        key: {name: tuple(total[:, k].tolist()) for k, name in enumerate(placed.names)}
        for key, total in zip(("loads", "load_moments"), sums, strict=True)
    }


def collect_arrays(
    state: EngineeringState, shell: MeshArrays
) -> tuple[EngineeringArrays, dict[str, dict[str, tuple]]]:
    """Return reactions, loads and section forces; the reactions of edges by combination as well.

    Nothing of a mechanism.
    """
    if state.resultants is None:
        return EngineeringArrays(), {}
    model = state.case.model
    reactions, nodes = state.reactions(), model.supported_nodes
    edges = sum_supports(model.mesh, list_arrays(shell), nodes, reactions)
    vertices = nodes[nodes < len(shell.vertices)]  # the first nodes of a mesh are its vertices
    vertices = vertices if len(vertices) else nodes
    places = model.mesh.nodes[vertices]
    away = np.linalg.norm(model.mesh.nodes[nodes][:, None] - places, axis=2)
    sums = np.zeros((len(vertices), *reactions.shape[1:]))
    np.add.at(sums, away.argmin(axis=1), reactions)
    arrays = EngineeringArrays(
        vertex=vertices,
        vertex_place=places,
        vertex_reaction=sums,
        edge_reaction=np.stack(list(edges.values())),
        load_sum=state.load_sums(),
        panel_forces=average_panels(model.operators, state.strips, state.resultants),
    )
    return arrays, {name: _by_combination(state.short.names, own) for name, own in edges.items()}


def _by_combination(names: Sequence[str], values: np.ndarray) -> dict[str, tuple]:
    """Return (3, c) as a vector by the name of each combination."""
    return {name: tuple(values[:, k].tolist()) for k, name in enumerate(names)}


def describe_panels(
    state: EngineeringState, judged: Judged, arrays: EngineeringArrays
) -> dict[str, tuple[Any, ...]]:
    """Return what stands in one row per sized panel, an array by each name.

    Envelopes of n, m and v are those of the means over the panel, of all strength combinations.
    """
    model = state.case.model
    count, mesh = model.sized_panels, model.mesh
    area = panel_area(model)
    middle = mesh.nodes[mesh.corners].mean(axis=1) * model.operators.geometry.area[:, None]
    centroid = np.stack([np.bincount(mesh.panel, middle[:, k]) for k in range(3)], axis=1)
    centroid /= area[:, None]
    found: dict[str, Any] = {
        "panel": np.arange(count),
        "thickness_m": state.thickness[np.unique(mesh.panel, return_index=True)[1]][:count],
        "area_m2": area[:count],
        **{f"centroid_{axis}_m": centroid[:count, k] for k, axis in enumerate("xyz")},
    }
    if state.resultants is not None:
        names = np.array(list(state.combinations.strength))
        found["strength_utilization"] = judged.used[:count].max(axis=1)
        found["governing_combination"] = names[judged.used[:count].argmax(axis=1)]
        found["cracked"] = state.cracked_panels[:count]
        forces = arrays.panel_forces[: state.strength_count, :count]
        for k, name in enumerate(COMPONENTS):
            found[f"{name}_min"] = forces[..., k].min(axis=0)
            found[f"{name}_max"] = forces[..., k].max(axis=0)
    return {name: tuple(values.tolist()) for name, values in found.items()}
