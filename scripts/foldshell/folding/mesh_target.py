"""Free-form targets: a triangle mesh in metres, from a file.

Closest points by VTK's static cell locator; normals are interpolated from the vertices, so that
the distance is smooth where facets meet.
"""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from foldshell.files.meshes.surface import read_surface

SAMPLES = 801  # points of a central section
FLATTEN = 1e-6  # heights are scaled by it where only the plan position counts


@dataclass(frozen=True)
class MeshTarget:
    """Triangles (F, 3) over vertices (V, 3) [m] from the middle of the plan, seen from above.

    `origin` [m] is where that middle stands in the space of the file.
    """

    name: str
    span: float
    vertices: np.ndarray
    triangles: np.ndarray
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)
    rectangle: tuple[float, float] | None = None

    @property
    def sides(self) -> tuple[float, float]:
        """Sides of the plan along x and y [m]."""
        return self.rectangle or (self.span, self.span)

    @property
    def height(self) -> float:
        """Range of heights [m]."""
        return float(np.ptp(self.vertices[:, 2]))

    @cached_property
    def normals(self) -> np.ndarray:
        """Upward unit normals (V, 3) of the vertices, means of their facets by area."""
        corners = self.vertices[self.triangles]
        facet = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        facet *= np.where(facet[:, 2] < 0, -1.0, 1.0)[:, None]
        total = np.zeros_like(self.vertices)
        for k in range(3):
            np.add.at(total, self.triangles[:, k], facet)
        return total / np.linalg.norm(total, axis=1)[:, None]

    @cached_property
    def _locator(self) -> "_Locator":
        return _Locator(self.vertices, self.triangles)

    @cached_property
    def _plan_locator(self) -> "_Locator":
        return _Locator(self.vertices * [1, 1, FLATTEN], self.triangles)

    def find_closest(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Closest points (N, 3) [m] and interpolated upward unit normals (N, 3)."""
        cells, weights = self._locator.find_closest(points)
        return self._interpolate(cells, weights)

    def measure_distances(self, points: np.ndarray) -> np.ndarray:
        """Signed distances (N,) [m] of points (N, 3), above positive.

        Beyond the border, where a zig-zag reaches out of the plan, that to the surface continued
        along its tangent planes: n.(x - p).
        """
        along, straight, beyond = self._look_from(points)
        return np.where(beyond, along, np.copysign(straight, along))

    def measure_reach(self, points: np.ndarray) -> float:
        """How far [m] points (N, 3) lie beyond the border of the surface, 0 if none does."""
        along, straight, beyond = self._look_from(points)
        reach = np.sqrt(np.maximum(straight**2 - along**2, 0.0))
        return float(reach[beyond].max(initial=0.0))

    def _look_from(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """n.(x - p) and |x - p| (N,) [m], and whether p is on the border (N,)."""
        cells, weights = self._locator.find_closest(points)
        closest, normals = self._interpolate(cells, weights)
        offset = points - closest
        on_vertex = (weights > 1 - 1e-9) & self._border_vertices[self.triangles[cells]]
        on_edge = (weights < 1e-9) & self._border_sides[cells]
        beyond = (on_vertex | on_edge).any(axis=1)
        along = np.einsum("ij,ij->i", normals, offset)
        return along, np.linalg.norm(offset, axis=1), beyond

    @cached_property
    def _border_sides(self) -> np.ndarray:
        """Whether the side opposite of each corner (F, 3) is on the border."""
        opposite = self.triangles[:, [[1, 2], [2, 0], [0, 1]]]
        edges = np.sort(opposite.reshape(-1, 2), axis=1)
        _, place, number = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
        return (number[place.ravel()] == 1).reshape(-1, 3)

    @cached_property
    def _border_vertices(self) -> np.ndarray:
        """Whether each vertex (V,) is on the border."""
        flags = np.zeros(len(self.vertices), dtype=bool)
        flags[self.triangles[:, [[1, 2], [2, 0], [0, 1]]][self._border_sides]] = True
        return flags

    def _interpolate(self, cells: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        corners = self.triangles[cells]
        closest = np.einsum("nk,nkc->nc", weights, self.vertices[corners])
        normals = np.einsum("nk,nkc->nc", weights, self.normals[corners])
        return closest, normals / np.linalg.norm(normals, axis=1)[:, None]

    def _look_down(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        points = np.column_stack([x, y, np.full(len(x), FLATTEN * self.vertices[:, 2].mean())])
        return self._interpolate(*self._plan_locator.find_closest(points))

    def evaluate_height(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """z(x, y) [m]; beyond the mesh that of its nearest border."""
        return self._look_down(x, y)[0][:, 2]

    def find_normals(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Upward unit normals (N, 3) above plan positions."""
        return self._look_down(x, y)[1]

    @cached_property
    def _sections(self) -> tuple[tuple[np.ndarray, np.ndarray], ...]:
        zero = np.zeros(SAMPLES)
        sections = []
        for axis, side in enumerate(self.sides):
            along = np.linspace(-side / 2, side / 2, SAMPLES)
            x, y = (zero, along) if axis else (along, zero)
            steps = np.hypot(np.diff(along), np.diff(self.evaluate_height(x, y)))
            arc = np.concatenate([[0.0], np.cumsum(steps)])
            sections.append((along, arc - arc[SAMPLES // 2]))
        return tuple(sections)

    def section_lengths(self) -> tuple[float, float]:
        """Arc lengths [m] of the central sections y = 0 and x = 0 over the span."""
        first, second = (float(arc[-1] - arc[0]) for _, arc in self._sections)
        return first, second

    def walk_section(self, axis: int, arc: np.ndarray) -> np.ndarray:
        """Coordinate at arc length from the section's middle [m].

        `arc` runs between minus and plus half the section's length; the section's own middle
        by length is where it is 0.

        arc (k,) m; returns (k,) m.
        """
        along, length = self._sections[axis]
        middle = 0.5 * (length[0] + length[-1])
        return np.interp(arc + middle, length, along)


class _Locator:
    """Closest triangle of a mesh and barycentric weights of the closest point on it."""

    def __init__(self, vertices: np.ndarray, triangles: np.ndarray) -> None:
        import pyvista
        from vtkmodules.vtkCommonDataModel import vtkStaticCellLocator

        self._mesh = pyvista.PolyData.from_regular_faces(vertices, triangles)
        self._corners = vertices[triangles]
        self._locator = vtkStaticCellLocator()
        self._locator.SetDataSet(self._mesh)
        self._locator.BuildLocator()

    def find_closest(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Triangles (N,) closest to points (N, 3), and the closest points' weights (N, 3)."""
        from vtkmodules.vtkCommonCore import mutable

        cell, sub, squared = mutable(0), mutable(0), mutable(0.0)
        place = [0.0, 0.0, 0.0]
        cells = np.empty(len(points), dtype=int)
        closest = np.empty((len(points), 3))
        for row, point in enumerate(points):
            self._locator.FindClosestPoint(point, place, cell, sub, squared)
            cells[row], closest[row] = cell.get(), place
        return cells, _find_weights(self._corners[cells], closest)


def _find_weights(corners: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Barycentric weights (N, 3) of points on triangles (N, 3, 3)."""
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    arm = points - corners[:, 0]
    normal = np.cross(one, two)
    squared = np.einsum("ij,ij->i", normal, normal)
    second = np.einsum("ij,ij->i", np.cross(arm, two), normal) / squared
    third = np.einsum("ij,ij->i", np.cross(one, arm), normal) / squared
    return np.column_stack([1 - second - third, second, third])


def read_mesh_target(
    path: str | Path,
    span: float,
    file_unit: str = "m",
    sides: tuple[float, float] | None = None,
) -> MeshTarget:
    """Read a target surface from a mesh file; `origin` says where the middle of its plan stands.

    Raises InputError for a file that cannot be read, and for a surface that is closed, folded
    over in plan, with holes or gaps in the plan, or of another scale than the span.
    """
    surface = read_surface(path, span, file_unit, sides)
    origin = (*surface.middle, 0.0)
    found = surface.vertices - origin
    longest = max(sides or (span,))
    return MeshTarget(Path(path).stem, longest, found, surface.triangles, origin, sides)
