"""folded.npz and mesh.npz: the folded sheet, and the shell mesh on it.

Axes: V vertices, P panels, T facets; N nodes, E elements, L nodes of an element, G edges of facets,
J nodes along one; S supported edges of facets, H supported nodes, B panels of an edge beam; R rows
of a set of supports, Q vertices that they hold, W warnings of them; of any sheet D panels and one
more, C corners of all panels, X sides of panels; A and K points of a smooth surface; of a sheet cut
by an outline O corners of that, I vertices, U pieces and Y one more, Z corners of all pieces, M
sides of pieces. In
mesh.npz vertices, facets and panels of an edge beam stand after those of the sheet.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.records.arrays import array


@dataclass(frozen=True, kw_only=True)
class FoldedArrays:
    """The arrays of folded.npz."""

    vertices: np.ndarray = array("V, 3", "m", "vertices of the folded sheet", required=True)
    facets: np.ndarray = array(
        "T, 3", "", "vertices of each facet, in the order of panels", required=True
    )
    planarity: np.ndarray = array(
        "P", "-", "distance between a panel's diagonals, over their mean length; of one of more "
        "corners their largest distance to the mean plane, over the longest diagonal",
        required=True,
    )  # fmt: skip
    quads: np.ndarray | None = array(
        "P, 4", "", "vertices of each panel of a crease grid, which has two facets a panel"
    )
    zigzag: np.ndarray | None = array("V", "", "zig-zag polyline of each vertex, from 0")
    strip: np.ndarray | None = array("V", "", "strip polyline of each vertex, from 0")
    facet_panel: np.ndarray | None = array("T", "", "panel of each facet, where it is no grid")
    panel_starts: np.ndarray | None = array(
        "D", "", "first corner of each panel in panel_corners, and their number"
    )
    panel_corners: np.ndarray | None = array("C", "", "vertices of all panels, one after the other")
    edges: np.ndarray | None = array("X, 2", "", "vertices of each side of a panel")
    edge_kind: np.ndarray | None = array(
        "X", "", "how each side folds: 0 border, 1 mountain, 2 valley, 3 flat, 4 not assigned"
    )
    flat: np.ndarray | None = array("V, 3", "m", "vertices of the flat sheet, where there is one")
    strain: np.ndarray | None = array(
        "T", "-", "largest strain of a facet's edges, where the flat sheet is known"
    )
    panel_row: np.ndarray | None = array("P", "", "row of each panel, where the pattern has rows")
    surface: np.ndarray | None = array(
        "A, K, 3",
        "m",
        "points of the target surface itself, of a smooth shell: six steps a panel "
        "from zig-zag to zig-zag (A) and from strip to strip (K)",
    )
    panel_place: np.ndarray | None = array("P", "", "place of each panel in its row")
    outline: np.ndarray | None = array("O, 2", "m", "corners of the outline that cut the sheet")
    cut_vertices: np.ndarray | None = array(
        "I, 3", "m", "vertices of the pieces as an outline cuts them; the panels are these with "
        "short sides collapsed"
    )  # fmt: skip
    cut_flat: np.ndarray | None = array("I, 3", "m", "the same in the flat sheet")
    cut_starts: np.ndarray | None = array("Y", "", "first corner of each piece in cut_corners")
    cut_corners: np.ndarray | None = array("Z", "", "vertices of all pieces")
    cut_panel: np.ndarray | None = array("U", "", "panel that each piece is sized with")
    cut_edges: np.ndarray | None = array("M, 2", "", "vertices of each side between pieces")
    cut_edge_kind: np.ndarray | None = array("M", "", "how each folds, as edge_kind")


@dataclass(frozen=True, kw_only=True)
class MeshArrays:
    """The arrays of mesh.npz."""

    nodes: np.ndarray = array("N, 3", "m", "nodes", required=True)
    elements: np.ndarray = array(
        "E, L", "", "nodes of each element in lattice order", required=True
    )
    element_edges: np.ndarray = array("E, 3", "", "edges of each element", required=True)
    edge_signs: np.ndarray = array(
        "E, 3", "", "1 where an element runs along the edge's own direction, else -1", required=True
    )
    edge_count: np.ndarray = array("", "", "edges in all", required=True)
    order: np.ndarray = array("", "", "polynomial order of the elements", required=True)
    subdivisions: np.ndarray = array("", "", "elements along the edge of a facet", required=True)
    cells: np.ndarray = array("", "", "result cells along the edge of an element", required=True)
    facet: np.ndarray = array("E", "", "facet of each element", required=True)
    panel: np.ndarray = array("E", "", "panel of each element", required=True)
    node_pairs: np.ndarray = array("G, 2", "", "vertices of each edge of a facet", required=True)
    pair_nodes: np.ndarray = array("G, J", "", "nodes along it", required=True)
    vertices: np.ndarray = array("V, 3", "m", "vertices", required=True)
    facets: np.ndarray = array("T, 3", "", "vertices of each facet", required=True)
    facet_panel: np.ndarray = array("T", "", "panel of each facet", required=True)
    support_pairs: np.ndarray = array(
        "S, 2", "", "vertices of each supported edge of a facet", required=True
    )
    support_border: np.ndarray | None = array(
        "S", "", "border of the sheet that it lies on, or row of the set of supports that holds it"
    )
    supported_nodes: np.ndarray = array("H", "", "supported nodes", required=True)
    fixed_thickness: np.ndarray | None = array(
        "B", "m", "thickness of the panels of an edge beam, the last ones"
    )
    support_names: np.ndarray | None = array(
        "R", "", "name of each row of the set of supports, where the design names a set"
    )
    support_fix: np.ndarray | None = array("R, 3", "", "whether it holds x, y, z")
    support_clamp: np.ndarray | None = array("R", "", "whether it holds rotations about its edges")
    support_spring: np.ndarray | None = array(
        "R, 3", "", "its springs along x, y, z, kN/m per m of edge or kN/m at vertices"
    )
    support_vertices: np.ndarray | None = array("Q", "", "vertices that rows hold by themselves")
    support_vertex_row: np.ndarray | None = array("Q", "", "row that holds each of them")
    support_warnings: np.ndarray | None = array("W", "", "what is to be said of the supports")
    support_reports: np.ndarray | None = array("R", "", "what each row holds, as a sentence")
