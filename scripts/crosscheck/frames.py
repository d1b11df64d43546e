"""Facet axes, node axes of rotation, and the skeleton's unknowns."""

from dataclasses import dataclass

import numpy as np

from crosscheck.mesh import Mesh

COPLANAR = 1e-6  # facets whose unit normals differ by less share one tangent plane


@dataclass(frozen=True)
class Skeleton:
    """Six unknowns a skeleton node: three translations and rotations about the node's axes."""

    axes: np.ndarray  # (F, 3, 3) rows: local x, y, normal of each facet
    outline_rotation: np.ndarray  # (F, 12m, 2, 3) (bx, by) from the node's three rotations
    flat: np.ndarray  # (S,) True where all facets at a node are coplanar: no third rotation


def build_facet_axes(vertices: np.ndarray, facets: np.ndarray) -> np.ndarray:
    """Rows x (along the first side), y, normal for each facet: (F, 3, 3).

    vertices (V, 3) m; the axes are unit vectors.
    """
    a, b, c = (vertices[facets[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    x = (b - a) / np.linalg.norm(b - a, axis=1, keepdims=True)
    return np.stack([x, np.cross(normal, x), normal], axis=1)


def build_skeleton(mesh: Mesh, axes: np.ndarray) -> Skeleton:
    """Give nodes on folds the global axes, and nodes in one plane two rotations in it.

    With bx = omega . y and by = -omega . x the rotation vector omega carries over a fold
    without any drilling stiffness; where all facets are coplanar the third rotation has none
    and is left out.

    `axes` (F, 3, 3) are the unit vectors of `build_facet_axes`.
    """
    outline = mesh.facet_nodes[:, : mesh.reference.outline]
    first = np.full(mesh.skeleton, len(axes))
    np.minimum.at(first, outline, np.arange(len(axes))[:, None])
    apart = np.linalg.norm(axes[first[outline], 2] - axes[:, None, 2], axis=-1)
    spread = np.zeros(mesh.skeleton)
    np.maximum.at(spread, outline, apart)
    flat = spread < COPLANAR
    node_axes = np.where(flat[:, None, None], axes[first], np.eye(3))
    turn = np.einsum("fkij,fdj->fkdi", node_axes[outline], axes[:, :2], optimize=True)
    return Skeleton(axes, np.stack([turn[:, :, 1], -turn[:, :, 0]], axis=2), flat)


def transform_outline(skeleton: Skeleton) -> np.ndarray:
    """Local (u, v, w, bx, by) from the six skeleton unknowns: (F, 12m, 5, 6)."""
    count, nodes = skeleton.outline_rotation.shape[:2]
    matrix = np.zeros((count, nodes, 5, 6))
    matrix[:, :, :3, :3] = skeleton.axes[:, None]
    matrix[:, :, 3:, 3:] = skeleton.outline_rotation
    return matrix
