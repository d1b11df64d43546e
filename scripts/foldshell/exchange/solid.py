"""The folded sheet as a solid: every panel with its thickness, mitred at folds, closed.

Each planar panel, and each facet of a bent one, is a slab between its plane's two offsets by half
its thickness. At a fold it ends in the plane that halves the angle to its neighbour; where the
neighbour is thinner, a step face in that plane closes the difference. A border ends square. Around
a vertex the offset planes have in general no common point: neighbours end at a point of their
common edge half way between where each of them would end alone, and a small cap joins these points;
on the border the wall goes round them.
"""

import itertools
from dataclasses import dataclass

import numpy as np

from foldshell.exchange.model import ExportModel
from foldshell.exchange.sides import Sides, list_sides
from foldshell.files.errors import InputError

MERGE = 1e-5
"""Points that lie so near (m) are one: single precision, as STL has it, tells no nearer ones."""


@dataclass(frozen=True)
class Solid:
    """A closed surface: `points` (N, 3) m, `triangles` (T, 3) with outward normals, `panel` (T,) of
    each triangle."""

    points: np.ndarray
    triangles: np.ndarray
    panel: np.ndarray

    @property
    def volume(self) -> float:
        """Enclosed volume, m3: a sixth of the sum of a . (b x c)."""
        a, b, c = (self.points[self.triangles[:, k]] for k in range(3))
        return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def thicken(model: ExportModel) -> Solid:
    """Build the solid of a model.

    Raises `InputError` where an edge has more than two faces, or where mitres leave nothing of one.
    """
    sides = list_sides(model)
    point = _end_points(model.vertices, sides)
    _check(model, sides, point)
    number = np.arange(point[..., 0].size).reshape(point.shape[:-1])
    middle = number.size + sides.start  # a border's edges from top to bottom go through vertices
    faces = [*_sheets(number, sides), *_steps(number, sides), *_walls(number, middle, sides)]
    faces += _corners(number, middle, sides)
    return _join(np.concatenate([point.reshape(-1, 3), model.vertices]), faces, sides.panel)


def fold_tangents(vertices: np.ndarray, sides: Sides) -> np.ndarray:
    """tan(phi / 2) of the fold at every side (S,), valley positive, 0 on the border; vertices (V,
    3) m.
    """
    along = _directions(vertices, sides)
    mine, other = sides.normal, sides.normal[sides.twin]
    sine = np.einsum("hx,hx->h", np.cross(mine, other), along)
    cosine = np.einsum("hx,hx->h", mine, other)
    # seen along an edge with its face on the left, a valley turns the right one's normal to it
    return np.where(sides.twin < 0, 0.0, np.tan(np.arctan2(-sine, cosine) / 2))


def _directions(vertices: np.ndarray, sides: Sides) -> np.ndarray:
    along = vertices[sides.stop] - vertices[sides.start]
    return along / np.linalg.norm(along, axis=1, keepdims=True)


def _end_points(vertices: np.ndarray, sides: Sides) -> np.ndarray:
    """Return the ends of every side on both offset planes, (2, H, 2, 3)."""
    along, half = _directions(vertices, sides), sides.thickness / 2
    inward = np.cross(sides.normal, along)
    tangent, twin = fold_tangents(vertices, sides), sides.twin
    points = []
    for side in (1.0, -1.0):
        shift = side * half * tangent  # of the side's line into its face
        start, stop = _lengths(along, inward, shift, sides)
        start, stop = (
            np.where(twin < 0, own, (own + other[twin]) / 2)
            for own, other in ((start, stop), (stop, start))
        )
        base = shift[:, None] * inward + (side * half)[:, None] * sides.normal
        first = vertices[sides.start] + start[:, None] * along + base
        last = vertices[sides.stop] - stop[:, None] * along + base
        points.append(np.stack([first, last], axis=1))
    return np.stack(points)


def _lengths(
    along: np.ndarray, inward: np.ndarray, shift: np.ndarray, sides: Sides
) -> tuple[np.ndarray, np.ndarray]:
    """Return how much each side (H,) loses at its start and its end where it meets its face's
    sides beside it: d . inward = shift for both sides at a corner."""
    lost = []
    for other, sign in ((sides.before, 1.0), (sides.after, -1.0)):
        cosine = np.einsum("hx,hx->h", inward[other], inward)
        sine = np.einsum("hx,hx->h", inward[other], sign * along)
        straight = np.abs(sine) < 1e-9
        value = (shift[other] - cosine * shift) / np.where(straight, 1.0, sine)
        lost.append(np.where(straight, 0.0, value))
    return lost[0], lost[1]


def _check(model: ExportModel, sides: Sides, point: np.ndarray) -> None:
    """Refuse faces whose sides are used up by the mitres."""
    along = _directions(model.vertices, sides)
    left = np.einsum("shx,hx->sh", point[:, :, 1] - point[:, :, 0], along)
    bad = np.flatnonzero((left <= 0).any(axis=0))
    if len(bad):
        panel = model.panels[sides.panel[bad[0]]]
        raise InputError(
            f"{model.design}: exports: solid: panel {panel.name}: {1000 * panel.thickness:g} mm: "
            "too thick for its folds, the mitres leave nothing of an edge"
        )


def _sheets(number: np.ndarray, sides: Sides) -> list[tuple[list[int], int]]:
    """The offset faces: both ends of one side after the other, top and bottom."""
    faces = []
    for rows in np.split(np.arange(len(sides.face)), np.flatnonzero(np.diff(sides.face)) + 1):
        faces.append((number[0, rows].ravel().tolist(), int(rows[0])))
        faces.append((number[1, rows].ravel().tolist()[::-1], int(rows[0])))
    return faces


def _steps(number: np.ndarray, sides: Sides) -> list[tuple[list[int], int]]:
    """Faces in the halving planes, between neighbours of different thickness."""
    faces = []
    for side in np.flatnonzero(sides.twin > np.arange(len(sides.twin))).tolist():
        for level in (0, 1):
            (ax, ay), (by, bx) = number[level, [side, sides.twin[side]]].tolist()
            ring = [ay, ax, bx, by]
            faces.append((ring[::-1] if level else ring, side))
    return faces


def _walls(number: np.ndarray, middle: np.ndarray, sides: Sides) -> list[tuple[list[int], int]]:
    faces = []
    for side in np.flatnonzero(sides.twin < 0).tolist():
        (tx, ty), (bx, by) = number[:, side].tolist()
        vx, vy = int(middle[side]), int(middle[sides.after[side]])
        faces.append(([ty, tx, vx, bx, by, vy], side))
    return faces


def _corners(number: np.ndarray, middle: np.ndarray, sides: Sides) -> list[tuple[list[int], int]]:
    """Caps around inner vertices, top and bottom, and what closes the wall at border vertices."""
    faces, done = [], np.zeros(len(sides.start), dtype=bool)
    border = sides.twin < 0  # a fan on the border is begun with its first face
    for side in [*np.flatnonzero(border).tolist(), *np.flatnonzero(~border).tolist()]:
        if done[side]:
            continue
        fan, closed = _go_round(side, sides, done)
        top, bottom = (
            [int(n) for k in fan for n in (number[s, k, 0], number[s, sides.before[k], 1])]
            for s in (0, 1)
        )
        if closed:
            faces += [(top, side), (bottom[::-1], side)]
            continue
        hub = int(middle[side])
        for chain in (top, bottom[::-1]):
            faces += [([hub, a, b], side) for a, b in itertools.pairwise(chain)]
    return faces


def _go_round(side: int, sides: Sides, done: np.ndarray) -> tuple[list[int], bool]:
    """Return the sides that start at one vertex, counter-clockwise, and whether they close."""
    fan, first = [], side
    while True:
        fan.append(side)
        done[side] = True
        side = int(sides.twin[sides.before[side]])
        if side < 0 or side == first:
            return fan, side == first


def _join(points: np.ndarray, faces, side_panel: np.ndarray) -> Solid:
    """Merge points that coincide, and cut faces into triangles about their middle."""
    owner = _find_owners(points)
    triangles, panel, middles = [], [], []
    for ring, side in faces:
        ring = [int(owner[n]) for n in ring]
        ring = [n for k, n in enumerate(ring) if n != ring[k - 1]]
        if len(ring) < 3:
            continue
        if len(ring) > 3:
            middle = len(points) + len(middles)
            middles.append(points[ring].mean(axis=0))
            triangles += [(a, ring[k - 1], middle) for k, a in enumerate(ring)]
        else:
            triangles.append((ring[2], ring[1], ring[0]))
        panel += [int(side_panel[side])] * (len(triangles) - len(panel))
    points = np.concatenate([points, np.array(middles).reshape(-1, 3)])
    used, index = np.unique(np.array(triangles)[:, ::-1], return_inverse=True)
    return Solid(points[used], index.reshape(-1, 3), np.array(panel))


def _find_owners(points: np.ndarray) -> np.ndarray:
    """Return for each point the first one of those that coincide with it, (N,)."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    first, second = cKDTree(points).query_pairs(MERGE, output_type="ndarray").T
    graph = coo_array((np.ones(len(first)), (first, second)), shape=2 * (len(points),))
    group = connected_components(graph, directed=False)[1]
    return np.unique(group, return_index=True)[1][group]
