"""What the 3D view of a page shows: geometry, creases, fields with their scales, shapes."""

from dataclasses import dataclass

import numpy as np

from foldshell.files.whole import Json
from foldshell.pattern.folded_panels import measure_middles
from foldshell.records.arrays import list_arrays
from foldshell.results.colour_scales import (
    RATIO_RANGE_MIN,
    ColourScale,
    exaggeration,
    make_limit_scale,
    make_scale,
)
from foldshell.results.design_view import DesignView
from foldshell.results.fields import choose_buckling, choose_deflection
from foldshell.results.state import DesignState
from foldshell.shell.held_supports import list_supported_vertices
from foldshell.shell.mesh import edge_polyline_nodes

COLOURS = 64
"""Colours of each map that the page interpolates between."""
MODE_SHARE = 0.06
"""Share of the span of a buckling mode's largest translation, in the middle of the slider."""
CELLS_MAX = 40_000
"""Sheets of more result cells are shown by their facets, so that the page stays small."""


@dataclass(frozen=True)
class ViewerData:
    """Arrays for `pack_arrays`, and what the page must know about them as plain data."""

    arrays: dict[str, np.ndarray]
    facts: Json


@dataclass(frozen=True)
class Grid:
    """Triangles of the view, each of `per_triangle` result cells, and nodes along its creases."""

    nodes: np.ndarray
    triangles: np.ndarray
    panel: np.ndarray
    creases: dict[str, np.ndarray]
    supports: np.ndarray
    per_triangle: int = 1

    def at_triangles(self, cells: np.ndarray) -> np.ndarray:
        """Return the largest of the cell values (C,) in each triangle, in their unit."""
        return cells.reshape(-1, self.per_triangle).max(axis=1)

    def at_nodes(self, values: np.ndarray) -> np.ndarray:
        """Return the node values (N, ...) of the result mesh that the view keeps, in their unit."""
        return values[: len(self.nodes)]


def make_grid(view: DesignView) -> Grid:
    """Return the result cells, or the facets alone of a sheet of very many.

    The first nodes of a mesh are the sheet's vertices, and cells follow facet by facet.
    """
    state, creases = view.state, view.creases
    kinds = {kind: getattr(creases, kind) for kind in ("mountain", "valley", "flat", "border")}
    shell = list_arrays(state.shell)
    if len(state.triangles) <= CELLS_MAX:
        held = edge_polyline_nodes(state.cells, state.shell.support_pairs)
        supports = np.union1d(held, list_supported_vertices(shell))
        return Grid(state.cells.nodes, state.triangles, state.cell_panel, kinds, supports)
    facets = state.shell.facets
    ends = {kind: lines[:, [0, -1]] for kind, lines in kinds.items()}
    return Grid(state.shell.vertices, facets, state.shell.facet_panel, ends,
                 list_supported_vertices(shell), len(state.triangles) // len(facets))  # fmt: skip


def _bring_near(nodes: np.ndarray) -> np.ndarray:
    """Nodes (N, 3) m about their middle where single precision has too few digits for them."""
    far = np.abs(nodes).max() > 100 * np.ptp(nodes, axis=0).max()
    return nodes - nodes.mean(axis=0) if far else nodes


def make_viewer_data(view: DesignView, grid: Grid | None = None) -> ViewerData:
    """Return the view of a design; fields and shapes that its state lacks are left out.

    Arrays: nodes (N, 3) m; triangles (C, 3); panel (C,); mountain, valley, flat, border (K, n)
    nodes along creases; supports (S,) nodes; of each panel thickness (m), utilization, planarity,
    zigzag and strip, or the mean (P, 3) m of the corners where there are none; and those that
    `facts["fields"]` and `facts["shapes"]` name.
    """
    state, grid = view.state, grid or make_grid(view)
    arrays = {"nodes": _bring_near(grid.nodes), "triangles": grid.triangles, "panel": grid.panel}
    arrays |= {f"crease_{kind}": nodes for kind, nodes in grid.creases.items()}
    arrays |= {"supports": grid.supports} | _panel_values(state)
    fields, values = [], {}
    for name, (words, array, scale, options) in _fields(view, grid).items():
        values[f"field_{name}"] = array
        fields.append({"name": name, "words": words} | scale.describe(COLOURS) | options)
    shapes = []
    for name, words, moved, factor in _shapes(view, grid):
        values[f"shape_{name}"] = moved
        shapes.append({"name": name, "words": words, "factor": factor})
    facts = {"fields": fields, "shapes": shapes, "facets": len(state.shell.facets)}
    return ViewerData(arrays | values, facts)


def _panel_values(state: DesignState) -> dict[str, np.ndarray]:
    """Return what picking a panel shows, (P,).

    Thickness and utilization are (P + B,) with an edge beam's panels.
    """
    folded = state.folded
    values = {
        "panel_thickness": state.panel_thickness,
        "panel_planarity": folded.planarity,
    }
    if folded.zigzag is None:
        values["panel_middle"] = measure_middles(folded)
    else:
        values["panel_zigzag"] = folded.zigzag[folded.quads].min(axis=1)
        values["panel_strip"] = folded.strip[folded.quads].min(axis=1)
    if state.utilization is not None:
        values["panel_utilization"] = state.panel_utilization
    if state.classes is not None:
        values["panel_class"] = state.classes.panel_class
    return values


def _pad(state: DesignState, values: np.ndarray) -> np.ndarray:
    """Return panel values (P,) with nan for the panels of an edge beam behind them, (P + B,)."""
    return np.append(values, np.full(len(state.edge_beam_thickness), np.nan))


def _fields(view: DesignView, grid: Grid) -> dict[str, tuple]:
    """Return words with unit, values at panels, triangles or nodes, scale, options by name."""
    state = view.state
    thickness = 1e3 * state.panel_thickness
    scale = make_scale(thickness, "YlGnBu")
    fields = {"thickness": ("thickness [mm]", thickness, scale, {"at": "panel"})}
    if state.utilization is not None:
        fields |= _utilization_fields(view, grid)
    if state.usable:
        name = choose_deflection(state)
        down = -1e3 * grid.at_nodes(state.displacement_at_nodes(name))[:, 2]
        words = f"vertical displacement, down [mm], {name}"
        fields["displacement"] = words, down, make_scale(down, "YlGnBu"), {"at": "node"}
    if state.classes is not None:
        fields["class"] = _class_field(state)
    planarity = 100 * _pad(state, state.folded.planarity)
    words = "planarity: distance of diagonals / their mean length [%]"
    scale = make_scale(planarity, zero=True, least=RATIO_RANGE_MIN)
    fields["planarity"] = words, planarity, scale, {"at": "panel"}
    return fields


def _utilization_fields(view: DesignView, grid: Grid) -> dict[str, tuple]:
    state, limit = view.state, view.sizing.utilization_max
    combinations = f"{state.strength[0]} to {state.strength[-1]}"
    found = {}
    for name, words, values, at in (
        ("utilization", "utilization of cells [-], largest of",
         grid.at_triangles(state.utilization), "triangle"),
        ("utilization_mean", "panel mean of utilization [-], largest of",
         state.panel_utilization, "panel"),
    ):  # fmt: skip
        most = float(np.nanmax(values))
        above = f"up to {most:.2f}" if most > limit else "none"
        scale = make_limit_scale(values, limit)
        found[name] = f"{words} {combinations}", values, scale, {"at": at, "above": above}
    return found


def _class_field(state: DesignState) -> tuple:
    """Return the number of each panel's class, with their thicknesses for the legend."""
    number, thickness = state.classes.panel_class, 1e3 * state.classes.thickness
    count = int(number.max())
    names = {
        k: f"{k}: {thickness[number == k].max():.0f} mm" if (number == k).any() else str(k)
        for k in range(1, count + 1)
    }
    scale = ColourScale(0.5, count + 0.5, "YlGnBu")
    options = {"at": "panel", "classes": names}
    return "class of thickness for fabrication", _pad(state, number), scale, options


def _shapes(view: DesignView, grid: Grid) -> list[tuple[str, str, np.ndarray, float]]:
    """Return name, words, translations (N, 3) m and their factor in the middle of the slider."""
    state, shapes = view.state, []
    if state.usable:
        name = choose_deflection(state)
        moved = grid.at_nodes(state.displacement_at_nodes(name))
        shapes.append(("displacement", f"displacement of {name}", moved,
                       exaggeration(moved, view.span)))  # fmt: skip
    least = choose_buckling(state)
    if least is not None:
        name, factor = least
        mode = grid.at_nodes(state.buckling_mode(name))
        words = f"buckling mode of {name}, factor {factor:.2f}"
        shapes.append(("buckling", words, mode, MODE_SHARE * view.span))
    return shapes
