"""Element matrices, built once a geometry: K = t K_m + t^3 K_b for every thickness."""

from dataclasses import dataclass, fields, replace

import numpy as np

from foldshell.shell.element import (
    ElementGeometry,
    curvature_operator,
    element_geometry,
    slope_jump_operator,
)
from foldshell.shell.mesh import ShellMesh
from foldshell.shell.reference import reference_triangle

CHUNK = 64
"""Elements handled at once, so that temporary arrays stay in cache."""

SLOPE_SPRING = 1.0
"""Spring on the slope jump, in units of D / h with h = area / edge length: the natural value."""


@dataclass(frozen=True)
class ShellOperators:
    """What a geometry and a Poisson's ratio fix, for unit thickness and unit Young's modulus.

    `strain_axes` (E, 3, 2, 3) gives strains xx, yy, xy from the derivatives of global displacement
    along the two reference directions. `curvature` (E, 3m, n + 3p) and `slope_jump` (E, 3p, n + 3p)
    act on an element's deflections and edge rotations; springs of stiffness t^3 `slope_spring`
    (E, 3p) resist the jumps. `membrane` and `bending` (E, d(d+1)/2) are the packed lower triangles
    of the two stiffness matrices on global displacements, node by node, and rotations; `dofs`
    (E, d) are their numbers.
    """

    mesh: ShellMesh
    geometry: ElementGeometry
    elasticity: np.ndarray
    strain_axes: np.ndarray
    curvature: np.ndarray
    slope_jump: np.ndarray
    slope_spring: np.ndarray
    membrane: np.ndarray
    bending: np.ndarray
    dofs: np.ndarray


def build_operators(mesh: ShellMesh, poissons_ratio: float) -> ShellOperators:
    """Assemble the strain operators and both stiffness matrices of every element."""
    geometry = element_geometry(mesh)
    elasticity = plane_stress(poissons_ratio)
    axes = _strain_axes(geometry)
    count = len(mesh.elements)
    deflection, rotation = curvature_operator(mesh, geometry)
    curvature = np.concatenate([deflection, rotation], axis=3).reshape(
        count, -1, deflection.shape[3] + rotation.shape[3]
    )
    jump = np.concatenate(slope_jump_operator(mesh, geometry), axis=2)
    spring = _slope_spring(mesh, geometry, elasticity)
    return ShellOperators(
        mesh=mesh,
        geometry=geometry,
        elasticity=elasticity,
        strain_axes=axes,
        curvature=curvature,
        slope_jump=jump,
        slope_spring=spring,
        membrane=_packed_membrane(mesh.order, axes, elasticity, geometry.area),
        bending=_packed_bending(curvature, jump, spring, elasticity, geometry),
        dofs=element_dofs(mesh),
    )


def restrict_operators(operators: ShellOperators, chosen: np.ndarray) -> ShellOperators:
    """Return the operators of some elements alone, (k,) numbers; nodes keep their numbers.

    The stiffness matrices are left out.
    """
    mesh, whole = operators.mesh, operators.geometry
    parts = ("elements", "element_edges", "edge_signs", "facet", "panel")
    taken = {name: getattr(mesh, name)[chosen] for name in parts}
    own = {one.name: getattr(whole, one.name)[chosen] for one in fields(whole)}
    parts = ("strain_axes", "curvature", "slope_jump", "slope_spring", "dofs")
    return replace(
        operators,
        mesh=replace(mesh, **taken),
        geometry=ElementGeometry(**own),
        membrane=operators.membrane[:0],
        bending=operators.bending[:0],
        **{name: getattr(operators, name)[chosen] for name in parts},
    )


def plane_stress(poissons_ratio: float) -> np.ndarray:
    """Return the plane-stress elasticity (3, 3) for E = 1; shear strain is engineering.

    Without unit.
    """
    nu = poissons_ratio
    return np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]]) / (1 - nu**2)


def element_dofs(mesh: ShellMesh) -> np.ndarray:
    """Return global numbers (E, 3n + 3p): node displacements xyz, then edge rotations."""
    count = len(mesh.elements)
    displacement = (3 * mesh.elements[:, :, None] + np.arange(3)).reshape(count, -1)
    start = 3 * len(mesh.nodes)
    rotation = start + mesh.order * mesh.element_edges[:, :, None] + np.arange(mesh.order)
    return np.concatenate([displacement, rotation.reshape(count, -1)], axis=1)


def _slope_spring(mesh: ShellMesh, geometry: ElementGeometry, elasticity: np.ndarray) -> np.ndarray:
    """Return the springs (E, 3p) for unit thickness: length times D / h on each edge."""
    spring = SLOPE_SPRING * elasticity[0, 0] / 12 * geometry.edge_length**2 / geometry.area[:, None]
    return np.repeat(spring, mesh.order, axis=1)


def _strain_axes(geometry: ElementGeometry) -> np.ndarray:
    """Return b (E, 3, 2, 3) with eps_s = sum over k, x of b_skx d u_x / d xi_k."""
    along = geometry.inverse[:, :, :, None] * geometry.frame[:, None, :2]
    shear = geometry.inverse[:, :, 1, None] * geometry.frame[:, None, 0]
    shear = shear + geometry.inverse[:, :, 0, None] * geometry.frame[:, None, 1]
    return np.stack([along[:, :, 0], along[:, :, 1], shear], axis=1)


def _packed_membrane(
    order: int, axes: np.ndarray, elasticity: np.ndarray, area: np.ndarray
) -> np.ndarray:
    """Return int eps^T D eps over each element on displacements, (E, 3n(3n+1)/2).

    It is a sum of four matrices that all elements share, the products of reference derivatives.
    """
    gradient = reference_triangle(order).gradient
    nodes = gradient.shape[2]
    shared = np.einsum("kma,lmb->klab", gradient, gradient).reshape(4, -1)
    flat = axes.reshape(len(axes), 3, 6)
    pulled = flat.transpose(0, 2, 1) @ (area[:, None, None] * (elasticity @ flat))
    pulled = pulled.reshape(-1, 2, 3, 2, 3).transpose(0, 2, 4, 1, 3).reshape(-1, 9, 4)
    i, j = np.tril_indices(3 * nodes)
    pick = (i % 3 * 3 + j % 3) * nodes**2 + i // 3 * nodes + j // 3
    packed = np.empty((len(axes), len(pick)))
    for start in range(0, len(axes), CHUNK):
        part = slice(start, start + CHUNK)
        energy = pulled[part].reshape(-1, 4) @ shared
        np.take(energy.reshape(-1, 9 * nodes**2), pick, axis=1, out=packed[part], mode="clip")
    return packed


def _packed_bending(
    curvature: np.ndarray,
    jump: np.ndarray,
    spring: np.ndarray,
    elasticity: np.ndarray,
    geometry: ElementGeometry,
) -> np.ndarray:
    """Return int kappa^T D kappa / 12 + jump^T k jump on global freedoms, (E, d(d+1)/2).

    The deflection is the displacement along the normal.
    """
    count, rows, width = curvature.shape
    nodes = width - jump.shape[1]
    i, j = np.tril_indices(3 * nodes + jump.shape[1])
    local_i, local_j = (np.where(k < 3 * nodes, k // 3, k - 2 * nodes) for k in (i, j))
    axis_i, axis_j = (np.where(k < 3 * nodes, k % 3, 3) for k in (i, j))
    direction = np.concatenate([geometry.frame[:, 2], np.ones((count, 1))], axis=1)
    products = (direction[:, :, None] * direction[:, None, :]).reshape(count, 16)
    root = np.linalg.cholesky(elasticity / 12).T
    weight = np.sqrt(geometry.area)
    packed = np.empty((count, len(i)))
    for start in range(0, count, CHUNK):
        part = slice(start, start + CHUNK)
        blocks = curvature[part].reshape(-1, 3, rows // 3 * width)
        scaled = np.matmul(root, blocks).reshape(-1, rows, width) * weight[part, None, None]
        springs = np.sqrt(spring[part])[:, :, None] * jump[part]
        scaled = np.concatenate([scaled, springs], axis=1)
        energy = (scaled.transpose(0, 2, 1) @ scaled).reshape(-1, width**2)
        np.take(energy, local_i * width + local_j, axis=1, out=packed[part], mode="clip")
        packed[part] *= np.take(products[part], axis_i * 4 + axis_j, axis=1)
    return packed
