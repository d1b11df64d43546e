"""The flat shell triangle: conforming membrane, Kirchhoff bending with hybridised moments.

Displacements are Lagrange polynomials of degree p in all three directions, so facets stay
joined along folds. Bending follows Hellan, Herrmann and Johnson in hybrid form (Comodi 1989,
Math. Comp. 52:17; on folded and curved shells Neunteufel & Schoberl 2019, Comput. Struct.
225:106109): moments of degree p - 1 are free in each element and are eliminated there; what
joins elements, and facets across a fold, is the displacement and one rotation about each edge.
There is no drilling freedom and no transverse shear. The slope of the deflection at an edge
meets the rotation there in moments of degree p - 1 and, as in hybridised discontinuous Galerkin
methods (Cockburn, Dong & Guzman 2009, J. Sci. Comput. 40:141), through a spring D/h on what is
left of the difference: it vanishes for smooth deflections, and it takes the excess flexibility
out of the thin folds.

Both strains are kept as coefficients of the orthonormal basis, so integrals over an element
are sums over coefficients times its area.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.shell.mesh import ShellMesh
from foldshell.shell.reference import EDGES, reference_triangle


@dataclass(frozen=True)
class ElementGeometry:
    """Local frames: `frame` (E, 3, 3) rows e1, e2, normal; `area` (E,) m2; `inverse` (E, 2, 2)
    d(reference)/d(local) in 1/m; `edge_length` (E, 3) m; `edge_normal` (E, 3, 2) outward."""

    frame: np.ndarray
    area: np.ndarray
    inverse: np.ndarray
    edge_length: np.ndarray
    edge_normal: np.ndarray


def element_geometry(mesh: ShellMesh) -> ElementGeometry:
    """Return the local frames of all elements; e1 runs along the first edge."""
    corner = mesh.nodes[mesh.corners]
    side, other = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    normal = np.cross(side, other)
    twice_area = np.linalg.norm(normal, axis=1)
    length = np.linalg.norm(side, axis=1)
    if not (twice_area > 1e-12 * length**2).all():
        raise ValueError(f"element {int(np.argmin(twice_area))} has no area")
    normal = normal / twice_area[:, None]
    e1 = side / length[:, None]
    frame = np.stack([e1, np.cross(normal, e1), normal], axis=1)
    local = np.einsum("eax,ecx->eca", frame[:, :2], corner - corner[:, :1])
    jacobian = np.stack([local[:, 1] - local[:, 0], local[:, 2] - local[:, 0]], axis=2)
    edge = local[:, EDGES[:, 1]] - local[:, EDGES[:, 0]]
    edge_length = np.linalg.norm(edge, axis=2)
    edge_normal = np.stack([edge[..., 1], -edge[..., 0]], axis=2) / edge_length[..., None]
    return ElementGeometry(frame, twice_area / 2, np.linalg.inv(jacobian), edge_length, edge_normal)


def slope_jump_operator(
    mesh: ShellMesh, geometry: ElementGeometry
) -> tuple[np.ndarray, np.ndarray]:
    """Return dw/dn + s phi on the three edges: (E, 3p, n) of w and (E, 3p, 3p) of phi.

    Coefficients of Legendre polynomials scaled to mean square one on the edge.

    w in m, phi in rad, the jump in rad: 1/m and 1.
    """
    order, count = mesh.order, len(mesh.elements)
    table = reference_triangle(order)
    normal_slope = _edge_normal_slopes(geometry)
    slope = np.einsum("efk,fkjn->efjn", normal_slope, table.edge_slope, optimize=True)
    rotation = np.zeros((count, 3, order, 3, order))
    scale = 1 / np.sqrt(2 * np.arange(order) + 1)
    signs = edge_parity(mesh) * scale
    for f in range(3):
        rotation[:, f, range(order), f, range(order)] = signs[:, f]
    shape = (count, 3 * order, -1)
    return slope.reshape(shape), rotation.reshape(shape)


def edge_parity(mesh: ShellMesh) -> np.ndarray:
    """Return (E, 3, p): s^(j+1), the sign of rotation coefficient j seen from the element.

    It is 1 or -1, without unit.
    """
    return (mesh.edge_signs[:, :, None] ** np.arange(1, mesh.order + 1)).astype(float)


def _edge_normal_slopes(geometry: ElementGeometry) -> np.ndarray:
    """Return (E, 3, 2): d/dn on each edge as a combination of d/dr and d/ds."""
    return np.einsum("efx,ekx->efk", geometry.edge_normal, geometry.inverse)


def curvature_operator(mesh: ShellMesh, geometry: ElementGeometry) -> tuple[np.ndarray, np.ndarray]:
    """Return the discrete curvature: (E, 3, m, n) of deflection w, (E, 3, m, 3p) of rotations.

    kappa_h solves int tau : kappa_h = int tau : grad grad w - oint tau_nn (dw/dn + s phi) for
    all moments tau of degree p - 1, where phi is the rotation about the edge direction and s
    tells whether the element runs along it. Components xx, yy, 2xy.
    """
    table = reference_triangle(mesh.order)
    inv = geometry.inverse
    transform = _second_derivative_transform(inv)
    from_deflection = np.einsum("ech,hmn->ecmn", transform, table.hessian)
    weight = _edge_moment_weights(geometry)
    normal_slope = _edge_normal_slopes(geometry)
    shape = (len(inv), 3, -1)
    from_deflection -= np.einsum(
        "efc,efk,fkmn->ecmn", weight, normal_slope, table.edge_gradient, optimize=True
    )
    rotation = -np.einsum(
        "efc,fmj,efj->ecmfj", weight, table.edge_rotation, edge_parity(mesh), optimize=True
    )
    return from_deflection, rotation.reshape(*shape, 3 * mesh.order)


def _second_derivative_transform(inverse: np.ndarray) -> np.ndarray:
    """Return T (E, 3, 3): (xx, yy, 2xy) derivatives from (rr, ss, rs)."""
    rx, ry, sx, sy = inverse[:, 0, 0], inverse[:, 0, 1], inverse[:, 1, 0], inverse[:, 1, 1]
    rows = [
        [rx**2, sx**2, 2 * rx * sx],
        [ry**2, sy**2, 2 * ry * sy],
        [2 * rx * ry, 2 * sx * sy, 2 * (rx * sy + ry * sx)],
    ]
    return np.array(rows).transpose(2, 0, 1)


def _edge_moment_weights(geometry: ElementGeometry) -> np.ndarray:
    """Return (E, 3, 3): for each edge, length / area times (nx^2, ny^2, 2 nx ny)."""
    nx, ny = geometry.edge_normal[..., 0], geometry.edge_normal[..., 1]
    scale = geometry.edge_length / geometry.area[:, None]
    return scale[..., None] * np.stack([nx**2, ny**2, 2 * nx * ny], axis=2)
