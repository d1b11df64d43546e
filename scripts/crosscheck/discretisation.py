"""A mesh of the shell with what depends on its geometry alone: axes, quadrature, equations."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csr_matrix

from crosscheck.element import Quadrature, integrate_elements
from crosscheck.frames import Skeleton, build_facet_axes, build_skeleton, transform_outline
from crosscheck.mesh import GRADING, Mesh, build_mesh
from crosscheck.ordering import Plan, Spans, plan_elimination
from crosscheck.supports import Boundary


@dataclass(frozen=True)
class Discretisation:
    """What depends on geometry alone: mesh, facet axes, mapped quadrature."""

    mesh: Mesh
    axes: np.ndarray  # (F, 3, 3) rows local x, y, normal
    elements: np.ndarray  # (3, m^2, 9) places in a facet
    coordinates: np.ndarray  # (F, 3, m^2, 9, 2) m, local
    quadrature: Quadrature
    turn: np.ndarray  # (F, 12m, 5, 6) local unknowns from skeleton unknowns
    equations: np.ndarray  # (F, 12m, 6), -1 where held
    springs: np.ndarray | None  # (F, 12m, 3) kN/m, each node's in one of its facets; None for none
    size: int
    spans: Spans  # equations of each vertex and edge
    plan: Plan

    @cached_property
    def spreading(self) -> csr_matrix:
        """Takes equations to local unknowns of outlines, by `turn`: (60 F m, size)."""
        local, axis = np.nonzero(self.turn.reshape(-1, 6))
        place = np.broadcast_to(self.equations[:, :, None], self.turn.shape).reshape(-1, 6)
        free = place[local, axis] >= 0
        local, axis = local[free], axis[free]
        values = self.turn.reshape(-1, 6)[local, axis]
        return csr_matrix((values, (local, place[local, axis])), (place.shape[0], self.size))

    @cached_property
    def gathering(self) -> csr_matrix:
        """Sums local loads on outlines into the equations: its transpose, (size, 60 F m)."""
        return self.spreading.T.tocsr()

    @cached_property
    def summing(self) -> csr_matrix:
        """Sums what is at element nodes into the facets' own nodes: (F R, 27 F m^2)."""
        count, places = self.mesh.facet_nodes.shape
        node = np.arange(count)[:, None] * places + self.elements.ravel()
        one = np.ones(node.size)
        return csr_matrix((one, (node.ravel(), np.arange(node.size))), (count * places, node.size))


def plan_facets(vertices: np.ndarray, facets: np.ndarray) -> Plan:
    """The order in which the unknowns of vertices and edges are eliminated, for every mesh.

    vertices (V, 3) m, facets (F, 3) as rows of them.
    """
    sides = np.sort(np.stack([facets, np.roll(facets, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    _, edge = np.unique(sides, axis=0, return_inverse=True)  # numbered as `build_mesh` does
    edge = edge.reshape(-1, 3)
    groups = np.hstack([facets, len(vertices) + edge])
    return plan_elimination(groups, edge, vertices[facets].mean(axis=1))


def discretise(
    vertices: np.ndarray,
    facets: np.ndarray,
    hold,
    subdivisions: int,
    grading: float = GRADING,
    plan: Plan | None = None,
) -> Discretisation:
    """Mesh the facets; `hold(mesh)` is their boundary, or the translations (S, 3) that are held.

    `plan` is that of `plan_facets`, made here where it is not given.

    Places in m.
    """
    mesh = build_mesh(vertices, facets, subdivisions, grading)
    axes = build_facet_axes(vertices, facets)
    offset = mesh.nodes[mesh.facet_nodes] - vertices[facets[:, 0]][:, None]
    elements = mesh.reference.blocks[:, mesh.reference.elements]
    coordinates = (offset @ np.swapaxes(axes[:, :2], 1, 2))[:, elements]
    found = hold(mesh)
    boundary = found if isinstance(found, Boundary) else Boundary(found)
    skeleton = build_skeleton(mesh, axes, boundary.clamped)
    equations, spans = number_equations(mesh, skeleton, boundary.held)
    return Discretisation(
        mesh,
        axes,
        elements,
        coordinates,
        integrate_elements(coordinates),
        transform_outline(skeleton),
        equations,
        _place_springs(mesh, boundary.spring),
        int(spans.count.sum()),
        spans,
        plan or plan_facets(vertices, facets),
    )


def number_equations(mesh: Mesh, skeleton: Skeleton, held: np.ndarray) -> tuple[np.ndarray, Spans]:
    """Equation numbers (F, 12m, 6) of the outline unknowns, and which belong to a vertex or edge.

    `held` (S, 3) are translations. Vertices come first, then the insides of the edges.
    """
    free = np.ones((mesh.skeleton, 6), bool)
    free[:, :3] = ~held
    free[:, 3:] = ~skeleton.turned
    number = np.where(free.ravel(), np.cumsum(free.ravel()) - 1, -1).reshape(free.shape)
    own = free.sum(axis=1)
    vertices = mesh.edge_nodes[0, 1]  # the first node inside an edge
    count = np.concatenate([own[:vertices], own[vertices:].reshape(len(mesh.edges), -1).sum(1)])
    spans = Spans(np.cumsum(count) - count, count)
    return number[mesh.facet_nodes[:, : mesh.reference.outline]], spans


def _place_springs(mesh: Mesh, spring: np.ndarray | None) -> np.ndarray | None:
    """Springs (S, 3) of nodes at the first place (F, 12m, 3) where a facet has them."""
    if spring is None:
        return None
    outline = mesh.facet_nodes[:, : mesh.reference.outline]
    _, first = np.unique(outline, return_index=True)
    placed = np.zeros((outline.size, 3))
    placed[first] = spring
    return placed.reshape(*outline.shape, 3)
