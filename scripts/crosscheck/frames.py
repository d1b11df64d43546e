"""Facet axes, node axes of rotation, and the skeleton's unknowns."""

from dataclasses import dataclass

import numpy as np

from crosscheck.mesh import Mesh

COPLANAR = 1e-6  # facets whose unit normals differ by less share one tangent plane

SAME = 1e-6  # edges whose directions differ by less are in line


@dataclass(frozen=True)
class Skeleton:
    """Six unknowns a skeleton node: three translations and rotations about the node's axes."""

    axes: np.ndarray  # (F, 3, 3) rows: local x, y, normal of each facet
    outline_rotation: np.ndarray  # (F, 12m, 2, 3) (bx, by) from the node's three rotations
    turned: np.ndarray  # (S, 3) rotations that are no unknowns: clamped, or normal to one plane


def build_facet_axes(vertices: np.ndarray, facets: np.ndarray) -> np.ndarray:
    """Rows x (along the first side), y, normal for each facet: (F, 3, 3).

    vertices (V, 3) m; the axes are unit vectors.
    """
    a, b, c = (vertices[facets[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    x = (b - a) / np.linalg.norm(b - a, axis=1, keepdims=True)
    return np.stack([x, np.cross(normal, x), normal], axis=1)


def build_skeleton(
    mesh: Mesh, axes: np.ndarray, clamped: tuple[np.ndarray, np.ndarray] | None = None
) -> Skeleton:
    """Give nodes on folds the global axes, and nodes in one plane two rotations in it.

    With bx = omega . y and by = -omega . x the rotation vector omega carries over a fold
    without any drilling stiffness; where all facets are coplanar the third rotation has none
    and is left out.

    `axes` (F, 3, 3) are the unit vectors of `build_facet_axes`; `clamped` are nodes (Q,) and unit
    vectors (Q, 3) about which they do not turn.
    """
    outline = mesh.facet_nodes[:, : mesh.reference.outline]
    first = np.full(mesh.skeleton, len(axes))
    np.minimum.at(first, outline, np.arange(len(axes))[:, None])
    apart = np.linalg.norm(axes[first[outline], 2] - axes[:, None, 2], axis=-1)
    spread = np.zeros(mesh.skeleton)
    np.maximum.at(spread, outline, apart)
    flat = spread < COPLANAR
    node_axes = np.where(flat[:, None, None], axes[first], np.eye(3))
    turned = np.zeros((mesh.skeleton, 3), bool)
    turned[:, 2] = flat
    if clamped is not None:
        _clamp_nodes(node_axes, turned, *clamped)
    turn = np.einsum("fkij,fdj->fkdi", node_axes[outline], axes[:, :2], optimize=True)
    return Skeleton(axes, np.stack([turn[:, :, 1], -turn[:, :, 0]], axis=2), turned)


def _clamp_nodes(
    node_axes: np.ndarray, turned: np.ndarray, nodes: np.ndarray, along: np.ndarray
) -> None:
    """Let the first axes of clamped nodes span what they do not turn about, and hold those.

    Where all facets are coplanar the third axis stays their normal: edges lie in that plane.
    """
    for node in np.unique(nodes):
        _, size, basis = np.linalg.svd(along[nodes == node])
        rank = int((size > SAME * size[0]).sum())
        if turned[node, 2] and rank == 1:
            basis = np.array([basis[0], np.cross(node_axes[node, 2], basis[0]), node_axes[node, 2]])
        elif turned[node, 2]:
            basis, rank = node_axes[node], 2
        node_axes[node] = basis
        turned[node, :rank] = True


def transform_outline(skeleton: Skeleton) -> np.ndarray:
    """Local (u, v, w, bx, by) from the six skeleton unknowns: (F, 12m, 5, 6)."""
    count, nodes = skeleton.outline_rotation.shape[:2]
    matrix = np.zeros((count, nodes, 5, 6))
    matrix[:, :, :3, :3] = skeleton.axes[:, None]
    matrix[:, :, 3:, 3:] = skeleton.outline_rotation
    return matrix
