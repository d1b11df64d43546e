"""What supports do to the freedoms of a mesh: held translations, clamped edges, springs.

A line spring k [kN/m per m] acts on the nodes of an edge by the integrals of their shape functions,
which are the weights of Newton and Cotes: it stands on the diagonal of K, constant while
thicknesses change, so that linear states, buckling, second order and gradients take it alike.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.shell.mesh import ShellMesh, find_facet_edges, rotation_dofs, translation_dofs
from foldshell.shell.reference import EDGES

DEPENDENT = 1e-9
"""Least singular value, relative to the largest, at which supports hold a rigid-body motion."""


@dataclass(frozen=True)
class Hold:
    """What one support holds: `pairs` (K, 2) facet edges as vertices, and `vertices` (Q,).

    `fix` (3,) bool are translations along x, y, z, `clamp` the rotation about each edge, and
    `spring` (3,) is in kN/m per m of edge, in kN/m at vertices.
    """

    pairs: np.ndarray
    vertices: np.ndarray
    fix: np.ndarray
    clamp: bool
    spring: np.ndarray


@dataclass(frozen=True)
class Boundary:
    """What all supports hold: `fixed` (k,) freedoms, and `springs` (dofs,) kN/m or None."""

    fixed: np.ndarray
    springs: np.ndarray | None


def join_holds(mesh: ShellMesh, holds: list[Hold]) -> Boundary:
    """Return the freedoms that supports hold, and the sum of their springs."""
    fixed, springs = [], np.zeros(mesh.dof_count)
    for hold in holds:
        directions = tuple(np.flatnonzero(hold.fix).tolist())
        if directions:
            fixed.append(translation_dofs(list_nodes(mesh, hold), directions))
        if hold.clamp:
            fixed.append(rotation_dofs(mesh, find_element_edges(mesh, hold.pairs)))
        springs[: 3 * len(mesh.nodes)] += spread_springs(mesh, hold).ravel()
    return Boundary(
        np.unique(np.concatenate([np.empty(0, np.int64), *fixed])),
        springs if springs.any() else None,
    )


def list_nodes(mesh: ShellMesh, hold: Hold) -> np.ndarray:
    """Return all mesh nodes at which a support stands, (S,) numbers in ascending order."""
    on_edges = mesh.pair_nodes[find_facet_edges(mesh, hold.pairs)].ravel()
    return np.unique(np.concatenate([on_edges, hold.vertices]).astype(np.int64))


def spread_springs(mesh: ShellMesh, hold: Hold) -> np.ndarray:
    """Return k_n = k int N_n ds of a support's springs at all nodes, (N, 3) kN/m."""
    springs = np.zeros((len(mesh.nodes), 3))
    if not hold.spring.any():
        return springs
    np.add.at(springs, hold.vertices, hold.spring)
    chain = mesh.pair_nodes[find_facet_edges(mesh, hold.pairs)]
    order, parts = mesh.order, (chain.shape[1] - 1) // mesh.order
    weights = newton_cotes_weights(order)
    length = np.linalg.norm(mesh.nodes[chain[:, -1]] - mesh.nodes[chain[:, 0]], axis=1) / parts
    share = length[:, None, None] * weights[:, None] * hold.spring
    for part in range(parts):
        np.add.at(springs, chain[:, part * order : (part + 1) * order + 1], share)
    return springs


def newton_cotes_weights(order: int) -> np.ndarray:
    """Return int_0^1 of the Lagrange polynomials of equidistant points, (order + 1,).

    They are positive up to order 7. Without unit.
    """
    points = np.linspace(0, 1, order + 1)
    powers = np.arange(order + 1)
    return np.linalg.solve(points[None] ** powers[:, None], 1 / (powers + 1))


def find_element_edges(mesh: ShellMesh, pairs: np.ndarray) -> np.ndarray:
    """Return the element edges (k,) that lie on facet edges (K, 2), given as vertices.

    All are numbers.
    """
    ends = np.sort(mesh.corners[:, EDGES].reshape(-1, 2), axis=1)
    width = len(mesh.nodes)
    known, first = np.unique(ends @ [width, 1], return_index=True)
    chain = mesh.pair_nodes[find_facet_edges(mesh, pairs)][:, :: mesh.order]
    wanted = np.sort(np.stack([chain[:, :-1], chain[:, 1:]], axis=2).reshape(-1, 2), axis=1)
    return np.unique(mesh.element_edges.ravel()[first[np.searchsorted(known, wanted @ [width, 1])]])


def find_acting(
    mesh: ShellMesh, held: np.ndarray, springs: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray]:
    """Return the nodes (S,) at which a support acts, and along which directions (S, 3) bool.

    held (k,) are freedoms, springs (dofs,) kN/m.
    """
    count = 3 * len(mesh.nodes)
    acting = np.zeros(count, dtype=bool)
    acting[held[held < count]] = True
    if springs is not None:
        acting |= springs[:count] > 0
    acting = acting.reshape(-1, 3)
    nodes = np.flatnonzero(acting.any(axis=1))
    return nodes, acting[nodes]


def refuse_rigid_motion(mesh: ShellMesh, held: np.ndarray, springs: np.ndarray | None) -> None:
    """Raise `ValueError` that names a rigid-body motion which no support holds.

    held (k,) are freedoms, springs (dofs,) kN/m.
    """
    middle = mesh.nodes.mean(axis=0)
    size = np.linalg.norm(np.ptp(mesh.nodes, axis=0))
    nodes, acting = find_acting(mesh, held, springs)
    node, axis = np.nonzero(acting)
    force = np.eye(3)[axis]
    moment = np.cross((mesh.nodes[nodes[node]] - middle) / size, force)
    rows = [np.hstack([force, moment])]
    count = 3 * len(mesh.nodes)
    edges = np.unique((held[held >= count] - count) // mesh.order)
    if len(edges):
        along = _edge_directions(mesh)[edges]
        rows.append(np.hstack([np.zeros_like(along), along]))
    matrix = np.concatenate([*rows, np.zeros((6, 6))])
    _, strength, motions = np.linalg.svd(matrix, full_matrices=False)
    if strength[5] <= DEPENDENT * max(strength[0], 1e-300):
        raise ValueError(f"the supports leave the shell free {_describe(motions[5], middle, size)}")


def _edge_directions(mesh: ShellMesh) -> np.ndarray:
    """Return the unit vector along each element edge, (edges, 3)."""
    ends = mesh.corners[:, EDGES].reshape(-1, 2)
    along = mesh.nodes[ends[:, 1]] - mesh.nodes[ends[:, 0]]
    found = np.empty((mesh.edge_count, 3))
    found[mesh.element_edges.ravel()] = along / np.linalg.norm(along, axis=1, keepdims=True)
    return found


def _describe(motion: np.ndarray, middle: np.ndarray, size: float) -> str:
    """Say in words what a rigid-body motion (6,) is: a translation, or a rotation about a line."""
    shift, turn = motion[:3], motion[3:] / size
    if np.linalg.norm(turn) * size < 1e-6 * np.linalg.norm(shift):
        return f"to move along {_round(shift / np.linalg.norm(shift))}"
    axis = turn / np.linalg.norm(turn)
    through = middle + np.cross(turn, shift) / (turn @ turn)
    return f"to turn about the line through {_round(through)} m along {_round(axis)}"


def _round(vector: np.ndarray) -> str:
    return "(" + ", ".join(f"{value + 0.0:.3g}" for value in vector.round(6)) + ")"
