"""Element matrices, built once a geometry: K = t K_m + t^3 K_b for every thickness."""

from dataclasses import dataclass

import numpy as np

from foldshell.shell.element import (
    ElementGeometry,
    curvature_operator,
    element_geometry,
    membrane_strain_operator,
    slope_jump_operator,
)
from foldshell.shell.mesh import ShellMesh

CHUNK = 1024
"""Elements handled at once, so that temporary arrays stay in cache."""

SLOPE_SPRING = 1.0
"""Spring on the slope jump, in units of D / h with h = area / edge length: the natural value."""


@dataclass(frozen=True)
class ShellOperators:
    """What a geometry and a Poisson's ratio fix, for unit thickness and unit Young's modulus.

    `membrane_strain` (E, 3m, 3n) and `curvature` (E, 3m, 3n + 3p) give strain coefficients from
    an element's degrees of freedom, `slope_jump` (E, 3p, 3n + 3p) the jumps that the springs of
    stiffness t^3 `slope_spring` (E, 3p) resist; `membrane` and `bending` (E, d(d+1)/2) are the
    packed lower triangles of the two stiffness matrices; `dofs` (E, d) are global numbers.
    """

    mesh: ShellMesh
    geometry: ElementGeometry
    elasticity: np.ndarray
    membrane_strain: np.ndarray
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
    membrane_strain = _to_global(membrane_strain_operator(mesh, geometry), geometry.frame[:, :2])
    deflection, rotation = curvature_operator(mesh, geometry)
    normal = geometry.frame[:, 2:]
    curvature = np.concatenate([_to_global(deflection[..., None], normal), rotation], axis=3)
    jump, rotation = slope_jump_operator(mesh, geometry)
    jump = np.concatenate([_to_global(jump[:, None, ..., None], normal)[:, 0], rotation], axis=2)
    spring = _slope_spring(mesh, geometry, elasticity)
    count = len(curvature)
    flat_membrane = membrane_strain.reshape(count, -1, membrane_strain.shape[3])
    flat_curvature = curvature.reshape(count, -1, curvature.shape[3])
    return ShellOperators(
        mesh=mesh,
        geometry=geometry,
        elasticity=elasticity,
        membrane_strain=flat_membrane,
        curvature=flat_curvature,
        membrane=_packed_energy(flat_membrane, elasticity, geometry.area),
        slope_jump=jump,
        slope_spring=spring,
        bending=_packed_energy(flat_curvature, elasticity / 12, geometry.area, jump, spring),
        dofs=element_dofs(mesh),
    )


def plane_stress(poissons_ratio: float) -> np.ndarray:
    """Return the plane-stress elasticity (3, 3) for E = 1; shear strain is engineering."""
    nu = poissons_ratio
    return np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]]) / (1 - nu**2)


def element_dofs(mesh: ShellMesh) -> np.ndarray:
    """Return global numbers (E, 3n + 3p): node displacements xyz, then edge rotations."""
    count = len(mesh.elements)
    displacement = (3 * mesh.elements[:, :, None] + np.arange(3)).reshape(count, -1)
    start = 3 * len(mesh.nodes)
    rotation = start + mesh.order * mesh.element_edges[:, :, None] + np.arange(mesh.order)
    return np.concatenate([displacement, rotation.reshape(count, -1)], axis=1)


def _to_global(operator: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """Rotate (E, c, m, n, k) on k local components to (E, c, m, 3n) on global ones."""
    count, components, m, n, _ = operator.shape
    return np.einsum("ecmnk,ekx->ecmnx", operator, axes).reshape(count, components, m, 3 * n)


def _slope_spring(mesh: ShellMesh, geometry: ElementGeometry, elasticity: np.ndarray) -> np.ndarray:
    """Return the springs (E, 3p) for unit thickness: length times D / h on each edge."""
    spring = SLOPE_SPRING * elasticity[0, 0] / 12 * geometry.edge_length**2 / geometry.area[:, None]
    return np.repeat(spring, mesh.order, axis=1)


def _packed_energy(
    strain: np.ndarray,
    elasticity: np.ndarray,
    area: np.ndarray,
    jump: np.ndarray | None = None,
    spring: np.ndarray | None = None,
) -> np.ndarray:
    """Return area B^T D B + J^T k J as packed lower triangles, (E, d(d+1)/2)."""
    count, rows, width = strain.shape
    low = np.tril_indices(width)
    packed = np.empty((count, len(low[0])))
    root = np.linalg.cholesky(elasticity).T
    for start in range(0, count, CHUNK):
        part = slice(start, start + CHUNK)
        blocks = strain[part].reshape(-1, 3, rows // 3 * width)
        scaled = np.matmul(root, blocks).reshape(-1, rows, width)
        scaled *= np.sqrt(area[part])[:, None, None]
        if jump is not None:
            springs = np.sqrt(spring[part])[:, :, None] * jump[part]
            scaled = np.concatenate([scaled, springs], axis=1)
        energy = scaled.transpose(0, 2, 1) @ scaled
        packed[part] = energy[:, low[0], low[1]]
    return packed
