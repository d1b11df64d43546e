"""Shell mesh: flat facets, each covered by k x k triangles of order p on a common lattice."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foldshell.shell.nodal import NodeSum
from foldshell.shell.reference import EDGES, lattice_indices


@dataclass(frozen=True)
class ShellMesh:
    """Triangles of order p on flat facets.

    Attributes
    ----------
    nodes : (N, 3) m
    elements : (E, (p+1)(p+2)/2) node numbers in lattice order; corners counter-clockwise from
        the positive side of the facet
    element_edges : (E, 3) edge numbers, counter-clockwise
    edge_signs : (E, 3) +1 where an element runs along the edge's own direction, else -1
    edge_count, order, subdivisions : int
    cells : result cells along an element edge
    facet : (E,) facet of each element
    panel : (E,) panel of each element
    node_pairs : (C, 2) lower and higher end of each facet edge, as facet vertices
    pair_nodes : (C, kp+1) all mesh nodes of that facet edge, from the lower to the higher end
    """

    nodes: np.ndarray
    elements: np.ndarray
    element_edges: np.ndarray
    edge_signs: np.ndarray
    edge_count: int
    order: int
    subdivisions: int
    cells: int
    facet: np.ndarray
    panel: np.ndarray
    node_pairs: np.ndarray
    pair_nodes: np.ndarray

    @property
    def dof_count(self) -> int:
        """Three displacements a node and p rotation coefficients an edge."""
        return 3 * len(self.nodes) + self.order * self.edge_count

    @property
    def corners(self) -> np.ndarray:
        """Node numbers of the element corners, (E, 3)."""
        return self.elements[:, corner_positions(self.order)]

    @cached_property
    def node_sum(self) -> NodeSum:
        """How element values are summed at the nodes."""
        return NodeSum(self.elements, len(self.nodes))


def corner_positions(order: int) -> np.ndarray:
    """Return the row numbers of the three corners (3,) in the lattice order of an element."""
    return np.array([0, order, (order + 1) * (order + 2) // 2 - 1])


def split_subdivisions(subdivisions: int) -> tuple[int, int]:
    """Return (k, p): elements along a facet edge and their order, for n result cells along it.

    k is the least divisor of n that leaves at most 4 cells per element, and p = n/k + 1: a mesh
    with n = 1, 2, 3, 4, 8, 16 has (1, 2), (1, 3), (1, 4), (1, 5), (2, 5), (4, 5).
    """
    if subdivisions < 1:
        raise ValueError(f"{subdivisions} subdivisions: at least 1 is needed")
    k = next(k for k in range(1, subdivisions + 1) if subdivisions % k == 0 <= 4 * k - subdivisions)
    return k, subdivisions // k + 1


def build_mesh(
    vertices: np.ndarray,
    facets: np.ndarray,
    panel: np.ndarray | None = None,
    subdivisions: int = 4,
    order: int | None = None,
) -> ShellMesh:
    """Cover every facet with elements that share their nodes along facet edges.

    Parameters
    ----------
    vertices : (V, 3) m
    facets : (F, 3) vertex numbers, counter-clockwise from the positive side
    panel : (F,) panel of each facet; by default each facet is its own panel
    subdivisions : n, result cells along a facet edge
    order : element order p; by default as `split_subdivisions` says
    """
    splits, default_order = split_subdivisions(subdivisions)
    order = default_order if order is None else order
    vertices, facets = np.asarray(vertices, float), np.asarray(facets)
    _check_facets(vertices, facets)
    size = splits * order
    lattice = lattice_indices(size)
    numbers, pairs, pair_nodes, count = _number_nodes(len(vertices), facets, size)
    nodes = np.empty((count, 3))
    local = _element_lattice(size, order)
    nodes[numbers] = (lattice / size) @ vertices[facets]
    nodes[: len(vertices)] = vertices
    elements = numbers[:, local].reshape(-1, local.shape[1])
    edges, signs, edge_count = _number_edges(elements[:, corner_positions(order)])
    facet = np.repeat(np.arange(len(facets)), len(local))
    panel = np.arange(len(facets)) if panel is None else np.asarray(panel)
    return ShellMesh(
        nodes, elements, edges, signs, edge_count, order, subdivisions, subdivisions // splits,
        facet, panel[facet], pairs, pair_nodes,
    )  # fmt: skip


def edge_polyline_nodes(mesh: ShellMesh, vertex_pairs: np.ndarray) -> np.ndarray:
    """Return every mesh node on the facet edges given by vertex pairs (K, 2).

    Raises
    ------
    ValueError
        if a pair is no edge of a facet.

    All are numbers.
    """
    return np.unique(mesh.pair_nodes[find_facet_edges(mesh, vertex_pairs)])


def find_facet_edges(mesh: ShellMesh, vertex_pairs: np.ndarray) -> np.ndarray:
    """Return the rows (K,) of `node_pairs` and `pair_nodes` of facet edges given by vertices.

    vertex_pairs (K, 2). Raises `ValueError` if a pair is no edge of a facet.

    All are numbers.
    """
    keys = np.sort(np.asarray(vertex_pairs).reshape(-1, 2), axis=1)
    width = int(mesh.node_pairs.max()) + 1
    known = mesh.node_pairs[:, 0] * width + mesh.node_pairs[:, 1]
    wanted = keys[:, 0] * width + keys[:, 1]
    row = np.minimum(np.searchsorted(known, wanted), len(known) - 1)
    if not np.array_equal(known[row], wanted):
        raise ValueError(f"{keys[known[row] != wanted][0].tolist()} is no edge of a facet")
    return row


def list_facets(mesh: ShellMesh) -> tuple[np.ndarray, np.ndarray]:
    """Return the facets (F, 3) as vertex numbers, in no certain sense, and the panel (F,) of each.

    The first nodes of a mesh are its vertices: the elements in a facet's corners know them.
    """
    vertices = int(mesh.node_pairs.max()) + 1
    element, corner = np.nonzero(mesh.corners < vertices)
    order = np.argsort(mesh.facet[element], kind="stable")
    facets = mesh.corners[element, corner][order].reshape(-1, 3)
    return facets, mesh.panel[element[order]].reshape(-1, 3)[:, 0]


def _check_facets(vertices: np.ndarray, facets: np.ndarray) -> None:
    """Refuse facets without area."""
    corner = vertices[facets]
    side, other = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    twice_area = np.linalg.norm(np.cross(side, other), axis=1)
    longest = np.maximum((side**2).sum(axis=1), (other**2).sum(axis=1))
    flat = np.flatnonzero(~(twice_area > 1e-12 * longest))
    if len(flat):
        place = vertices[facets[flat[0]]].mean(axis=0).round(3).tolist()
        raise ValueError(f"facet {flat[0]} at {place} m has no area")


def _number_nodes(vertex_count, facets, n):
    """Number lattice nodes once: facet vertices, then along facet edges, then inside facets."""
    lattice = lattice_indices(n)
    ends = np.sort(facets[:, EDGES].reshape(-1, 2), axis=1)
    pairs, which = np.unique(ends, axis=0, return_inverse=True)
    which = which.reshape(-1, 3)
    numbers = np.empty((len(facets), len(lattice)), dtype=np.int64)
    numbers[:, corner_positions(n)] = facets
    inner = np.arange(1, n)
    edge_start = vertex_count + np.arange(len(pairs)) * (n - 1)
    pair_nodes = np.column_stack([pairs[:, 0], edge_start[:, None] + inner - 1, pairs[:, 1]])
    for k, (a, b) in enumerate(EDGES):
        on_edge = np.array(
            [np.flatnonzero((lattice[:, a] == n - i) & (lattice[:, b] == i))[0] for i in inner],
            dtype=int,
        )
        forward = (facets[:, a] < facets[:, b])[:, None]
        step = np.where(forward, inner - 1, n - 1 - inner)
        numbers[:, on_edge] = edge_start[which[:, k]][:, None] + step
    interior = np.flatnonzero((lattice > 0).all(axis=1))
    start = vertex_count + len(pairs) * (n - 1)
    count = start + len(facets) * len(interior)
    numbers[:, interior] = np.arange(start, count).reshape(len(facets), -1)
    return numbers, pairs, pair_nodes, count


def _element_lattice(n: int, p: int) -> np.ndarray:
    """Return for each of the (n/p)^2 triangles of a facet its nodes in the facet's lattice."""
    position = {tuple(row): i for i, row in enumerate(lattice_indices(n).tolist())}
    local = lattice_indices(p)
    triangles = []
    for s in range(0, n, p):
        for r in range(0, n - s, p):
            origin = np.array([n - r - s, r, s])
            triangles.append(origin + local @ [[0, 0, 0], [-1, 1, 0], [-1, 0, 1]])
            if r + s + 2 * p <= n:
                corner = origin + np.array([-2 * p, p, p])
                triangles.append(corner + local @ [[0, 0, 0], [1, -1, 0], [1, 0, -1]])
    return np.array([[position[tuple(node)] for node in tri.tolist()] for tri in triangles])


def _number_edges(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray, int]:
    """Number element edges; an edge runs from its lower to its higher node."""
    ends = corners[:, EDGES]
    low, high = ends.min(axis=2), ends.max(axis=2)
    keys, numbers = np.unique(low.ravel() * (high.max() + 1) + high.ravel(), return_inverse=True)
    signs = np.where(ends[:, :, 0] < ends[:, :, 1], 1, -1)
    return numbers.reshape(-1, 3), signs, len(keys)


def translation_dofs(nodes: np.ndarray, directions: tuple[int, ...] = (0, 1, 2)) -> np.ndarray:
    """Return the numbers (k d,) of displacements at nodes (k,) along d `directions`: x is 0."""
    return (3 * np.asarray(nodes, dtype=np.int64)[:, None] + np.array(directions)).ravel()


def rotation_dofs(mesh: ShellMesh, edges: np.ndarray) -> np.ndarray:
    """Return the numbers (k p,) of all rotation coefficients of element edges (k,)."""
    start = 3 * len(mesh.nodes) + mesh.order * np.asarray(edges, dtype=np.int64)
    return (start[:, None] + np.arange(mesh.order)).ravel()
