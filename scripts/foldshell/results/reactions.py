"""Reactions of a final state at its supported nodes and edges, and resultants of its loads."""

from dataclasses import dataclass

import numpy as np

from foldshell.loads.cases import combination_matrix, make_load_cases
from foldshell.records.arrays import list_arrays
from foldshell.results.design_view import DesignView
from foldshell.results.state import DesignState
from foldshell.settings.stage import StageSettings
from foldshell.shell.analysis import AnalysisResult, ShellModel
from foldshell.shell.boundary import find_acting, list_nodes
from foldshell.shell.held_supports import find_boundary, list_holds, sum_supports
from foldshell.shell.nodal_loads import nodal_forces, sum_loads
from foldshell.shell.placed_loads import place_loads
from foldshell.shell.results import support_reactions
from foldshell.shell.support_rows import describe_hold, measure_hold


@dataclass(frozen=True)
class SupportedEdge:
    """One support: its name, the middle of its nodes (3,) m, and the resultant (3, c) kN of the
    reactions there in each of c combinations; how many vertices it holds, the length of its edges
    in m, and in words how it holds them."""

    name: str
    place: np.ndarray
    force: np.ndarray
    vertices: int = 0
    length: float = 0.0
    words: str = ""


@dataclass(frozen=True)
class Reactions:
    """Supports and loads of a state.

    Attributes
    ----------
    combinations : names, c of them
    node : (S,) supported nodes of the shell mesh
    force : (S, 3, c) kN, what the supports exert on the shell
    edges : resultants by supported edge; a node on a corner counts by half for each
    cases : load cases, and `resultant` (3, cases) kN, the sum of each over the shell
    moment : (3, cases) kNm of each about the origin
    """

    combinations: tuple[str, ...]
    node: np.ndarray
    force: np.ndarray
    edges: tuple[SupportedEdge, ...]
    cases: tuple[str, ...]
    resultant: np.ndarray
    moment: np.ndarray


def find_reactions(view: DesignView, settings: StageSettings) -> Reactions | None:
    """R = int B^T sigma dA + K_g u - f at the supports, from the displacements of the final state;
    None without finite ones.

    `settings` are those of stage `size`.
    """
    state, material = view.state, settings.material
    if not state.usable:
        return None
    model = _model_of(view)
    thickness = model.to_elements(state.final.thickness)
    cases = make_load_cases(settings.loads, material.unit_weight)
    placed = place_loads(model.operators, model.self_weight_only, cases)
    surface = placed.at(thickness)
    factors = combination_matrix(settings.combinations.all, placed.names)
    loads = nodal_forces(model.operators, surface) @ factors
    moved = state.final.displacement
    second = settings.analysis.second_order and state.report.state == "ok"
    result = AnalysisResult("ok", "", state.combinations, moved, moved, loads,
                            second_order=second or None,
                            imposed=state.final.imposed_strain)  # fmt: skip
    force = support_reactions(model, result, thickness, material)
    resultant, moment = sum_loads(model.operators, surface)
    return Reactions(
        combinations=state.combinations,
        node=model.supported_nodes,
        force=force,
        edges=_sum_edges(state, model.supported_nodes, force),
        cases=placed.names,
        resultant=resultant,
        moment=moment,
    )


def _model_of(view: DesignView) -> ShellModel:
    """Return the model of a view's mesh, without the pattern of its equations: none are solved."""
    state = view.state
    held, beam, acting = state.shell.supported_nodes, state.edge_beam_thickness, None
    boundary = find_boundary(state.mesh, list_arrays(state.shell))
    if boundary is not None:
        held, acting = find_acting(state.mesh, boundary.fixed, boundary.springs)
    return ShellModel(state.mesh, view.operators, None, held, beam, acting)


def _sum_edges(
    state: DesignState, node: np.ndarray, force: np.ndarray
) -> tuple[SupportedEdge, ...]:
    """Return the resultants by support: border polylines, zig-zags first, or rows of a set."""
    arrays, mesh = list_arrays(state.shell), state.mesh
    holds, found = list_holds(arrays), sum_supports(mesh, arrays, node, force)
    edges = []
    for name, total in found.items():
        own = np.intersect1d(list_nodes(mesh, holds[name]), node)
        sizes = measure_hold(state.shell.vertices, holds[name])
        place = mesh.nodes[own].mean(axis=0)
        edges.append(SupportedEdge(name, place, total, *sizes, describe_hold(holds[name])))
    return tuple(edges)
