"""Edge beams: panels of shell that hang from the unsupported edges of a folded sheet.

Each free border edge a-b gets the parallelogram a, b, b - d z, a - d z: vertical, so that it is
planar and well defined however the border runs, and so that neighbours share their vertical edge.
With a depth d below 0 the panel stands up from the border, which suits sheets that fall away from
it steeply.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.shell.reference import EDGES


@dataclass(frozen=True)
class EdgeBeam:
    """Depth below the edge (above it if negative) and thickness of its panels, m."""

    depth: float
    thickness: float


def make_edge_beam(depth: float, thickness: float) -> EdgeBeam | None:
    """Return the edge beam, or None where a size is 0; the table of designs takes both or none."""
    return EdgeBeam(depth, thickness) if depth and thickness else None


def facet_edges(facets: np.ndarray) -> np.ndarray:
    """Return the edges (C, 2) of facets (F, 3), each once, lower vertex first.

    All are numbers of vertices.
    """
    return np.unique(np.sort(facets[:, EDGES].reshape(-1, 2), axis=1), axis=0)


def free_edges(facets: np.ndarray, held: np.ndarray) -> np.ndarray:
    """Return the edges (K, 2) of one facet only that are not among `held` (S, 2).

    Each runs as in its facet, counter-clockwise.

    All are numbers of vertices.
    """
    edges = facets[:, EDGES].reshape(-1, 2)
    width = int(facets.max()) + 1
    keys = edges.min(axis=1) * width + edges.max(axis=1)
    known, inverse, count = np.unique(keys, return_inverse=True, return_counts=True)
    held_keys = held.min(axis=1) * width + held.max(axis=1)
    return edges[((count == 1) & ~np.isin(known, held_keys))[inverse]]


def hang_edge_beam_panels(
    vertices: np.ndarray, facets: np.ndarray, edges: np.ndarray, depth: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return vertices and facets with two facets more per edge, in the order of the edges.

    The positive side of the sheet continues on the outer side of the panel: over their common edge
    both facets run in opposite directions. Parallelograms are cut along their shorter diagonal.

    Parameters
    ----------
    vertices : (V, 3) m
    facets : (F, 3)
    edges : (K, 2) as `free_edges` returns them
    depth : m
    """
    upper, index = np.unique(edges, return_inverse=True)
    below = len(vertices) + index.reshape(edges.shape)
    lowered = vertices[upper] - np.array([0.0, 0.0, depth])
    vertices = np.concatenate([vertices, lowered])
    quads = np.column_stack([edges[:, ::-1], below])
    diagonal = vertices[quads[:, :2]] - vertices[quads[:, 2:]]
    first, second = np.linalg.norm(diagonal, axis=2).T
    halves = np.where(
        (first <= second)[:, None, None],
        quads[:, [[0, 1, 2], [0, 2, 3]]],
        quads[:, [[0, 1, 3], [1, 2, 3]]],
    )
    return vertices, np.concatenate([facets, halves.reshape(-1, 3)])
