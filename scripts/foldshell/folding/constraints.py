"""Constraints of true origami, and the fairness that makes them solvable.

Planar panels, angle sum 2 pi and Kawasaki's alternating sum about interior vertices, as
residual terms like those of `terms`. After Dudte, Vouga, Tachi and Mahadevan, Nat. Mater. 15
(2016) 583.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.folding.terms import differentiate_hinges, vertex_columns
from foldshell.pattern.angles import corner_sectors, measure_hinges, measure_sectors
from foldshell.pattern.grid import Grid, find_hinges


@dataclass(frozen=True)
class PlanarPanels:
    """r = sqrt(w) (b - a).((c - a) x (d - a)) / volume for quads (P, 4), volumes (P,) [m3].

    With volume = |diagonal x diagonal| ell the residual is the diagonals' distance over ell.
    """

    quads: np.ndarray
    volumes: np.ndarray
    weight: float = 1.0

    @property
    def columns(self) -> np.ndarray:
        """Unknowns (P, 12). Numbers 3 v + axis of the vertices' coordinates."""
        return vertex_columns(self.quads)

    def evaluate(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Residual (P,) and derivatives (P, 12).

        vertices (V, 3) m; the residual has no unit, its derivatives are 1/m.
        """
        a, b, c, d = (vertices[self.quads[:, k]] for k in range(4))
        scale = np.sqrt(self.weight) / self.volumes
        by_b = np.cross(c - a, d - a)
        by_c = np.cross(d - a, b - a)
        by_d = np.cross(b - a, c - a)
        residual = np.einsum("ij,ij->i", b - a, by_b)
        return scale * residual, scale[:, None] * np.hstack([-by_b - by_c - by_d, by_b, by_c, by_d])


@dataclass(frozen=True)
class VertexAngles:
    """r = sqrt(w) (sum_k s_k alpha_k - total) over the d panel angles of inner vertices.

    `corners` (d, N, 3) of (vertex, arm, arm) in turn; signs (1, 1, 1, 1) with total 2 pi is the
    angle sum of a developable vertex of degree 4, (1, -1, 1, -1) with total 0 Kawasaki's condition.
    """

    corners: np.ndarray
    signs: tuple[float, ...]
    total: float
    weight: float = 1.0

    @property
    def columns(self) -> np.ndarray:
        """Unknowns (N, 3 + 3 d): the vertex, then its neighbours in turn.

        Numbers 3 v + axis of the vertices' coordinates.
        """
        around = [self.corners[0][:, 0], *(corner[:, 1] for corner in self.corners)]
        return vertex_columns(np.stack(around, axis=1))

    def evaluate(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Residual (N,) and derivatives (N, 3 + 3 d).

        vertices (V, 3) m; the residual has no unit, its derivatives are 1/m.
        """
        angles = measure_sectors(vertices, self.corners)
        values = np.zeros((angles.shape[1], 1 + len(self.signs), 3))
        for k, sign in enumerate(self.signs):
            by_one, by_two = differentiate_sectors(vertices, self.corners[k])
            values[:, 0] -= sign * (by_one + by_two)
            values[:, 1 + k] += sign * by_one
            values[:, 1 + (k + 1) % len(self.signs)] += sign * by_two
        root = np.sqrt(self.weight)
        residual = np.asarray(self.signs) @ angles - self.total
        return root * residual, root * values.reshape(len(values), -1)


def differentiate_sectors(
    vertices: np.ndarray, corners: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """u x n / |u|2 and n x v / |v|2: how angles (N,) follow the ends of their two arms.

    vertices (V, 3) m, corners (N, 3) as numbers; both (N, 3) rad/m.
    """
    one = vertices[corners[:, 1]] - vertices[corners[:, 0]]
    two = vertices[corners[:, 2]] - vertices[corners[:, 0]]
    normal = np.cross(one, two)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    by_one = np.cross(one, normal) / np.einsum("ij,ij->i", one, one)[:, None]
    by_two = np.cross(normal, two) / np.einsum("ij,ij->i", two, two)[:, None]
    return by_one, by_two


@dataclass(frozen=True)
class Fairness:
    """r = sqrt(w) (x_i - 3 x_(i+2) + 3 x_(i+4) - x_(i+6)) / ell, rows of vertices (m, 4).

    Third differences over every second polyline: zero for a pattern that changes evenly.
    """

    chains: np.ndarray
    reference: float
    weight: float

    @property
    def columns(self) -> np.ndarray:
        """Unknowns (3m, 4). Numbers 3 v + axis of the vertices' coordinates."""
        return (3 * self.chains[:, None, :] + np.arange(3)[:, None]).reshape(-1, 4)

    def evaluate(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Residual (3m,) and derivatives (3m, 4).

        vertices (V, 3) m; the residual has no unit, its derivatives are 1/m.
        """
        factors = np.sqrt(self.weight) / self.reference * np.array([1.0, -3.0, 3.0, -1.0])
        residual = np.einsum("k,mkc->mc", factors, vertices[self.chains]).ravel()
        return residual, np.broadcast_to(factors, (len(residual), 4))


def find_chains(grid: Grid) -> np.ndarray:
    """Rows (m, 4) of vertices two polylines apart, along both families."""
    number = np.arange(grid.zigzag_count * grid.strip_count).reshape(
        grid.zigzag_count, grid.strip_count
    )
    along_strips = [number[k : grid.zigzag_count - 6 + k].ravel() for k in (0, 2, 4, 6)]
    along_zigzags = [number[:, k : grid.strip_count - 6 + k].ravel() for k in (0, 2, 4, 6)]
    parts = []
    if grid.zigzag_count > 6:
        parts.append(np.stack(along_strips, axis=1))
    if grid.strip_count > 6:
        parts.append(np.stack(along_zigzags, axis=1))
    return np.vstack(parts) if parts else np.empty((0, 4), dtype=int)


def require_planar(
    grid: Grid, vertices: np.ndarray, reference: float, weight: float
) -> PlanarPanels:
    """Planar panels, scaled by the panels' size in `vertices`.

    vertices (V, 3) m, reference in m; residuals have no unit.
    """
    a, b, c, d = (vertices[grid.quads[:, k]] for k in range(4))
    areas = np.linalg.norm(np.cross(c - a, d - b), axis=1)
    return PlanarPanels(grid.quads, areas * reference, weight)


def require_developable(grid: Grid, weight: float) -> VertexAngles:
    """Angle sum 2 pi about every interior vertex."""
    return VertexAngles(corner_sectors(grid), (1.0, 1.0, 1.0, 1.0), 2 * np.pi, weight)


def require_flat_foldable(grid: Grid, weight: float) -> VertexAngles:
    """Kawasaki's condition about every interior vertex; makes planar quads rigidly foldable."""
    return VertexAngles(corner_sectors(grid), (1.0, -1.0, 1.0, -1.0), 0.0, weight)


@dataclass(frozen=True)
class CornerRange:
    """r = sqrt(w) (alpha - nearest of [low, high]) for panel corners (N, 3); 0 inside."""

    corners: np.ndarray
    low: float
    high: float
    weight: float

    @property
    def columns(self) -> np.ndarray:
        """Unknowns (N, 9): vertex and both arms.

        Numbers 3 v + axis of the vertices' coordinates.
        """
        return vertex_columns(self.corners)

    def evaluate(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Residual (N,) and derivatives (N, 9).

        vertices (V, 3) m; the residual has no unit, its derivatives are 1/m.
        """
        angles = measure_sectors(vertices, self.corners)
        by_one, by_two = differentiate_sectors(vertices, self.corners)
        excess = angles - np.clip(angles, self.low, self.high)
        active = np.sqrt(self.weight) * (excess != 0)
        values = np.hstack([-by_one - by_two, by_one, by_two])
        return np.sqrt(self.weight) * excess, active[:, None] * values


@dataclass(frozen=True)
class FoldRange:
    """r = sqrt(w) (s phi - nearest of [low, high]) for creases (m, 4) of direction s (m,)."""

    hinges: np.ndarray
    directions: np.ndarray
    low: float
    high: float
    weight: float

    @property
    def columns(self) -> np.ndarray:
        """Unknowns (m, 12)."""
        return vertex_columns(self.hinges)

    def evaluate(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Residual (m,) and derivatives (m, 12)."""
        # Measured from the direction's own side, so that a fold past flat is not a full turn.
        folds = self.directions * measure_hinges(vertices, self.hinges)
        folds = np.where(folds < -np.pi / 2, folds + 2 * np.pi, folds)
        excess = folds - np.clip(folds, self.low, self.high)
        active = np.sqrt(self.weight) * (excess != 0) * self.directions
        values = differentiate_hinges(vertices, self.hinges)
        return np.sqrt(self.weight) * excess, active[:, None] * values


def keep_convex(grid: Grid, margin: float, weight: float) -> CornerRange:
    """Keep every panel corner between `margin` and pi - `margin` [rad]."""
    quads = grid.quads
    corners = [quads[:, [k, (k + 1) % 4, (k + 3) % 4]] for k in range(4)]
    return CornerRange(np.vstack(corners), margin, np.pi - margin, weight)


def keep_folded(grid: Grid, margin: float, weight: float) -> FoldRange:
    """Keep every crease folded its own way, between `margin` and pi - `margin` [rad]."""
    hinges = find_hinges(grid.facets, grid.edges)
    kinds = grid.assignments[hinges.edges]
    crease = kinds != "F"
    directions = np.where(kinds[crease] == "V", 1.0, -1.0)
    return FoldRange(hinges.vertices[crease], directions, margin, np.pi - margin, weight)
