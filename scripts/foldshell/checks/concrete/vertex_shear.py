"""Shear that leaves fold vertices: across the basic control perimeter, in each facet."""

from dataclasses import dataclass

import numpy as np

from foldshell.shell.reference import orthonormal_basis
from foldshell.shell.stiffness import ShellOperators

POINTS = 8
"""Points along the arc in each corner of a facet."""
WITHIN = 0.9
"""Part of an element's height that the arc may reach."""
CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])


@dataclass(frozen=True)
class VertexShear:
    """In the K corners of facets: `panel` (K,), `vertex` (K,), `shear` (K, c) kN/m mean across the
    arc, `force` (K, c) kN/m mean of (n_x + n_y) / 2 on it."""

    panel: np.ndarray
    vertex: np.ndarray
    shear: np.ndarray
    force: np.ndarray


def find_vertex_shear(
    operators: ShellOperators, shear: np.ndarray, force: np.ndarray, radius: np.ndarray
) -> VertexShear:
    """|mean of v . r| over the arc of a radius about each corner of each facet.

    Parameters
    ----------
    shear, force : (E, 2, m, c) and (E, 3, m, c) kN/m, coefficients in the axes of elements
    radius : (E,) m

    EN 1992-1-1:2004 6.4.2: a perimeter at 2 d, here that part of it which lies in the facet.
    """
    mesh, geometry = operators.mesh, operators.geometry
    vertices = int(mesh.node_pairs.max()) + 1
    element, corner = np.nonzero(mesh.corners < vertices)
    jacobian = np.linalg.inv(geometry.inverse[element])
    sides = np.stack(
        [CORNERS[(corner + 1) % 3] - CORNERS[corner], CORNERS[(corner + 2) % 3] - CORNERS[corner]],
        axis=1,
    )
    local = np.einsum("exk,esk->esx", jacobian, sides)
    first = np.arctan2(local[:, 0, 1], local[:, 0, 0])
    opening = np.arctan2(
        local[:, 0, 0] * local[:, 1, 1] - local[:, 0, 1] * local[:, 1, 0],
        (local[:, 0] * local[:, 1]).sum(axis=1),
    )
    angle = first[:, None] + opening[:, None] * (np.arange(POINTS) + 0.5) / POINTS
    direction = np.stack([np.cos(angle), np.sin(angle)], axis=2)
    opposite = np.linalg.norm(local[:, 1] - local[:, 0], axis=1)
    reach = np.minimum(radius[element], WITHIN * 2 * geometry.area[element] / opposite)
    place = np.einsum("ekx,epx->epk", geometry.inverse[element], reach[:, None, None] * direction)
    place += CORNERS[corner][:, None]
    psi = orthonormal_basis(mesh.order - 1, place.reshape(-1, 2)).reshape(*place.shape[:2], -1)
    across = np.einsum("epm,esmc,eps->ec", psi, shear[element], direction, optimize=True)
    normal = np.einsum("epm,esmc->ec", psi, force[element, :2], optimize=True)
    return VertexShear(
        mesh.panel[element],
        mesh.corners[element, corner],
        np.abs(across) / POINTS,
        normal / (2 * POINTS),
    )
