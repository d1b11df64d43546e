"""Means over strips beside folds and borders: a local measure that does not hang on the mesh.

Forces peak where facets meet. A value at a point there grows with every refinement, the mean over
a whole panel hides it. In between stands the mean over a strip of given width along one whole edge
of a panel. The mean is that of membrane forces and moments, so it is linear in them: a strip is a
row of weights on the coefficients of stress (Dubiner basis), exact for the polynomials of every
element, also of those that the border of the strip cuts. The criterion is applied to the means.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.checks.strength import CRITERIA, Criterion
from foldshell.settings.material import Material
from foldshell.shell.mesh import ShellMesh, list_facets
from foldshell.shell.reference import EDGES, orthonormal_basis, triangle_quadrature
from foldshell.shell.stiffness import ShellOperators
from foldshell.shell.stress import StressResultants, surface_stresses

NO_EDGE = -1
CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
"""Corners of the reference triangle."""


@dataclass(frozen=True)
class Strips:
    """Rows of weights: first the F facets as a whole, then the strips along their edges.

    Attributes
    ----------
    panel, facet : (S,) that a row belongs to
    edge : (S, 2) vertices of the edge along which it runs, `NO_EDGE` for a whole facet
    diagonal : (S,) whether that edge is inside a panel
    area : (S,) m2
    axes : (S, 3, 3) rows x, y, normal in which means are given: those of the facet's first element
    element : (Q,) of each piece, a part of one element in one row; in the order of rows
    first : (S,) first piece of each row
    turn : (Q, 2, 2) from the axes of the piece's element to those of its row
    weights : (Q, m) on the element's coefficients; no unit
    """

    panel: np.ndarray
    facet: np.ndarray
    edge: np.ndarray
    diagonal: np.ndarray
    area: np.ndarray
    axes: np.ndarray
    element: np.ndarray
    first: np.ndarray
    turn: np.ndarray
    weights: np.ndarray


def find_strips(operators: ShellOperators, width: float, diagonals: bool = False) -> Strips:
    """w_m = sum over elements of int psi_m dA / area of the strip, for every edge of every panel.

    A strip is the part of a (convex) panel within `width` (m) of the line through one edge of its
    facets. `diagonals` adds strips along edges between facets of one panel, which are no folds.
    """
    mesh, area, frame = operators.mesh, operators.geometry.area, operators.geometry.frame
    facets, panel = list_facets(mesh)
    ends, inner = _list_edges(facets, panel)
    chosen = np.flatnonzero(diagonals | ~inner.ravel())
    facet = np.concatenate([np.arange(len(facets)), chosen // 3])
    edge = np.concatenate([np.full((len(facets), 2), NO_EDGE), ends.reshape(-1, 2)[chosen]])
    own = np.argsort(mesh.facet, kind="stable").reshape(len(facets), -1)
    row, element = _list_pieces(mesh.panel, panel[chosen // 3])
    distance = _measure_distances(mesh, edge[len(facets) :][row], element)
    weights, share = _integrate(distance, width, mesh.order - 1)
    kept = np.flatnonzero(share > 0)
    whole = np.zeros((own.size, weights.shape[1]))
    whole[:, 0] = 1
    row = np.concatenate([np.repeat(np.arange(len(facets)), own.shape[1]), len(facets) + row[kept]])
    element = np.concatenate([own.ravel(), element[kept]])
    weights = area[element, None] * np.concatenate([whole, weights[kept]])
    size = np.bincount(row, weights[:, 0])
    axes = frame[own[facet, 0]]
    return Strips(
        panel=panel[facet],
        facet=facet,
        edge=edge,
        diagonal=np.concatenate([np.zeros(len(facets), bool), inner.ravel()[chosen]]),
        area=size,
        axes=axes,
        element=element,
        first=np.searchsorted(row, np.arange(len(facet))),
        turn=np.einsum("qax,qbx->qab", axes[row][:, :2], frame[element][:, :2]),
        weights=weights / size[row, None],
    )


def _list_pieces(panel: np.ndarray, of_strip: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return strip and element of all pairs (K,), the elements (E,) by the panel of strips (R,)."""
    order = np.argsort(panel, kind="stable")
    start = np.searchsorted(panel[order], of_strip)
    count = np.searchsorted(panel[order], of_strip, side="right") - start
    row = np.repeat(np.arange(len(of_strip)), count)
    place = np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)
    return row, order[start[row] + place]


def _list_edges(facets: np.ndarray, panel: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the edges (F, 3, 2) of facets as vertices, and whether each is inside its panel."""
    ends = np.sort(facets[:, EDGES], axis=2)
    key = np.column_stack([np.repeat(panel, 3), ends.reshape(-1, 2)])
    _, which, count = np.unique(key, axis=0, return_inverse=True, return_counts=True)
    return ends, (count[which.ravel()] > 1).reshape(-1, 3)


def _measure_distances(mesh: ShellMesh, ends: np.ndarray, element: np.ndarray) -> np.ndarray:
    """Return the distances (K, 3) m of element corners from the line through each edge (K, 2)."""
    start, end = mesh.nodes[ends[:, 0]], mesh.nodes[ends[:, 1]]
    along = (end - start) / np.linalg.norm(end - start, axis=1, keepdims=True)
    corner = mesh.nodes[mesh.corners[element]] - start[:, None]
    return np.linalg.norm(np.cross(corner, along[:, None]), axis=2)


def _integrate(distance: np.ndarray, width: float, degree: int) -> tuple[np.ndarray, np.ndarray]:
    """Mean of psi_m over an element, nothing beyond `width`: (Q, m), and the share within (Q,).

    Distance (Q, 3) [m] is linear over an element, so what is within is a corner cut off, or all but
    a corner cut off.
    """
    order = np.argsort(distance, axis=1)
    low, mid, high = np.take_along_axis(distance, order, axis=1).T
    near = width <= mid  # the tip that is cut off is the nearest corner, else the farthest
    tip = np.where(near, order[:, 0], order[:, 2])
    at_tip = np.where(near, low, high)
    others = np.where(near[:, None], order[:, 1:], order[:, :2])
    there = np.take_along_axis(distance, others, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        part = np.clip((width - at_tip[:, None]) / (there - at_tip[:, None]), 0, 1)
    part[(low >= width) | (high <= width)] = 0
    start = CORNERS[tip]
    side = part[..., None] * (CORNERS[others] - start[:, None])
    points, at = triangle_quadrature(degree)
    inside = start[:, None] + np.einsum("qk,nkx->nqx", points, side)
    basis = orthonormal_basis(degree, inside.reshape(-1, 2)).reshape(len(inside), len(at), -1)
    cut = part.prod(axis=1)
    weights = cut[:, None] * np.einsum("q,nqm->nm", at, basis)
    sign = np.where(near, 1.0, -1.0)
    whole = np.where(near, 0.0, 1.0)
    weights *= sign[:, None]
    weights[:, 0] += whole
    return weights, whole + sign * cut


def strip_means(strips: Strips, coefficients: np.ndarray) -> np.ndarray:
    """Mean force or moment of each strip, (S, 3, c) xx, yy, xy in the axes of its facet.

    coefficients (E, 3, m, c) kN/m or kNm/m, in the axes of elements.
    """
    own = coefficients[strips.element]
    xx, yy, xy = np.einsum("qm,qsmc->sqc", strips.weights, own, optimize=True)
    turn = strips.turn[..., None]
    (a, b), (c, d) = turn[:, 0].swapaxes(0, 1), turn[:, 1].swapaxes(0, 1)
    turned = np.stack(
        [
            a * a * xx + b * b * yy + 2 * a * b * xy,
            c * c * xx + d * d * yy + 2 * c * d * xy,
            a * c * xx + b * d * yy + (a * d + b * c) * xy,
        ],
        axis=1,
    )
    return np.add.reduceat(turned, strips.first, axis=0)


def spread_to_coefficients(strips: Strips, values: np.ndarray, elements: int) -> np.ndarray:
    """The transpose of `strip_means`: (S, 3, c) to (E, 3, m, c), for gradients.

    values are derivatives by the means xx, yy, xy of each strip; `elements` is E.
    """
    count = np.diff(np.append(strips.first, len(strips.element)))
    xx, yy, xy = np.moveaxis(np.repeat(values, count, axis=0), 1, 0)
    turn = strips.turn[..., None]
    (a, b), (c, d) = turn[:, 0].swapaxes(0, 1), turn[:, 1].swapaxes(0, 1)
    own = np.stack(
        [
            a * a * xx + c * c * yy + a * c * xy,
            b * b * xx + d * d * yy + b * d * xy,
            2 * a * b * xx + 2 * c * d * yy + (a * d + b * c) * xy,
        ],
        axis=1,
    )
    found = np.zeros((elements, 3, strips.weights.shape[1], values.shape[2]))
    np.add.at(found, strips.element, own[:, :, None] * strips.weights[:, None, :, None])
    return found


def utilization_of_strips(
    strips: Strips,
    resultants: StressResultants,
    thickness: np.ndarray,
    material: Material,
    criterion: Criterion | None = None,
) -> np.ndarray:
    """Criterion of the mean forces and moments of each strip: (S, c), no unit.

    The largest over top, middle and bottom surface; thickness (E,) m of elements. The criterion is
    that of the material where none is given.
    """
    criterion = criterion or CRITERIA[material.criterion]
    force, moment = (
        strip_means(strips, one).transpose(0, 2, 1)[:, None]
        for one in (resultants.force, resultants.moment)
    )
    stress = surface_stresses(force, moment, thickness[strips.element[strips.first]])
    return criterion(stress, material).max(axis=0)[:, 0]


def largest_of_panels(strips: Strips, values: np.ndarray) -> np.ndarray:
    """Return the largest value (P, ...) of the rows of each panel, from those of rows (S, ...)."""
    largest = np.full((int(strips.panel.max()) + 1, *values.shape[1:]), -np.inf)
    np.maximum.at(largest, strips.panel, values)
    return largest
