"""Values at points of a shell, and their means over facets and over strips beside folds."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from foldshell.checks.strips import NO_EDGE, Strips
from foldshell.shell.mesh import ShellMesh
from foldshell.shell.reference import orthonormal_basis
from foldshell.shell.stiffness import ShellOperators
from foldshell.shell.stress import StressResultants, cell_points

DIVISIONS = 12
"""Cells along an edge of a facet, with one point each: 144 points in a facet."""

if TYPE_CHECKING:
    from scipy import sparse


@dataclass(frozen=True)
class Sampling:
    """Points of all elements and what makes means of them.

    Attributes
    ----------
    points : (q, 2) reference coordinates, middles of equal cells
    angle : (E,) rad from an element's first axis to the panel's, about the normal
    means : (S, E q) sparse, rows of `strips`: area means of what is at the points
    panel : (S,) panel of each row
    diagonal : (S,) whether the row is a strip along a diagonal inside a panel
    """

    points: np.ndarray
    angle: np.ndarray
    means: "sparse.csr_matrix"
    panel: np.ndarray
    diagonal: np.ndarray


def sample_strips(operators: ShellOperators, strips: Strips, width: float) -> Sampling:
    """Weigh the cells of all elements by the share of each that lies in a strip of `width` (m)."""
    mesh = operators.mesh
    splits = round(np.sqrt(len(mesh.elements) / (mesh.facet.max() + 1)))
    cells = -(-DIVISIONS // splits)
    points = cell_points(cells)
    share = _share_cells(mesh, strips, width, cells)
    rows = np.repeat(np.arange(len(strips.panel)), _count_pieces(strips))
    q = len(points)
    weight = share * (operators.geometry.area[strips.element] / q)[:, None]
    columns = strips.element[:, None] * q + np.arange(q)
    shape = len(strips.panel), len(mesh.elements) * q
    entries = weight.ravel(), (np.repeat(rows, q), columns.ravel())
    from scipy import sparse  # heavy to import, and most analyses need none

    means = sparse.csr_matrix(entries, shape)
    means.eliminate_zeros()
    total = np.asarray(means.sum(axis=1)).ravel()
    means = sparse.csr_matrix(sparse.diags(1 / total) @ means)
    angle = find_bar_angles(operators, strips)
    return Sampling(points, angle, means, strips.panel, strips.diagonal)


def _count_pieces(strips: Strips) -> np.ndarray:
    return np.diff(np.append(strips.first, len(strips.element)))


def _share_cells(mesh: ShellMesh, strips: Strips, width: float, cells: int) -> np.ndarray:
    """Return the share (Q, q) of each cell of a piece that is no farther from its edge."""
    row = np.repeat(np.arange(len(strips.panel)), _count_pieces(strips))
    edge = strips.edge[row]
    inside = np.flatnonzero(edge[:, 0] != NO_EDGE)
    start, end = mesh.nodes[edge[inside, 0]], mesh.nodes[edge[inside, 1]]
    along = (end - start) / np.linalg.norm(end - start, axis=1, keepdims=True)
    corner = mesh.nodes[mesh.corners[strips.element[inside]]] - start[:, None]
    away = np.linalg.norm(np.cross(corner, along[:, None]), axis=2)
    shares = np.ones((len(row), cells**2))
    shares[inside] = share_within(away @ _cell_corners(cells).reshape(-1, 3).T, width)
    return shares


def _cell_corners(cells: int) -> np.ndarray:
    """Return the barycentric coordinates (q, 3, 3) of the corners of the cells of an element."""
    middle = cell_points(cells)
    sign = np.where(np.arange(cells**2) < cells * (cells + 1) // 2, 1.0, -1.0)[:, None, None]
    offset = (np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]) - 1 / 3) / cells
    corner = middle[:, None] + sign * offset
    return np.concatenate([1 - corner.sum(axis=2, keepdims=True), corner], axis=2)


def share_within(distance: np.ndarray, width: float) -> np.ndarray:
    """Share of a triangle in which a linear distance is below `width`.

    Up to the middle corner (w - d1)^2 / ((d2 - d1)(d3 - d1)), beyond 1 - (d3 - w)^2 / ((d3 - d1)
    (d3 - d2)), with d1 <= d2 <= d3 the distances of the corners.

    distance (..., 3 q) m, three to a cell one after the other; returns (..., q) without unit.
    """
    # three values in order: a sort of rows of three takes five times as long
    one, two, three = np.moveaxis(distance.reshape(*distance.shape[:-1], -1, 3), -1, 0)
    less, more = np.minimum(one, two), np.maximum(one, two)
    low, high = np.minimum(less, three), np.maximum(more, three)
    mid = np.maximum(less, np.minimum(more, three))
    with np.errstate(divide="ignore", invalid="ignore"):
        near = (width - low) ** 2 / ((mid - low) * (high - low))
        far = 1 - (high - width) ** 2 / ((high - low) * (high - mid))
    share = np.where(width <= mid, near, far)
    return np.where(width >= high, 1.0, np.where(width <= low, 0.0, share))


def find_bar_angles(operators: ShellOperators, strips: Strips) -> np.ndarray:
    """Return the angle (E,) rad of the bars along x from the first axis of each element.

    Bars along x run as the first border of their panel (the edge between its two lowest vertices
    that is no diagonal), turned into the plane of each facet; those along y across them.
    """
    mesh = operators.mesh
    rows = np.flatnonzero((strips.edge[:, 0] != NO_EDGE) & ~strips.diagonal)
    order = np.lexsort((strips.edge[rows, 1], strips.edge[rows, 0], strips.panel[rows]))
    rows = rows[order]
    first = rows[np.searchsorted(strips.panel[rows], np.arange(strips.panel.max() + 1))]
    start, end = strips.edge[first].T
    direction = (mesh.nodes[end] - mesh.nodes[start])[mesh.panel]
    x, y, _ = np.einsum("eax,ex->ae", operators.geometry.frame, direction)
    return np.arctan2(y, x)


def turn_components(values: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Return (E, 3, ...) xx, yy, xy in axes turned by `angle` (E,) rad, in their unit."""
    angle = angle.reshape(-1, *[1] * (values.ndim - 2))
    cos, sin = np.cos(angle), np.sin(angle)
    x, y, xy = np.moveaxis(values, 1, 0)
    both = 2 * sin * cos * xy
    return np.stack(
        [
            cos * cos * x + sin * sin * y + both,
            sin * sin * x + cos * cos * y - both,
            (cos * cos - sin * sin) * xy + sin * cos * (y - x),
        ],
        axis=1,
    )


def turn_resultants(sampling: Sampling, resultants: StressResultants) -> list[np.ndarray]:
    """Return the coefficients of n and m, each (E, 3, m, c) kN/m or kNm/m, along the bars."""
    return [turn_components(one, sampling.angle) for one in (resultants.force, resultants.moment)]


def find_basis(operators: ShellOperators, sampling: Sampling) -> np.ndarray:
    """Return the basis of stress (q, m) at the points, without unit."""
    return orthonormal_basis(operators.mesh.order - 1, sampling.points)


def sample(basis: np.ndarray, coefficients: np.ndarray) -> np.ndarray:
    """Return the components (3, E, q, c) apart of coefficients (E, 3, m, c), in their unit."""
    return np.matmul(basis, np.moveaxis(coefficients, 1, 0))
