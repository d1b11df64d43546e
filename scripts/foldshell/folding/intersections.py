"""Self-intersections of a triangulated sheet: facet pairs that pierce each other."""

import numpy as np
from scipy.spatial import cKDTree

MARGIN = 1e-9  # of the unit interval: grazing contact of neighbours is not an intersection


def find_intersections(vertices: np.ndarray, facets: np.ndarray) -> np.ndarray:
    """Pairs (N, 2) of facets of which an edge of one passes through the inside of the other.

    vertices (V, 3), facets (F, 3). Facets that share an edge are skipped: they can only meet
    there, unless folded flat. Of facets that share one vertex the edges away from it count.
    """
    pairs = _candidate_pairs(vertices, facets)
    shared = (facets[pairs[:, 0], :, None] == facets[pairs[:, 1], None, :]).sum(axis=(1, 2))
    pairs = pairs[shared < 2]
    pierced = np.zeros(len(pairs), dtype=bool)
    for one, two in ((0, 1), (1, 0)):
        for side in range(3):
            ends = facets[pairs[:, one]][:, [side, (side + 1) % 3]]
            triangle = facets[pairs[:, two]]
            apart = ~(ends[:, :, None] == triangle[:, None, :]).any(axis=(1, 2))
            pierced |= apart & pierce_triangles(
                vertices[ends[:, 0]], vertices[ends[:, 1]], vertices[triangle]
            )
    return pairs[pierced]


def pierce_triangles(start: np.ndarray, end: np.ndarray, triangle: np.ndarray) -> np.ndarray:
    """Moeller-Trumbore: which segments (N, 3)-(N, 3) cross the inside of triangles (N, 3, 3).

    Points in m.
    """
    direction = end - start
    edge_1, edge_2 = triangle[:, 1] - triangle[:, 0], triangle[:, 2] - triangle[:, 0]
    across = np.cross(direction, edge_2)
    determinant = np.einsum("ij,ij->i", across, edge_1)
    size = np.linalg.norm(direction, axis=1) * np.linalg.norm(np.cross(edge_1, edge_2), axis=1)
    parallel = np.abs(determinant) <= 1e-12 * size
    inverse = 1.0 / np.where(parallel, 1.0, determinant)
    offset = start - triangle[:, 0]
    u = np.einsum("ij,ij->i", offset, across) * inverse
    turned = np.cross(offset, edge_1)
    v = np.einsum("ij,ij->i", direction, turned) * inverse
    along = np.einsum("ij,ij->i", edge_2, turned) * inverse
    inside = (u > MARGIN) & (v > MARGIN) & (u + v < 1 - MARGIN)
    return ~parallel & inside & (along > MARGIN) & (along < 1 - MARGIN)


def _candidate_pairs(vertices: np.ndarray, facets: np.ndarray) -> np.ndarray:
    """Pairs of facets whose bounding boxes overlap."""
    corners = vertices[facets]
    low, high = corners.min(axis=1), corners.max(axis=1)
    centre = (low + high) / 2
    radius = np.linalg.norm(high - low, axis=1).max() / 2
    pairs = cKDTree(centre).query_pairs(2 * radius, output_type="ndarray")
    first, second = pairs.T
    overlap = ((low[first] <= high[second]) & (low[second] <= high[first])).all(axis=1)
    return pairs[overlap]


def find_piercing(vertices: np.ndarray, facets: np.ndarray, sheet: int) -> np.ndarray | None:
    """Return where (3,) m a strip passes through the sheet or another strip, None if none does.

    The first `sheet` facets are those of the sheet, whose own intersections do not count.
    """
    pairs = find_intersections(vertices, facets)
    pairs = pairs[(pairs >= sheet).any(axis=1)]
    return vertices[facets[pairs[0].max()]].mean(axis=0) if len(pairs) else None
