"""A mesh file as a target surface: one height per place over a square plan, where it stands."""

import itertools
import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.meshes.model import Mesh, MeshError, count
from foldshell.files.meshes.nurbs import CHORD
from foldshell.files.meshes.read import read_mesh
from foldshell.files.meshes.triangles import (
    Triangles,
    find_border,
    make_triangles,
    measure_double_areas,
)
from foldshell.files.units import FACTORS, WORDS, find_factor, name_unit

STEEPEST = math.radians(85)  # slope of a triangle; walls have no one height per place
LEAST, LARGEST = 0.9, 3.0  # sizes of the plan that are taken, of the span
COARSE = 0.1  # of the median edge: steps of single precision that spoil the mesh
UNITS = (
    ("millimetres", 1000.0),
    ("centimetres", 100.0),
    ("inches", 1 / 0.0254),
    ("feet", 1 / 0.3048),
)
SAMPLES = 41  # points of the plan along a side at which the surface is looked for


@dataclass(frozen=True)
class Surface:
    """Vertices (V, 3) [m] and triangles (F, 3) as they stand in space; the plan's middle.

    `notes` says what of the file was left out.
    """

    vertices: np.ndarray
    triangles: np.ndarray
    middle: tuple[float, float]
    notes: tuple[str, ...]


def read_surface(
    path: str | Path,
    span: float,
    file_unit: str = "m",
    sides: tuple[float, float] | None = None,
) -> Surface:
    """Read a target surface over a square plan of side `span` [m], or a rectangle of two `sides`.

    `file_unit` is that of the file's coordinates, a key of FACTORS.

    Raises InputError for a file that cannot be read, and for a surface of another scale than the
    span, closed, lying over itself in plan, too steep, or with gaps in the plan.
    """
    given = read_mesh(path, name_unit(file_unit), CHORD * min(sides or (span,)))
    factor = find_factor(given.unit, file_unit)
    mesh = given if factor == 1 else replace(given, vertices=factor * given.vertices)
    try:
        found = make_triangles(mesh)
        low, high = found.vertices.min(axis=0), found.vertices.max(axis=0)
        middle = (0.5 * (low + high))[:2]
        step = factor * _measure_step(given)
        _check_step(found, step if mesh.single else 0.0)
        try:
            plan = np.array(sides or (span, span))
            _check_scale(high - low, plan, factor)
            _check_surface(found, span, step)
            _check_cover(found, middle, plan, step)
        except MeshError as error:
            raise MeshError(f"{error}{_suspect_end(mesh)}") from None
    except MeshError as error:
        raise InputError(f"{path}: {error}") from None
    return Surface(
        found.vertices, found.triangles, (float(middle[0]), float(middle[1])), found.notes
    )


def _measure_step(mesh: Mesh) -> float:
    """Largest step [m] between neighbouring values that the coordinates could have."""
    if mesh.single:
        return float(np.spacing(np.float32(np.abs(mesh.vertices).max(initial=0.0))))
    for digits in range(-6, 7):
        if np.allclose(mesh.vertices, np.round(mesh.vertices, digits), rtol=0, atol=1e-9):
            return 10.0**-digits
    return 0.0


def _median_edge(found: Triangles) -> float:
    corners = found.vertices[found.triangles]
    return float(np.median(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)))


def _check_step(found: Triangles, step: float) -> None:
    if step > COARSE * _median_edge(found):
        far = np.abs(found.vertices).max()
        raise MeshError(
            f"coordinates of up to {far:.3g} m in single precision, which holds them to "
            f"{step:.2g} m only: move the surface nearer to the origin, or export it "
            "as OBJ or OFF with all digits"
        )


def _suspect_step(found: Triangles, step: float) -> str:
    if step <= COARSE * _median_edge(found):
        return ""
    return f"; its coordinates are given to {step:.2g} m only, more digits may be needed"


def _suspect_end(mesh: Mesh) -> str:
    unused = len(mesh.vertices) - 1 - int(mesh.corners.max())
    if unused <= 0:
        return ""
    return f"; no face uses the last {count(unused, 'vertex', 'vertices')}, it may be cut off"


def _check_scale(size: np.ndarray, sides: np.ndarray, factor: float) -> None:
    if _fits(size[:2], sides):
        return
    square = sides[0] == sides[1]
    due = f"{sides[0]:g}" if square else f"{sides[0]:g} x {sides[1]:g}"
    raise MeshError(
        f"plan {size[0]:.4g} x {size[1]:.4g} m: must cover the span of {due} m and be at most "
        f"{LARGEST:g} times as large{guess_cause(size, sides.min(), factor)}"
    )


def _fits(plan: np.ndarray, span: float | np.ndarray) -> bool:
    return bool((plan >= LEAST * span).all() and (plan <= LARGEST * span).all())


def guess_cause(size: np.ndarray, span: float, taken: float = 1.0) -> str:
    """Say which unit or axis would make a mesh of this size (3,) fit: for a message only.

    The size is in m, found by the factor `taken` of the file's unit.
    """
    best, words, size = math.inf, "", size / taken
    due = next(WORDS[key] for key, factor in FACTORS.items() if factor == taken)
    for up, (unit, factor) in itertools.product((2, 1, 0), (("metres", 1.0), *UNITS)):
        plan = np.delete(size, up) / factor
        if not _fits(plan, span):
            continue
        misfit = abs(math.log(plan.min() / span)) + (2.0 if up != 2 else 0.0)
        misfit += 2.0 if size[up] / factor > 2 * span else 0.0
        if misfit < best:
            seems = [f"{'xyz'[up]} seems to be up, z is due"] if up != 2 else []
            seems += [f"it looks like {unit}, {due} are due"] if unit != due else []
            best, words = misfit, "; " + " and ".join(seems)
    return words


def _check_surface(found: Triangles, span: float, step: float) -> None:
    vertices, triangles = found.vertices, found.triangles
    edges, number = find_border(triangles)
    if (number > 2).any():
        ends = vertices[edges[int(number.argmax())]].mean(axis=0)
        raise MeshError(
            f"{count(int((number > 2).sum()), 'edge')} with three or more triangles, one near "
            f"{_say_place(ends)}: at most two are allowed"
        )
    if not (number == 1).any():
        raise MeshError("a closed surface: an open one over the plan is needed")
    steep, plan = _find_steep(vertices, triangles, 2)
    if steep.any():
        place = vertices[triangles[int(steep.argmax())]].mean(axis=0)
        raise MeshError(
            f"{count(int(steep.sum()), 'triangle')} steeper than {math.degrees(STEEPEST):.0f} deg, "
            f"one near {_say_place(place)}: a surface without walls is needed, z up"
            f"{_suspect_axis(vertices, triangles, span)}{_suspect_step(found, step)}"
        )
    low, high = vertices[:, :2].min(axis=0), vertices[:, :2].max(axis=0)
    if plan.sum() / 2 > 1.01 * np.prod(high - low):
        raise MeshError("surface lies over itself in plan: one height per place is needed")


def _find_steep(vertices: np.ndarray, triangles: np.ndarray, up: int) -> tuple:
    """Which triangles (F,) are walls where `up` is up, and twice their areas in plan (F,)."""
    corners = vertices[triangles]
    double = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area, plan = measure_double_areas(vertices, triangles), np.abs(double[:, up])
    return (plan < math.cos(STEEPEST) * area) & (area > 1e-6 * area.sum()), plan


def _suspect_axis(vertices: np.ndarray, triangles: np.ndarray, span: float) -> str:
    size = np.ptp(vertices, axis=0)
    for up in (1, 0):
        free = not _find_steep(vertices, triangles, up)[0].any()
        if free and _fits(np.delete(size, up), span):
            return f"; {'xyz'[up]} seems to be up"
    return ""


def _say_place(point: np.ndarray) -> str:
    return f"x = {point[0]:.6g}, y = {point[1]:.6g} m"


def _check_cover(found: Triangles, middle: np.ndarray, sides: np.ndarray, step: float) -> None:
    """Refuse a surface that leaves a place of the plan without a height near it.

    A rectangle is looked at as the square of its longer side, the other axis stretched to it.
    """
    span = sides.max()
    stretch = span / sides
    along = np.linspace(-0.45 * span, 0.45 * span, SAMPLES)
    points = np.stack(np.meshgrid(along, along, indexing="ij"), axis=-1).reshape(-1, 2)
    corners = (found.vertices[found.triangles][:, :, :2] - middle) * stretch
    bare = points[~find_covered(corners, along)]
    if not len(bare):
        return
    edges, number = find_border(found.triangles)
    border = (found.vertices[edges[number == 1]][:, :, :2] - middle) * stretch
    gap = measure_gaps(bare, border)
    worst = int(gap.argmax())
    if gap[worst] > 0.02 * span:
        square = sides[0] == sides[1]
        size = f"side {span:g} m" if square else f"{sides[0]:g} x {sides[1]:g} m"
        place = _say_place(bare[worst] / stretch + middle)
        raise MeshError(
            f"no surface above {place}: must cover the {'square ' if square else ''}plan of {size} "
            f"about {_say_place(middle)}, the middle of its own plan{_suspect_step(found, step)}"
        )


def find_covered(corners: np.ndarray, along: np.ndarray) -> np.ndarray:
    """Which points (N * N,) of the square grid `along` (N,) lie in triangles (F, 3, 2) in plan.

    Coordinates in one unit of length.
    """
    size, spacing = len(along), along[1] - along[0]
    scaled = (corners - along[0]) / spacing
    low = np.clip(np.ceil(scaled.min(axis=1) - 1e-9), 0, size).astype(int)
    high = np.clip(np.floor(scaled.max(axis=1) + 1e-9) + 1, 0, size).astype(int)
    wide = np.maximum(high - low, 0)
    total = wide[:, 0] * wide[:, 1]
    triangle = np.repeat(np.arange(len(corners)), total)
    place = np.arange(total.sum()) - np.repeat(np.cumsum(total) - total, total)
    row, column = np.divmod(place, wide[triangle, 1])
    point = low[triangle] + np.column_stack([row, column])
    turns = []
    for k in range(3):
        start, end = scaled[triangle, k], scaled[triangle, (k + 1) % 3]
        one, two = end - start, point - start
        turns.append(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])
    inside = (np.min(turns, axis=0) >= -1e-9) | (np.max(turns, axis=0) <= 1e-9)
    covered = np.zeros((size, size), dtype=bool)
    covered[point[inside, 0], point[inside, 1]] = True
    return covered.ravel()


def measure_gaps(points: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Distance (N,) of points (N, 2) in plan to the nearest of edges (E, 2, 2).

    Coordinates in one unit of length.
    """
    start, along = edges[:, 0], edges[:, 1] - edges[:, 0]
    squared = np.maximum((along**2).sum(axis=1), 1e-300)
    gaps = np.empty(len(points))
    for row, point in enumerate(points):
        share = np.clip(((point - start) * along).sum(axis=1) / squared, 0, 1)
        gaps[row] = np.linalg.norm(start + share[:, None] * along - point, axis=1).min()
    return gaps
