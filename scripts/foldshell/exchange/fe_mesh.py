"""A mesh of quadrilaterals for FE programs: each facet in three, each of these n x n."""

from dataclasses import dataclass

import numpy as np

from foldshell.exchange.model import ExportModel

MIDDLE = np.array([[0, 1], [1, 2], [2, 3], [3, 0]])
"""Corners of the four sides, in the order of their middle nodes."""


@dataclass(frozen=True)
class QuadMesh:
    """`nodes` (N, 3) m; `corners` (E, 4) and `middles` (E, 4) of sides, counter-clockwise from the
    positive side, empty (E, 0) without them; `facet` (E,); `supported` (S,) nodes of each support,
    `chains` (K, m) those along its edges from end to end, `alone` (Q,) those at its vertices."""

    nodes: np.ndarray
    corners: np.ndarray
    middles: np.ndarray
    facet: np.ndarray
    supported: tuple[np.ndarray, ...]
    chains: tuple[np.ndarray, ...]
    alone: tuple[np.ndarray, ...]

    @property
    def elements(self) -> np.ndarray:
        """Corners, then middles, (E, 4 or 8), as numbers of nodes."""
        return np.concatenate([self.corners, self.middles], axis=1)


def divide_facets(model: ExportModel, n: int, middles: bool) -> QuadMesh:
    """Divide each facet at its centroid and the middles of its sides, then n x n.

    Nodes on common edges are one: they are told by their vertices and whole weights. With `middles`
    the elements have eight nodes.
    """
    weights, corner, middle = _reference(n)
    own = corner if not middles else np.concatenate([corner, middle], axis=1)
    used, local = np.unique(own, return_inverse=True)
    local = local.reshape(own.shape)
    keys, number = _number(model.facets, weights[used])
    nodes = np.einsum("nk,nkx->nx", keys[:, 3:] / weights[0].sum(), model.vertices[keys[:, :3]])
    elements = number[:, local].reshape(-1, own.shape[1])
    chains = tuple(_nodes_on(keys, support.edges) for support in model.supports)
    alone = tuple(_nodes_at(keys, support.vertices) for support in model.supports)
    pairs = zip(chains, alone, strict=True)
    supported = tuple(np.union1d(chain.ravel(), points).astype(int) for chain, points in pairs)
    facet = np.repeat(np.arange(len(model.facets)), len(own))
    return QuadMesh(nodes, elements[:, :4], elements[:, 4:], facet, supported, chains, alone)


def _reference(n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return whole barycentric weights (m, 3) of the lattice of a facet's three quadrilaterals,
    and the corners and middles (3 n^2, 4) of elements in it."""
    vertex, middle = 6 * np.eye(3, dtype=int), 3 * np.array([[1, 1, 0], [0, 1, 1], [1, 0, 1]])
    centre, steps = np.array([2, 2, 2]), 2 * n
    i, j = (part.ravel()[:, None] for part in np.mgrid[0 : steps + 1, 0 : steps + 1])
    weights = [
        (steps - i) * (steps - j) * vertex[k]
        + i * (steps - j) * middle[k]
        + i * j * centre
        + (steps - i) * j * middle[k - 1]
        for k in range(3)
    ]
    place = np.arange((steps + 1) ** 2).reshape(steps + 1, steps + 1)
    low = place[:-1:2, :-1:2].ravel()
    row = steps + 1
    corner = np.stack([low, low + 2 * row, low + 2 * row + 2, low + 2], axis=1)
    side = np.stack([low + row, low + 2 * row + 1, low + row + 2, low + 1], axis=1)
    shift = np.repeat(np.arange(3) * place.size, len(low))[:, None]
    return np.concatenate(weights), np.tile(corner, (3, 1)) + shift, np.tile(side, (3, 1)) + shift


def _number(facets: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return keys (N, 6) of the nodes, vertices (0 beside weight 0) and weights, and the number of
    each facet's lattice point (F, m)."""
    shape = (len(facets), *weights.shape)
    size = np.broadcast_to(weights, shape)
    vertex = np.where(size > 0, facets[:, None], -1)
    order = np.argsort(vertex, axis=2)
    keys = np.concatenate(
        [np.take_along_axis(vertex, order, 2), np.take_along_axis(size, order, 2)], axis=2
    )
    keys, number = np.unique(keys.reshape(-1, 6), axis=0, return_inverse=True)
    return keys, number.reshape(shape[:2])


def _nodes_on(keys: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Return the nodes (K, m) along edges (K, 2), given as vertices, from end to end."""
    if not len(edges):
        return np.empty((0, 0), dtype=np.int64)
    pairs = np.sort(edges, axis=1)
    width = int(keys[:, 2].max()) + 1
    inside = np.flatnonzero((keys[:, 0] < 0) & (keys[:, 1] >= 0))
    own = keys[inside, 1] * width + keys[inside, 2]
    order = np.lexsort((keys[inside, 5], own))
    inside, own = inside[order], own[order]
    first = np.searchsorted(own, pairs @ [width, 1])
    count = int((own == own[first[0]]).sum())
    between = inside[first[:, None] + np.arange(count)]
    ends = _nodes_at(keys, pairs.ravel()).reshape(-1, 2)
    return np.column_stack([ends[:, 0], between, ends[:, 1]])


def _nodes_at(keys: np.ndarray, vertices: np.ndarray) -> np.ndarray:
    """Return the nodes (Q,) at vertices."""
    single = np.flatnonzero(keys[:, 1] < 0)
    order = np.argsort(keys[single, 2])
    return single[order[np.searchsorted(keys[single[order], 2], vertices)]]


def mesh_loads(model: ExportModel, mesh: QuadMesh, load: np.ndarray) -> np.ndarray:
    """Return nodal forces (N, 3) kN of loads on facets (F, 3) kN/m2: of bilinear elements, exact
    for their four corners."""
    point = mesh.nodes[mesh.corners]
    root = 1 / np.sqrt(3)
    forces = np.zeros_like(mesh.nodes)
    for r, s in ((-root, -root), (root, -root), (root, root), (-root, root)):
        shape, along = _bilinear(r, s)
        tangents = np.einsum("kc,ecx->ekx", along, point)
        area = np.linalg.norm(np.cross(tangents[:, 0], tangents[:, 1]), axis=1)
        part = area[:, None, None] * shape[:, None] * load[mesh.facet][:, None]
        np.add.at(forces, mesh.corners, part)
    return forces


def _bilinear(r: float, s: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the four shape functions and their derivatives (2, 4) at (r, s) in [-1, 1]^2."""
    signs = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    one, two = 1 + r * signs[:, 0], 1 + s * signs[:, 1]
    return one * two / 4, np.stack([signs[:, 0] * two, signs[:, 1] * one]) / 4
