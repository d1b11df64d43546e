"""Fields of a final state on its result cells: forces, displacement, governing combination."""

import numpy as np

from foldshell.results.state import DesignState
from foldshell.shell.element import ElementGeometry
from foldshell.shell.mesh import ShellMesh
from foldshell.shell.reference import orthonormal_basis
from foldshell.shell.stiffness import build_operators
from foldshell.shell.stress import cell_points, imposed_resultants, membrane_forces


def cell_thickness(state: DesignState) -> np.ndarray:
    """Return the thickness of each cell's panel, (C,) m."""
    return state.panel_thickness[state.cell_panel]


def cell_area(state: DesignState) -> np.ndarray:
    """Return the area of each cell, (C,) m2."""
    corner = state.cells.nodes[state.triangles]
    return np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]),
                          axis=1) / 2  # fmt: skip


def choose_deflection(state: DesignState) -> str:
    """Return the combination with the largest downward displacement."""
    named = state.report.displacement_combination
    if named in state.combinations:
        return named
    down = [-state.displacement_at_nodes(name)[:, 2].min() for name in state.deflection]
    return state.deflection[int(np.argmax(down))]


def choose_strength(state: DesignState) -> str:
    """Return the strength combination that governs the largest area, the first without any."""
    governing = state.final.governing_combination
    if governing is None:
        return state.strength[0]
    area = np.bincount(governing.ravel(), cell_area(state), len(state.strength))
    return state.strength[int(area.argmax())]


def choose_buckling(state: DesignState) -> tuple[str, float] | None:
    """Return the combination with the least buckling factor and that factor, None without modes."""
    report = state.report
    if state.final.buckling_modes is None or report.least_factor is None:
        return None
    return report.least_factor_combination, report.least_factor


def membrane_force_coefficients(
    state: DesignState, combination: str, youngs_modulus: float, poissons_ratio: float
) -> tuple[np.ndarray, ElementGeometry]:
    """Return coefficients (E, 3, m) kN/m of one combination, and the elements' frames."""
    mesh = state.mesh
    operators = build_operators(mesh, poissons_ratio)
    column = state.combinations.index(combination)
    displacement = state.final.displacement[:, column : column + 1]
    thickness = state.panel_thickness[mesh.panel]
    force = membrane_forces(operators, displacement, thickness, youngs_modulus)
    if state.final.imposed_strain is not None:
        imposed = state.final.imposed_strain[..., [column]]
        force = force - imposed_resultants(operators, imposed, thickness, youngs_modulus).force
    return force[..., 0], operators.geometry


def membrane_force_cells(
    coefficients: np.ndarray, geometry: ElementGeometry, mesh: ShellMesh
) -> tuple[np.ndarray, np.ndarray]:
    """Return forces (C, 3) kN/m, xx, yy, xy, and their facet axes (C, 3, 3) as rows x, y, normal.

    x is the direction of the facet in which global x rises fastest (global y where a facet
    stands across x): neighbouring facets get axes that can be compared.
    """
    basis = orthonormal_basis(mesh.order - 1, cell_points(mesh.cells))
    force = np.einsum("qm,ecm->eqc", basis, coefficients)
    axes = facet_axes(geometry.frame[:, 2])
    force = rotate_forces(force, geometry.frame, axes)
    return force.reshape(-1, 3), np.repeat(axes, force.shape[1], axis=0)


def facet_axes(normal: np.ndarray) -> np.ndarray:
    """Return rows x, y, normal (E, 3, 3): x is global x projected on the facet."""
    along = np.zeros_like(normal)
    steep = np.abs(normal[:, 0]) > 0.999
    along[~steep, 0] = 1
    along[steep, 1] = 1
    first = along - np.einsum("ij,ij->i", along, normal)[:, None] * normal
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return np.stack([first, np.cross(normal, first), normal], axis=1)


def rotate_forces(force: np.ndarray, frame: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """N' = R N R^T: components (E, k, 3) xx, yy, xy from frames (E, 3, 3) to axes (E, 3, 3).

    Any unit; frames and axes are unit vectors.
    """
    turn = np.einsum("eax,ebx->eab", axes[:, :2], frame[:, :2])
    tensor = force_tensor(force)
    turned = np.einsum("eab,ekbc,edc->ekad", turn, tensor, turn, optimize=True)
    return np.stack([turned[..., 0, 0], turned[..., 1, 1], turned[..., 0, 1]], axis=-1)


def force_tensor(force: np.ndarray) -> np.ndarray:
    """Return (..., 2, 2) from (..., 3) xx, yy, xy. Any unit."""
    xx, yy, xy = np.moveaxis(force, -1, 0)
    return np.stack([np.stack([xx, xy], -1), np.stack([xy, yy], -1)], -2)


def principal_forces(force: np.ndarray, axes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return values (C, 2), larger first, and unit directions (C, 2, 3) in space.

    Of forces (C, 3) in axes (C, 3, 3); tan 2a = 2 nxy / (nx - ny). Tension is positive.
    """
    xx, yy, xy = force.T
    angle = np.arctan2(2 * xy, xx - yy) / 2
    mean, radius = (xx + yy) / 2, np.hypot((xx - yy) / 2, xy)
    cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
    first = cos * axes[:, 0] + sin * axes[:, 1]
    second = cos * axes[:, 1] - sin * axes[:, 0]
    values = np.stack([mean + radius, mean - radius], axis=1)
    return values, np.stack([first, second], axis=1)
