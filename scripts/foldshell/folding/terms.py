"""Residual terms of the folding problem, each with its analytic sparse Jacobian.

A term has `columns` (m, k), the unknowns each row depends on (3 v + axis for vertex v), and
`evaluate(vertices)` -> residual (m,), values (m, k), already times the root of its weight.
Everything is non-dimensional: strains, radians, distances over a reference length.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from foldshell.pattern.angles import measure_hinges


class Term(Protocol):
    """What the solvers need of a term."""

    columns: np.ndarray

    def evaluate(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Residual (m,) and its derivatives (m, k) at vertices (V, 3)."""
        ...


class Target(Protocol):
    """A surface that vertices are drawn to, over a rectangular plan, described from its middle."""

    @property
    def origin(self) -> tuple[float, float, float]:
        """Where the middle of the plan stands in space [m]."""
        ...

    @property
    def span(self) -> float:
        """Longer side of the plan [m]."""
        ...

    @property
    def sides(self) -> tuple[float, float]:
        """Sides of the plan along x and y [m]."""
        ...

    @property
    def height(self) -> float:
        """Range of heights [m]."""
        ...

    def find_closest(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Closest points (N, 3) [m] and upward unit normals (N, 3)."""
        ...

    def measure_distances(self, points: np.ndarray) -> np.ndarray:
        """Signed distances (N,) [m] of points (N, 3), above positive."""
        ...

    def measure_reach(self, points: np.ndarray) -> float:
        """How far [m] points (N, 3) lie beyond the border of the surface."""
        ...

    def evaluate_height(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """z(x, y) [m]."""
        ...

    def find_normals(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Upward unit normals (N, 3) above plan positions."""
        ...

    def section_lengths(self) -> tuple[float, float]:
        """Arc lengths [m] of the central sections y = 0 and x = 0."""
        ...

    def walk_section(self, axis: int, arc: np.ndarray) -> np.ndarray:
        """Coordinate (k,) [m] at arc length (k,) [m] from the middle of a central section."""
        ...


def measure_distances(points: np.ndarray, target: Target) -> np.ndarray:
    """Signed distances (N,) [m] of points (N, 3) to the target, above positive."""
    return target.measure_distances(points)


def vertex_columns(vertices: np.ndarray) -> np.ndarray:
    """Unknowns (m, 3 k) of rows that touch vertices (m, k)."""
    return (3 * vertices[:, :, None] + np.arange(3)).reshape(len(vertices), 3 * vertices.shape[1])


@dataclass(frozen=True)
class Stretch:
    """r = sqrt(w) (|e| - l) / l for edges (m, 2) of rest lengths l (m,)."""

    edges: np.ndarray
    lengths: np.ndarray
    weight: float

    @property
    def columns(self) -> np.ndarray:
        """Unknowns (m, 6)."""
        return vertex_columns(self.edges)

    def evaluate(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Residual (m,) and derivatives (m, 6)."""
        edge = vertices[self.edges[:, 1]] - vertices[self.edges[:, 0]]
        length = np.linalg.norm(edge, axis=1)
        root = np.sqrt(self.weight)
        gradient = root * edge / (length * self.lengths)[:, None]
        return root * (length / self.lengths - 1), np.hstack([-gradient, gradient])


@dataclass(frozen=True)
class Hinge:
    """r = sqrt(w) wrap(phi - phi_0) for hinges (m, 4); angles in radians, valley positive."""

    hinges: np.ndarray
    rest: np.ndarray
    weight: float

    @property
    def columns(self) -> np.ndarray:
        """Unknowns (m, 12)."""
        return vertex_columns(self.hinges)

    def evaluate(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Residual (m,) and derivatives (m, 12)."""
        difference = measure_hinges(vertices, self.hinges) - self.rest
        wrapped = np.pi - np.mod(np.pi - difference, 2 * np.pi)
        root = np.sqrt(self.weight)
        return root * wrapped, root * differentiate_hinges(vertices, self.hinges)


def differentiate_hinges(vertices: np.ndarray, hinges: np.ndarray) -> np.ndarray:
    """Derivatives (m, 12) of the fold angles of hinges (m, 4).

    An opposite vertex turns its facet by 1 / height; the ends take what leaves the sum and
    the moment zero.
    """
    first, second, left, right = (vertices[hinges[:, k]] for k in range(4))
    edge = second - first
    squared = np.einsum("ij,ij->i", edge, edge)[:, None]
    length = np.sqrt(squared)
    normal_left = np.cross(edge, left - first)
    normal_right = np.cross(right - first, edge)
    by_left = length * normal_left / np.einsum("ij,ij->i", normal_left, normal_left)[:, None]
    by_right = length * normal_right / np.einsum("ij,ij->i", normal_right, normal_right)[:, None]
    along_left = np.einsum("ij,ij->i", left - first, edge)[:, None] / squared
    along_right = np.einsum("ij,ij->i", right - first, edge)[:, None] / squared
    by_second = -along_left * by_left - along_right * by_right
    by_first = -by_left - by_right - by_second
    return np.hstack([by_first, by_second, by_left, by_right])


@dataclass(frozen=True)
class Attraction:
    """r = sqrt(w) n.(x - p(x)) / ell: signed distance to the target, free to slide."""

    vertices: np.ndarray
    target: Target
    reference: float
    weight: float

    @property
    def columns(self) -> np.ndarray:
        """Unknowns (m, 3)."""
        return vertex_columns(self.vertices[:, None])

    def evaluate(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Residual (m,) and derivatives (m, 3); the gradient of the distance is n itself."""
        points = vertices[self.vertices]
        closest, normals = self.target.find_closest(points)
        scale = np.sqrt(self.weight) / self.reference
        return scale * np.einsum("ij,ij->i", normals, points - closest), scale * normals


@dataclass(frozen=True)
class PlanEdge:
    """r = sqrt(w) (x_axis - position) / ell: border vertices (m,) held near the plan's edge."""

    vertices: np.ndarray
    axes: np.ndarray
    positions: np.ndarray
    reference: float
    weight: float

    @property
    def columns(self) -> np.ndarray:
        """Unknowns (m, 1)."""
        return (3 * self.vertices + self.axes)[:, None]

    def evaluate(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Residual (m,) and derivatives (m, 1)."""
        scale = np.sqrt(self.weight) / self.reference
        offset = vertices[self.vertices, self.axes] - self.positions
        return scale * offset, np.full((len(offset), 1), scale)
