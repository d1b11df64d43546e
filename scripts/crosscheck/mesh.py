"""Nine-node quadrilaterals on flat triangles.

Each facet is cut into three quadrilaterals by lines from its centroid to the middles of its
sides, and each of these blocks into m x m elements, smaller towards the facet's corners. Nodes
on a facet's outline come first and are shared with its neighbours (the skeleton); the others
belong to one facet.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

GRADING = 2.0
"""Element borders stand at (k/m)^GRADING from a facet's corner: moments rise without bound at
the corners, where the folds meet, and an even mesh of as many elements has ten times the error."""


@dataclass(frozen=True)
class ReferenceFacet:
    """The node layout that every facet repeats, for m elements along a block's side.

    Nodes are ordered: outline (12 m, from corner 0 round by 1 and 2), spokes, then what is inside
    each block, block after block in the order of `block_interior`.
    """

    barycentric: np.ndarray  # (R, 3)
    blocks: np.ndarray  # (3, (2m+1)^2) nodes of each block, row by row
    outline: int  # number of outline nodes
    spokes: int  # number of nodes on the lines to the centroid, the centroid included
    elements: np.ndarray  # (m^2, 9) positions in a block, r fastest
    block_boundary: np.ndarray  # positions in a block on its outline
    block_interior: np.ndarray


@dataclass(frozen=True)
class Mesh:
    """Nodes, and for every facet the node at each place of the reference facet."""

    nodes: np.ndarray  # (N, 3) m
    facet_nodes: np.ndarray  # (F, R)
    skeleton: int  # number of nodes on facet outlines; they are numbered first
    edges: np.ndarray  # (E, 2) vertex pairs, ascending
    edge_nodes: np.ndarray  # (E, 4m+1) nodes along each edge, ends included
    reference: ReferenceFacet


def _block_grid(m: int, grading: float) -> np.ndarray:
    """Barycentric coordinates (3, (2m+1)^2, 3) of the three blocks, corner vertex first."""
    ends = np.linspace(0.0, 1.0, m + 1) ** grading
    step = np.interp(np.arange(2 * m + 1) / 2, np.arange(m + 1), ends)
    s, r = (grid.ravel()[:, None] for grid in np.meshgrid(step, step, indexing="ij"))
    corner = np.eye(3)
    centroid = np.full(3, 1 / 3)
    blocks = []
    for a in range(3):
        after, before = (a + 1) % 3, (a + 2) % 3
        mid_after = (corner[a] + corner[after]) / 2
        mid_before = (corner[a] + corner[before]) / 2
        blocks.append(
            (1 - r) * (1 - s) * corner[a]
            + r * (1 - s) * mid_after
            + r * s * centroid
            + (1 - r) * s * mid_before
        )
    return np.array(blocks)


@cache
def build_reference_facet(m: int, grading: float = GRADING) -> ReferenceFacet:
    """Number the nodes of one facet; coincident points of neighbouring blocks become one node."""
    grid = _block_grid(m, grading)
    side = 2 * m + 1
    place = np.arange(side * side)
    s, r = place // side, place % side
    on_outline = np.tile((s == 0) | (r == 0), 3)
    on_spoke = np.tile((s == side - 1) | (r == side - 1), 3) & ~on_outline
    points = grid.reshape(-1, 3)
    x, y, z = points.T
    around = np.where(z < 1e-9, y, np.where(x < 1e-9, 1 + z, 2 + x))  # 0..3 along the outline
    kind = np.where(on_outline, 0, np.where(on_spoke, 1, 2))
    inside = np.repeat(np.arange(3), side * side)  # block by block, and there row by row
    group = np.select([kind == 0, kind == 2], [np.round(around, 9), inside], 0)
    along = np.where(kind[:, None] == 2, np.tile(place, 3)[:, None], np.round(points, 9))
    key = np.column_stack([kind, group, along])
    _, first, inverse = np.unique(key, axis=0, return_index=True, return_inverse=True)
    start = np.arange(0, side - 1, 2)
    corner = (start[:, None] * side + start).ravel()
    element = (np.arange(3)[:, None] * side + np.arange(3)).ravel()
    inner = (s > 0) & (s < side - 1) & (r > 0) & (r < side - 1)
    return ReferenceFacet(
        barycentric=points[first],
        blocks=inverse.reshape(3, -1),
        outline=12 * m,
        spokes=3 * (2 * m - 1) + 1,
        elements=corner[:, None] + element,
        block_boundary=place[~inner],
        block_interior=place[inner],
    )


def build_mesh(vertices: np.ndarray, facets: np.ndarray, m: int, grading: float = GRADING) -> Mesh:
    """Mesh flat triangles `facets` (F, 3) over `vertices` (V, 3); nodes on edges are shared.

    Vertices in m.
    """
    reference = build_reference_facet(m, grading)
    sides = np.stack([facets, np.roll(facets, -1, axis=1)], axis=2)  # (F, 3, 2)
    forward = sides[..., 0] < sides[..., 1]
    edges, side_edge = np.unique(np.sort(sides.reshape(-1, 2), axis=1), axis=0, return_inverse=True)
    side_edge = side_edge.reshape(-1, 3)
    between = 4 * m - 1
    count = len(vertices)
    inner = count + np.arange(len(edges))[:, None] * between + np.arange(between)
    edge_nodes = np.column_stack([edges[:, 0], inner, edges[:, 1]])
    along = inner[side_edge]  # (F, 3, 4m-1)
    along = np.where(forward[..., None], along, along[..., ::-1])
    outline = np.concatenate([facets[..., None], along], axis=2).reshape(len(facets), -1)
    skeleton = count + inner.size
    own = len(reference.barycentric) - reference.outline
    inside = skeleton + np.arange(len(facets) * own).reshape(len(facets), own)
    facet_nodes = np.concatenate([outline, inside], axis=1)
    nodes = np.empty((skeleton + inside.size, 3))
    nodes[facet_nodes] = reference.barycentric @ vertices[facets]
    return Mesh(nodes, facet_nodes, skeleton, edges, edge_nodes, reference)
