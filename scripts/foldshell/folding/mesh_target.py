"""Free-form targets: a triangle mesh in metres, from a file.

Closest points by VTK's static cell locator; normals are interpolated from the vertices, so that
the distance is smooth where facets meet.
"""

import math
import warnings
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from foldshell.files.errors import InputError

if TYPE_CHECKING:
    import pyvista

SUFFIXES = (".stl", ".obj", ".vtk", ".vtu", ".ply")
STEEPEST = math.radians(85)  # slope of a triangle; walls have no one height per place
SAMPLES = 801  # points of a central section
FLATTEN = 1e-6  # heights are scaled by it where only the plan position counts


@dataclass(frozen=True)
class MeshTarget:
    """Triangles (F, 3) over vertices (V, 3) [m], centred on the plan, seen from above."""

    name: str
    span: float
    vertices: np.ndarray
    triangles: np.ndarray

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
        along = np.linspace(-self.span / 2, self.span / 2, SAMPLES)
        zero = np.zeros(SAMPLES)
        sections = []
        for x, y in ((along, zero), (zero, along)):
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


def read_mesh_target(path: str | Path, span: float) -> MeshTarget:
    """Read a target surface from a mesh file and centre it on the plan.

    Raises InputError for a file that is missing, damaged or empty, closed, folded over in plan,
    with holes or gaps in the plan, or of another scale than the span.
    """
    vertices, triangles = _read_triangles(Path(path))
    vertices = vertices - [*(0.5 * (vertices.min(axis=0) + vertices.max(axis=0)))[:2], 0.0]
    _check_scale(path, vertices, span)
    _check_surface(path, vertices, triangles)
    target = MeshTarget(Path(path).stem, span, vertices, triangles)
    _check_cover(path, target)
    return target


def _read_triangles(path: Path) -> tuple[np.ndarray, np.ndarray]:
    import pyvista

    if path.suffix.lower() not in SUFFIXES:
        raise InputError(f"{path}: suffix {path.suffix!r}: must be one of {', '.join(SUFFIXES)}")
    if not path.is_file():
        raise InputError(f"{path}: no such file: a triangle mesh in metres is needed")
    try:
        with warnings.catch_warnings(record=True) as caught, pyvista.vtk_verbosity("off"):
            warnings.simplefilter("always")
            mesh = pyvista.read(path)
            _check_numbers(path, mesh)
            mesh = mesh.extract_surface(algorithm=None).triangulate().clean()
    except InputError:
        raise
    except Exception as error:  # the readers raise what they like
        raise InputError(f"{path}: cannot be read as a mesh ({error})") from None
    if any("raised an error" in str(warning.message) for warning in caught):
        raise InputError(f"{path}: damaged, empty or cut off: a whole mesh file is needed")
    triangles = np.asarray(mesh.faces).reshape(-1, 4)[:, 1:]
    vertices = np.asarray(mesh.points, dtype=float)
    if not len(triangles):
        raise InputError(f"{path}: 0 triangles: the file is empty or cut off")
    if not np.isfinite(vertices).all():
        raise InputError(f"{path}: coordinates that are not finite: must be numbers")
    corners = vertices[triangles]
    area = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    return vertices, triangles[area > 1e-14 * area.max()]


def _check_numbers(path: Path, mesh: "pyvista.DataSet") -> None:
    """Refuse cells that name vertices the file does not hold: VTK reads past its arrays."""
    if hasattr(mesh, "GetPolys"):
        cells = mesh.GetPolys()
    elif hasattr(mesh, "GetCells"):
        cells = mesh.GetCells()
    else:
        return
    count = cells.GetConnectivityArray().GetNumberOfTuples() if cells else 0
    low, high = cells.GetConnectivityArray().GetRange() if count else (0, -1)
    if low < 0 or high >= mesh.n_points:
        wrong = low if low < 0 else high
        raise InputError(
            f"{path}: a cell of vertex {wrong:.0f} (counted from 0): must be below {mesh.n_points}"
        )


def _check_scale(path: str | Path, vertices: np.ndarray, span: float) -> None:
    width = np.ptp(vertices[:, :2], axis=0)
    if (width < 0.9 * span).any() or (width > 3 * span).any():
        hint = "; it looks like millimetres" if (width > 300 * span).all() else ""
        raise InputError(
            f"{path}: plan {width[0]:g} x {width[1]:g} m: must cover the span of {span:g} m "
            f"and be at most three times as large{hint}"
        )


def _check_surface(path: str | Path, vertices: np.ndarray, triangles: np.ndarray) -> None:
    edges = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    _, count = np.unique(edges, axis=0, return_counts=True)
    if (count > 2).any():
        raise InputError(f"{path}: {(count > 2).sum()} edges with three or more triangles")
    if not (count == 1).any():
        raise InputError(f"{path}: a closed surface: an open one over the plan is needed")
    corners = vertices[triangles]
    double = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area, plan = np.linalg.norm(double, axis=1), np.abs(double[:, 2])
    walls = (plan < math.cos(STEEPEST) * area) & (area > 1e-6 * area.sum())
    if walls.any():
        raise InputError(
            f"{path}: {walls.sum()} triangles steeper than {math.degrees(STEEPEST):.0f} deg: "
            "a surface without walls is needed, z up"
        )
    low, high = vertices[:, :2].min(axis=0), vertices[:, :2].max(axis=0)
    if plan.sum() / 2 > 1.01 * np.prod(high - low):
        raise InputError(f"{path}: surface lies over itself in plan: one height per place is due")


def _check_cover(path: str | Path, target: MeshTarget) -> None:
    half = target.span / 2
    along = np.linspace(-0.9 * half, 0.9 * half, 41)
    x, y = (k.ravel() for k in np.meshgrid(along, along))
    found = target._look_down(x, y)[0]
    gap = np.hypot(found[:, 0] - x, found[:, 1] - y)
    worst = int(gap.argmax())
    if gap[worst] > 0.02 * target.span:
        raise InputError(
            f"{path}: no surface above x = {x[worst]:.3g}, y = {y[worst]:.3g} m (from the middle "
            f"of its plan): must cover the square plan of side {target.span:g} m"
        )
