"""What the page's 3D view shows of single combinations: fields, shapes, loads, reactions."""

from pathlib import Path
from typing import Any

import numpy as np

from foldshell.loads.cases import make_load_cases
from foldshell.records.analysis_arrays import IterationsArrays
from foldshell.records.arrays import list_arrays, read_typed_arrays
from foldshell.report.loads_section import describe_loads
from foldshell.report.viewer_data import COLOURS, Grid, ViewerData
from foldshell.results.colour_scales import (
    ColourScale,
    exaggeration,
    make_limit_scale,
    make_scale,
)
from foldshell.results.combination_fields import CombinationFields, evaluate_combinations
from foldshell.results.design_view import DesignView
from foldshell.results.fields import cell_area, choose_deflection
from foldshell.results.reactions import Reactions, find_reactions
from foldshell.results.state import DesignState
from foldshell.settings.stage import StageSettings
from foldshell.shell.held_supports import list_supported_vertices
from foldshell.shell.nodal_loads import mean_loads
from foldshell.shell.placed_loads import place_loads
from foldshell.shell.stiffness import ShellOperators

QUANTITIES = {
    "used": ("utilization of cells [-]", "triangle"),
    "down": ("vertical displacement, down [mm]", "node"),
    "n1": ("larger principal membrane force of a panel [kN/m]", "panel"),
    "n2": ("lesser principal membrane force of a panel [kN/m]", "panel"),
    "m1": ("largest principal moment of a panel, either sign [kNm/m]", "panel"),
}
"""What colours a single combination: words with unit, and where its values stand."""


def make_more_data(
    view: DesignView, grid: Grid, settings: StageSettings, iterations: str | Path
) -> ViewerData:
    """Return what the view shows of combinations, and the thickness (I, P) m of all iterations of
    the sizing loop from iterations.npz."""
    found = make_combination_data(view, grid, find_reactions(view, settings), settings)
    thickness = read_typed_arrays(iterations, IterationsArrays).thickness
    arrays = found.arrays | {"iteration_thickness": thickness}
    return ViewerData(arrays, found.facts | {"iterations": list(range(len(thickness)))})


def add_combinations(viewer: ViewerData, more: ViewerData) -> ViewerData:
    """Return both together; the displacement that the envelope shows is that of a combination, so
    that it need not stand twice."""
    arrays = viewer.arrays | more.arrays
    if "moved" in more.arrays:
        for name in ("shape_displacement", "field_displacement"):
            arrays.pop(name, None)
    return ViewerData(arrays, viewer.facts | more.facts)


def make_coarse(more: ViewerData, cells: int) -> ViewerData:
    """Return the same for a page that would grow too large: displacements to be looked at only, and
    the largest utilization of `cells` triangles, those of a facet, at once."""
    if not more.arrays.get("used", np.empty(0)).size:
        return more
    used = more.arrays["used"]
    largest = used.reshape(len(used), -1, cells).max(axis=2)
    coarse = {"moved": more.arrays["moved"].astype(np.float32), "used": largest}
    return ViewerData(more.arrays | coarse, more.facts)


def make_combination_data(
    view: DesignView, grid: Grid, reactions: Reactions | None, settings: StageSettings
) -> ViewerData:
    """Return arrays and facts of each combination; nothing without finite displacements.

    Arrays: moved (c, N, 3) m, used (s, T) utilization of strength combinations, sections
    (c, P, 8) panel means nx, ny, nxy, mx, my, mxy, vx, vy in kN and m, case_force (k, P, 3) kN of
    each load case on each panel, reaction (c, S, 3) kN at the nodes reaction_node (S,).
    """
    state = view.state
    if reactions is None:
        return ViewerData({}, {"combinations": [], "quantities": []})
    found = evaluate_combinations(state, settings.material, view.operators)
    moved = np.ascontiguousarray(state.all_displacements()[:, : len(grid.nodes)])
    used = np.stack([grid.at_triangles(values) for values in found.utilization])
    sections = average_panels(state, found)
    nodes, forces = gather_reactions(state, reactions)
    arrays = {
        "moved": moved,
        "used": used,
        "sections": sections,
        "case_force": sum_cases(state, settings, view.operators),
        "reaction": forces,
        "reaction_node": nodes,
    }
    facts = {
        "combinations": _describe(view, reactions, settings, moved),
        "quantities": _scales(view, moved, used, sections),
        "cases": [
            [case.name, f"{case.name}: {case.words}, {case.size}"]
            for case in describe_loads(settings).cases
        ],
        "size": view.size,
        "displaced": state.combinations.index(choose_deflection(state)),
    }
    return ViewerData(arrays, facts)


def average_panels(state: DesignState, found: CombinationFields) -> np.ndarray:
    """Return area means over each panel of n, m, v, (c, P, 8) kN/m, kNm/m, kN/m."""
    values = np.concatenate([found.force, found.moment, found.shear], axis=2)
    area, panel = cell_area(state), state.cell_panel
    total = np.bincount(panel, area)
    sums = [
        [np.bincount(panel, area * values[k, :, i]) / total for i in range(values.shape[2])]
        for k in range(len(values))
    ]
    return np.moveaxis(np.array(sums), 1, 2)


def sum_cases(state: DesignState, settings: StageSettings, operators: ShellOperators) -> np.ndarray:
    """Return the resultant (k, P, 3) kN of each load case on each panel."""
    panel, sized = state.mesh.panel, len(state.final.thickness)
    cases = make_load_cases(settings.loads, settings.material.unit_weight)
    placed = place_loads(operators, panel >= sized, cases)
    loads = mean_loads(operators, placed.at(state.panel_thickness[panel]))
    loads = loads * operators.geometry.area[:, None, None]
    return np.array(
        [[np.bincount(panel, loads[:, x, k]) for x in range(3)] for k in range(len(placed.names))]
    ).swapaxes(1, 2)


def gather_reactions(state: DesignState, reactions: Reactions) -> tuple[np.ndarray, np.ndarray]:
    """Return the supported vertices (S,) and at each the sum (c, S, 3) kN of the reactions of the
    nodes that are nearest to it."""
    vertices = list_supported_vertices(list_arrays(state.shell))
    away = state.mesh.nodes[reactions.node][:, None] - state.shell.vertices[vertices]
    nearest = np.linalg.norm(away, axis=2).argmin(axis=1)
    sums = np.zeros((len(vertices), *reactions.force.shape[1:]))
    np.add.at(sums, nearest, reactions.force)
    return vertices, np.moveaxis(sums, 2, 0)


def principal_values(tensor: np.ndarray) -> np.ndarray:
    """Return the larger and the lesser principal value (2, ...) of xx, yy, xy (..., 3), in the
    same unit."""
    mean, half = (tensor[..., 0] + tensor[..., 1]) / 2, (tensor[..., 0] - tensor[..., 1]) / 2
    radius = np.hypot(half, tensor[..., 2])
    return np.stack([mean + radius, mean - radius])


def _describe(
    view: DesignView, reactions: Reactions, settings: StageSettings, moved: np.ndarray
) -> list[dict[str, Any]]:
    """Return name, words, factors by case, drawing factor and edge resultants of each."""
    given, found = settings.combinations.all, []
    for k, name in enumerate(view.state.combinations):
        words = " + ".join(f"{value:g} {case}" for case, value in given[name].items())
        edges = [[edge.name, [round(float(v), 1) for v in edge.force[:, k]]]
                 for edge in reactions.edges]  # fmt: skip
        factors = [given[name].get(case, 0.0) for case in reactions.cases]
        found.append({"name": name, "words": words, "factors": factors, "edges": edges,
                      "drawn": exaggeration(moved[k], view.span)})  # fmt: skip
    return found


def _scales(
    view: DesignView, moved: np.ndarray, used: np.ndarray, sections: np.ndarray
) -> list[dict[str, Any]]:
    """Return the quantities with one scale for all combinations."""
    limit = view.sizing.utilization_max
    force, moment = (principal_values(sections[..., k : k + 3]) for k in (0, 3))
    scales: dict[str, ColourScale] = {
        "used": make_limit_scale(used, limit),
        "down": make_scale(-1e3 * moved[..., 2], "YlGnBu"),
        "n1": make_scale(force[0], "cividis"),
        "n2": make_scale(force[1], "cividis"),
        "m1": make_scale(np.abs(moment).max(axis=0), "YlGnBu", zero=True),
    }
    return [
        {"name": name, "words": words, "at": at, "above": "above the limit"}
        | scales[name].describe(COLOURS)
        for name, (words, at) in QUANTITIES.items()
    ]
