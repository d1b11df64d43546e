"""Mesh error of the headline numbers: one state on the mesh in use and on a reference mesh."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from foldshell.checks.utilization import area_percentile, compute_utilization, panel_utilization
from foldshell.loads.cases import SurfaceLoad
from foldshell.records.mesh_convergence import (
    CombinationStudy,
    MeshQuantities,
    MeshStudy,
    ReferenceMesh,
)
from foldshell.records.plain import to_plain
from foldshell.results.analysis_start import (
    KnownState,
    MeshBefore,
    analyse_after,
    analyse_known,
    remember,
)
from foldshell.results.mean_fold import is_folded
from foldshell.results.reinforced_meshes import (
    ConcreteAsked,
    measure_reinforced,
    pair_reinforced,
)
from foldshell.settings.field import Factors
from foldshell.settings.material import Material
from foldshell.settings.support_row import Holding
from foldshell.shell.analysis import ShellAnalysis
from foldshell.shell.curved_panels import PARTS, is_curved
from foldshell.shell.edge_beams import EdgeBeam
from foldshell.shell.held_supports import build_supported_model, sum_supports
from foldshell.shell.mesh_files import mesh_folded_sheet, mesh_from_arrays
from foldshell.shell.results import largest_downward, support_reactions, translations

REFERENCE = ReferenceMesh(order=7)
"""What the mesh that gives the limit changes in the mesh in use: the element order. On the thin
folded sheets of tests/verification it is within 1 % of 16 subdivisions in displacement, within 2 %
in work; the 99th percentile of utilization stays 1 to 6 % too low. docs/crosscheck.md has long
facets."""

EQUIVALENT = 12
"""Subdivisions that count for it where values are extrapolated: a choice on the safe side, which
adds an eighth of the difference from 4 subdivisions."""

SMOOTH_REFERENCE = ReferenceMesh(subdivisions=8)
"""The mesh for sheets without folds: a thin dome as high as it is wide has bumps narrower than a
facet, and one element of order 7 leaves them 5 % too low; 8 and 16 subdivisions agree."""

CURVED_REFERENCE = ReferenceMesh(panel_parts=2 * PARTS)
"""The mesh for smooth shells, whose error is that of flat facets on a curved surface: twice as many
quads a panel, of the same subdivisions."""

LARGEST_FACTOR = 1e6
"""Stands for the buckling factor of a structure that is not compressed at all."""

SUPPORTS = "support_reactions_kn"
"""Reactions by supported edge."""


class MechanismError(ValueError):
    """A state without displacements, and where it gives way."""


@dataclass(frozen=True)
class _OnMesh:
    """Quantities of one combination on one mesh, named as in `CombinationStudy`."""

    displacement_down_max_m: float
    displacement_max_m: float
    work_knm: float
    utilization_p99: float
    utilization_panel_mean_max: float
    reaction_sum_kn: tuple[float, ...]
    support_reactions_kn: dict[str, tuple[float, ...]]
    load_sum_kn: tuple[float, ...]
    buckling_factor: float | None = None
    second_order: "_OnMesh | None" = None


@dataclass(frozen=True)
class DesignOnMeshes:
    """A final state and its loads, whatever the mesh: arrays of folded.npz, supports, thickness
    (P,) m, material, load cases, compared combinations, edge beam, what an analysis on the mesh in
    use has found of these, where there is one, and what reinforcement is asked for."""

    folded: Mapping[str, np.ndarray]
    support: Holding
    panel_thickness: np.ndarray
    material: Material
    cases: Sequence[SurfaceLoad]
    combinations: Factors
    edge_beam: EdgeBeam | None = None
    known: KnownState | None = None
    concrete: ConcreteAsked | None = None

    def analyse(self, mesh: Mapping[str, int], before: MeshBefore | None = None):
        """Return what is found on a mesh, told by arguments of its making; `before` is that of the
        mesh before."""
        return _analyse(self, mesh, analyse_after, before)

    def analyse_in_use(self, mesh: Mapping[str, int]):
        """Return the same on the mesh in use, whose state is known."""
        return _analyse(self, mesh, analyse_known, self.known)


def study_mesh(
    folded: Mapping[str, np.ndarray],
    support: Holding,
    panel_thickness: np.ndarray,
    subdivisions: int,
    material: Material,
    cases: Sequence[SurfaceLoad],
    combinations: Factors,
    edge_beam: EdgeBeam | None = None,
) -> MeshStudy:
    """Return each quantity on the mesh in use and on the reference mesh, by combination.

    Quantities are of first order; `second_order` holds the same to second order, where the
    structure does not buckle, and `buckling_factor` stands beside them. A mechanism has none of
    them: `combinations` is empty and `reason` says why.

    Parameters
    ----------
    folded : arrays of folded.npz
    panel_thickness : (P,) m
    subdivisions : of the mesh in use
    edge_beam : its panels count among the others
    """
    own = folded, support, panel_thickness, material, cases, combinations, edge_beam
    return study_design(DesignOnMeshes(*own), subdivisions)


def study_design(
    design: DesignOnMeshes, subdivisions: int, reference: ReferenceMesh | None = None
) -> MeshStudy:
    """Return the same of a design; the reference mesh is chosen where none is given."""
    folded, in_use = design.folded, {"subdivisions": subdivisions}
    reference = reference or choose_reference(folded, subdivisions)
    finest = max(reference.subdivisions or EQUIVALENT, 2 * subdivisions)
    if is_curved(folded):
        finest = 2 * subdivisions
    study = MeshStudy(subdivisions=(subdivisions, finest), reference=reference, combinations={})
    try:
        coarse = design.analyse_in_use(in_use)
        before = None if reference.panel_parts else coarse.end  # it goes over on the same facets
        fine = design.analyse(in_use | to_plain(reference), before)
    except MechanismError as error:
        return replace(study, reason=str(error))
    found = {name: _pair(coarse.values[name], fine.values[name]) for name in design.combinations}
    steel = pair_reinforced(design.concrete, coarse.reinforced, fine.reinforced)
    return replace(study, combinations=found, reinforcement=steel)


def choose_reference(folded: Mapping[str, np.ndarray], subdivisions: int) -> ReferenceMesh:
    """Return how the reference mesh differs: of high order for folded sheets, else finer.

    `folded` holds the arrays of folded.npz: vertices (V, 3) m, facets (F, 3).
    """
    if is_curved(folded):
        return CURVED_REFERENCE
    if is_folded(folded):
        return REFERENCE
    return ReferenceMesh(subdivisions=max(SMOOTH_REFERENCE.subdivisions, 2 * subdivisions))


def _pair(coarse: _OnMesh, fine: _OnMesh) -> CombinationStudy:
    """Return every quantity that both meshes give."""
    both = coarse.second_order and fine.second_order
    second = _pair_quantities(coarse.second_order, fine.second_order) if both else None
    return CombinationStudy(
        **_pair_quantities(coarse, fine),
        buckling_factor=(coarse.buckling_factor, fine.buckling_factor),
        second_order=MeshQuantities(**second) if second else None,
    )


def _pair_quantities(coarse: _OnMesh, fine: _OnMesh) -> dict[str, tuple]:
    names = [one.name for one in fields(MeshQuantities) if one.name != SUPPORTS]
    edges = (coarse.support_reactions_kn, fine.support_reactions_kn)
    shared = {name: tuple(values[name] for values in edges) for name in edges[0]}
    return {name: (getattr(coarse, name), getattr(fine, name)) for name in names} | {
        SUPPORTS: shared
    }


@dataclass(frozen=True)
class _Found:
    """Of one mesh: quantities by combination, what the next begins with, and reinforcement."""

    values: dict[str, _OnMesh]
    end: MeshBefore | None
    reinforced: Mapping[str, float]


def _analyse(design: DesignOnMeshes, mesh, run, start) -> _Found:
    """Analyse one mesh.

    `run` analyses it from `start`, what is known before.
    """
    folded, material = dict(design.folded), design.material
    arrays = mesh_folded_sheet(folded, design.support, **mesh, edge_beam=design.edge_beam)
    model = build_supported_model(mesh_from_arrays(arrays), arrays, material.poissons_ratio)
    thickness = model.to_elements(design.panel_thickness)
    analysis = ShellAnalysis(model, thickness, material, design.cases, design.combinations)
    result = run(analysis, model, start)
    if result.state == "mechanism":
        raise MechanismError(result.reason)
    first = replace(result, displacement=result.first_order, second_order=None)
    values = _measure(model, first, thickness, material, arrays)
    for column, name in enumerate(result.names):
        factor = float(result.buckling.factors[column]) if result.buckling else 0.0
        values[name] = replace(values[name], buckling_factor=min(factor, LARGEST_FACTOR))
    if result.state == "ok":
        for name, second in _measure(model, result, thickness, material, arrays).items():
            values[name] = replace(values[name], second_order=second)
    steel = {}
    if design.concrete is not None and not is_curved(folded):
        own = design.panel_thickness, material, design.concrete
        steel = measure_reinforced(model, result, *own)
    return _Found(values, remember(model, result), steel)


def _measure(model, result, thickness, material, arrays) -> dict[str, _OnMesh]:
    """Return the quantities of each combination of a result."""
    used = compute_utilization(
        model, result.displacement, thickness, material, result.imposed
    ).combination
    reactions = support_reactions(model, result, thickness, material)
    edges = sum_supports(model.mesh, arrays, model.supported_nodes, reactions)
    total = reactions.sum(axis=0)
    load = translations(model, result.loads).sum(axis=0)
    moved = translations(model, result.displacement)
    work = (result.displacement * result.loads).sum(axis=0)
    return {
        name: _OnMesh(
            displacement_down_max_m=largest_downward(
                model, result.displacement[:, [column]], [name]
            )[0],
            displacement_max_m=float(np.linalg.norm(moved[:, :, column], axis=1).max()),
            work_knm=float(work[column]),
            utilization_p99=area_percentile(model, used[column]),
            utilization_panel_mean_max=float(
                panel_utilization(model, used[column].mean(axis=2), "panel_mean").max()
            ),
            reaction_sum_kn=tuple(total[:, column].tolist()),
            support_reactions_kn={
                name: tuple(force[:, column].tolist()) for name, force in edges.items()
            },
            load_sum_kn=tuple(load[:, column].tolist()),
        )
        for column, name in enumerate(result.names)
    }
