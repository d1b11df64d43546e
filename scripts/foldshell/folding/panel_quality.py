"""Quality of a folded sheet of any panels: what was distorted, what crumpled, what was missed."""

from dataclasses import dataclass

import numpy as np

from foldshell.folding.intersections import find_intersections
from foldshell.folding.quality import (
    measure_coverage,
    measure_planarity,
    measure_strain,
    root_mean_square,
)
from foldshell.pattern.angles import measure_hinges, measure_sectors
from foldshell.pattern.grid import find_hinges
from foldshell.pattern.panel_graph import Ragged, list_half_edges
from foldshell.pattern.panel_mesh import PanelMesh, measure_warp
from foldshell.pattern.panel_repair import measure_normals
from foldshell.records.quality import QualityMeasures


@dataclass(frozen=True)
class FacetNet:
    """Facets (F, 3) of panels and the panel (F,) of each, and all edges between facets.

    `edges` (E, 2) are the sides of panels in the order of the mesh, then the cuts inside panels,
    whose letter is N; `letters` (E,).
    """

    facets: np.ndarray
    facet_panel: np.ndarray
    edges: np.ndarray
    letters: np.ndarray


def make_facet_net(mesh: PanelMesh) -> FacetNet:
    """Cut the panels of a mesh into facets, and list the edges between them."""
    facets = mesh.facets
    sides = np.sort(mesh.edges, axis=1)
    every = np.unique(np.sort(facets[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)
    width = int(facets.max()) + 1
    cuts = every[~np.isin(every @ [width, 1], sides @ [width, 1])]
    letters = np.concatenate([mesh.assignments, np.full(len(cuts), "N")])
    return FacetNet(facets, mesh.facet_panel, np.vstack([mesh.edges, cuts]), letters)


def measure_panel_quality(
    mesh: PanelMesh,
    net: FacetNet,
    distances: np.ndarray | None = None,
    sides: tuple[float, float] = (0.0, 0.0),
) -> QualityMeasures:
    """Measure the folded state of a mesh; signed distances (N,) m to a target over a plan of two
    `sides` m, None for none."""
    vertices, span = mesh.vertices, min(sides)
    hinges = find_hinges(net.facets, net.edges)
    letters = net.letters[hinges.edges]
    folds = measure_hinges(vertices, hinges.vertices)
    warp = measure_panel_warp(vertices, mesh.panels)
    strain = measure_edge_strain(mesh, net.edges)
    inner = np.degrees(np.abs(folds[letters == "N"]))
    off = distances is not None
    return QualityMeasures(
        rms_over_span=root_mean_square(distances) / span if off else None,
        max_over_span=float(np.abs(distances).max(initial=0.0)) / span if off else None,
        edge_strain_max=None if strain is None else float(np.abs(strain).max()),
        edge_strain_rms=None if strain is None else root_mean_square(strain),
        angle_defect_max_rad=float(np.abs(measure_defects(vertices, net.facets)).max(initial=0.0)),
        planarity_max=float(warp.max()),
        planarity_mean=float(warp.mean()),
        neutral_fold_mean_deg=float(inner.mean()) if len(inner) else 0.0,
        neutral_fold_max_deg=float(inner.max(initial=0.0)),
        flipped_folds=count_turned(folds, letters),
        self_intersections=len(find_intersections(vertices, net.facets)),
        plan_coverage=measure_coverage(vertices, net.facets, sides) if off else None,
        panels_not_convex=count_not_convex(vertices, mesh.panels),
        edge_ratio_max=float(measure_side_ratio(vertices, mesh.panels).max()),
    )


def count_turned(folds: np.ndarray, letters: np.ndarray) -> int:
    """Number of folds (E,) [rad] that go against their letters (E,)."""
    return int((((letters == "V") & (folds < 0)) | ((letters == "M") & (folds > 0))).sum())


def measure_panel_warp(vertices: np.ndarray, panels: Ragged) -> np.ndarray:
    """Return how far panels (P,) are from a plane, over their diagonals, without unit.

    Distance of both diagonals of a quadrilateral; for more corners see `measure_warp`.

    vertices (V, 3) m.
    """
    sizes = np.diff(panels.starts)
    warp = np.zeros(len(panels))
    quads = np.flatnonzero(sizes == 4)
    corners = panels.corners[panels.starts[quads][:, None] + np.arange(4)]
    warp[quads] = measure_planarity(vertices, corners)
    larger = np.flatnonzero(sizes > 4)
    if len(larger):
        rows = [panels[int(k)] for k in larger]
        starts = np.concatenate([[0], np.cumsum(sizes[larger])])
        warp[larger] = measure_warp(vertices, Ragged(starts, np.concatenate(rows)))
    return warp


def measure_edge_strain(mesh: PanelMesh, edges: np.ndarray) -> np.ndarray | None:
    """Strain (E,) without unit of edges, folded against flat, None without a flat state."""
    if mesh.flat is None:
        return None
    lengths = [
        np.linalg.norm(state[edges[:, 1]] - state[edges[:, 0]], axis=1)
        for state in (mesh.vertices, mesh.flat)
    ]
    return lengths[0] / lengths[1] - 1


def measure_facet_strain(mesh: PanelMesh, facets: np.ndarray) -> np.ndarray | None:
    """Largest strain (F,) without unit of each facet's edges, None without a flat state."""
    return None if mesh.flat is None else measure_strain(mesh.vertices, mesh.flat, facets)


def measure_defects(vertices: np.ndarray, facets: np.ndarray) -> np.ndarray:
    """Sum of the facet angles about each vertex inside the sheet, less 2 pi (N,) [rad].

    vertices (V, 3) m, facets (F, 3).
    """
    corners = np.stack([np.roll(facets, -k, axis=1) for k in range(3)]).reshape(-1, 3)
    total = np.zeros(len(vertices))
    np.add.at(total, corners[:, 0], measure_sectors(vertices, corners))
    inside = np.isin(np.arange(len(vertices)), facets)
    sides, number = np.unique(
        np.sort(facets[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1),
        axis=0, return_counts=True,
    )  # fmt: skip
    inside[sides[number != 2]] = False
    return total[inside] - 2 * np.pi


def count_not_convex(vertices: np.ndarray, panels: Ragged) -> int:
    """Number of panels with a corner that turns inward about the panel's normal.

    A corner in the middle of a straight side counts as none. vertices (V, 3) m.
    """
    half, panel = list_half_edges(panels)
    ahead = vertices[half[:, 1]] - vertices[half[:, 0]]
    first = panels.starts[:-1]
    before = np.arange(-1, len(half) - 1)
    before[first] = panels.starts[1:] - 1
    normal = measure_normals(vertices, panels)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    turn = np.einsum("ij,ij->i", np.cross(ahead[before], ahead), normal[panel])
    size = np.linalg.norm(ahead, axis=1)
    return int(np.logical_or.reduceat(turn < -1e-9 * size * size[before], first).sum())


def measure_side_ratio(vertices: np.ndarray, panels: Ragged) -> np.ndarray:
    """Longest over shortest side of each panel (P,). vertices (V, 3) m."""
    half, _ = list_half_edges(panels)
    length = np.linalg.norm(vertices[half[:, 1]] - vertices[half[:, 0]], axis=1)
    first = panels.starts[:-1]
    return np.maximum.reduceat(length, first) / np.minimum.reduceat(length, first)
