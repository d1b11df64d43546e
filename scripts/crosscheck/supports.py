"""Supports: what they hold of a shell, and how they are read from a neutral model file."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from crosscheck.mesh import Mesh
from crosscheck.reading import Place

AXES = ("x", "y", "z")
SIMPSON = np.array([1.0, 4.0, 1.0]) / 6
"""Weights of an element's three nodes on an edge: a line spring acts on them one by one."""


def _nothing() -> np.ndarray:
    return np.zeros(3)


@dataclass(frozen=True)
class Support:
    """Facet sides and vertices that are held in the same way, under one name."""

    name: str
    edges: np.ndarray  # (K, 2) vertex pairs
    vertices: np.ndarray = field(default_factory=lambda: np.empty(0, int))  # (P,)
    fix: tuple[bool, bool, bool] = (True, True, True)  # translations along x, y, z
    clamp: bool = False  # the rotation about each edge
    line_spring: np.ndarray = field(default_factory=_nothing)  # (3,) kN/m per m of edge
    point_spring: np.ndarray = field(default_factory=_nothing)  # (3,) kN/m at each vertex

    @property
    def is_pin(self) -> bool:
        """Whether it holds all translations of edges, and nothing else."""
        return all(self.fix) and not self.clamp and not len(self.vertices)


@dataclass(frozen=True)
class Boundary:
    """What supports do to the S nodes on the outlines of facets."""

    held: np.ndarray  # (S, 3) translations
    spring: np.ndarray | None = None  # (S, 3) kN/m, None for none
    clamped: tuple[np.ndarray, np.ndarray] | None = None  # nodes (Q,), unit vectors (Q, 3)


def hold_supports(supports: Sequence[Support], vertices: np.ndarray) -> Callable[[Mesh], Boundary]:
    """What holds the nodes of a mesh on `vertices` (V, 3) in m."""

    def hold(mesh: Mesh) -> Boundary:
        """The boundary of one mesh."""
        fixed = sum(fix_nodes(one, mesh) for one in supports)
        spring = sum(spread_springs(one, mesh) for one in supports)
        nodes, along = [], []
        for one in (one for one in supports if one.clamp):
            on = mesh.edge_nodes[_find_edges(one, mesh)]
            direction = vertices[on[:, -1]] - vertices[on[:, 0]]
            direction /= np.linalg.norm(direction, axis=1, keepdims=True)
            nodes.append(on.ravel())
            along.append(np.repeat(direction, on.shape[1], axis=0))
        clamped = (np.concatenate(nodes), np.concatenate(along)) if nodes else None
        return Boundary(fixed > 0, spring if spring.any() else None, clamped)

    return hold


def fix_nodes(support: Support, mesh: Mesh) -> np.ndarray:
    """1 where a support holds a translation of a node, else 0: (S, 3), without unit."""
    fixed = np.zeros((mesh.skeleton, 3))
    fixed[_list_nodes(support, mesh)] = support.fix
    return fixed


def spread_springs(support: Support, mesh: Mesh) -> np.ndarray:
    """Springs of a support at the nodes: (S, 3) in kN/m, those of edges by Simpson's weights."""
    stiffness = np.zeros((mesh.skeleton, 3))
    stiffness[support.vertices] += support.point_spring
    on = mesh.edge_nodes[_find_edges(support, mesh)]
    parts = np.stack([on[:, :-2:2], on[:, 1:-1:2], on[:, 2::2]], axis=-1)  # (K, 2m, 3)
    ends = mesh.nodes[parts[..., [0, 2]]]
    length = np.linalg.norm(ends[..., 1, :] - ends[..., 0, :], axis=-1)
    share = length[..., None, None] * SIMPSON[:, None] * support.line_spring
    np.add.at(stiffness, parts, share)
    return stiffness


def share_nodes(supports: Sequence[Support], mesh: Mesh) -> dict[str, np.ndarray]:
    """How much of the reaction of each node counts for each support: (S, 3), without unit.

    A node that several supports hold along an axis counts for each alike, and where one holds it
    the springs of others take nothing.
    """
    fixed = {one.name: fix_nodes(one, mesh) for one in supports}
    count = sum(fixed.values())
    spring = {one.name: spread_springs(one, mesh) for one in supports}
    stiffness = np.where(count > 0, 0.0, sum(spring.values()))
    return {
        name: np.where(
            count > 0,
            fixed[name] / np.maximum(count, 1),
            spring[name] / np.where(stiffness > 0, stiffness, 1.0),
        )
        for name in fixed
    }


def _list_nodes(support: Support, mesh: Mesh) -> np.ndarray:
    """The nodes on edges and at vertices of a support; vertices are the first nodes."""
    on = mesh.edge_nodes[_find_edges(support, mesh)]
    return np.concatenate([on.ravel(), support.vertices])


def _find_edges(support: Support, mesh: Mesh) -> np.ndarray:
    """Numbers of the mesh's edges that a support stands under: (K,)."""
    count = int(mesh.edges.max()) + 1
    known = mesh.edges @ [count, 1]  # ascending, as the edges are
    return np.searchsorted(known, np.sort(support.edges, axis=1).reshape(-1, 2) @ [count, 1])


def read_supports(root: Place, facets: np.ndarray, vertices: int) -> tuple[Support, ...]:
    """Supports of format 3 by name; facets (F, 3) are numbers of vertices."""
    supports = tuple(_read_support(one, facets, vertices) for one in root.key("supports").entries())
    names = [support.name for support in supports]
    if len(set(names)) < len(names):
        root.key("supports").refuse(names, "a name of its own for each support")
    return supports


def read_pins(place: Place, facets: np.ndarray, vertices: int) -> tuple[Support, ...]:
    """Before format 3 all supported edges are pins under one name; facets (F, 3) as numbers."""
    return (Support("supports", _read_edges(place, facets, vertices)),)


def _read_support(place: Place, facets: np.ndarray, vertices: int) -> Support:
    edges, points = np.empty((0, 2), int), np.empty(0, int)
    if "edges" in place.names():
        edges = _read_edges(place.key("edges"), facets, vertices)
    if "vertices" in place.names():
        points = place.key("vertices").indices(None, vertices)
    fix = _read_axes(place.key("fix", list(AXES)))
    clamp = place.key("clamp", False)
    line, point = (place.key(name, [0, 0, 0]) for name in ("spring_kn_m2", "spring_kn_m"))
    if clamp.value not in (True, False):
        clamp.refuse(clamp.value, "true or false")
    if clamp.value and len(points):
        place.key("vertices").refuse(points.tolist(), "edges alone: a vertex cannot be clamped")
    springs = _read_springs(line, len(edges)), _read_springs(point, len(points))
    holds = any(fix) or clamp.value or any(spring.any() for spring in springs)
    if not holds or not len(edges) + len(points):
        place.refuse(place.value, "edges or vertices that it holds in some way")
    return Support(place.key("name").text(), edges, points, fix, bool(clamp.value), *springs)


def _read_axes(place: Place) -> tuple[bool, bool, bool]:
    """Which of x, y, z a list names; none for an empty list."""
    wrong = not isinstance(place.value, list) or [one for one in place.value if one not in AXES]
    if wrong:
        place.refuse(place.value, "a list of some of x, y, z")
    x, y, z = (axis in place.value for axis in AXES)
    return x, y, z


def _read_springs(place: Place, count: int) -> np.ndarray:
    """Stiffness along x, y, z (3,), none below zero; something must carry it."""
    stiffness = np.array(place.row(3))
    if (stiffness < 0).any() or (stiffness.any() and not count):
        place.refuse(place.value, "three numbers from 0, for edges or vertices that are named")
    return stiffness


def _read_edges(place: Place, facets: np.ndarray, vertices: int) -> np.ndarray:
    edges: Any = place.indices(2, vertices)
    sides = np.sort(np.stack([facets, np.roll(facets, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    known = {tuple(side) for side in sides.tolist()}
    for k, edge in enumerate(np.sort(edges, axis=1).tolist()):
        if tuple(edge) not in known:
            place.at(k).refuse(edge, "two vertices that share a facet side")
    return edges
