"""The folded sheet as a solid: every facet with its thickness, mitred at folds, closed.

Each facet is a slab between its plane's two offsets by half its thickness. At a fold it ends in the
plane that halves the angle to its neighbour; where the neighbour is thinner, a step face in that
plane closes the difference. A border ends square. Around a vertex the offset planes have in general
no common point: neighbours end at a point of their common edge half way between where each of them
would end alone, and a small cap joins these points; on the border the wall goes round them.
"""

import itertools
from dataclasses import dataclass

import numpy as np

from foldshell.exchange.model import ExportModel
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


@dataclass(frozen=True)
class _Ends:
    """Where facets end: `point` (2, F, 3, 2, 3) m of side (top, bottom), facet, edge k from corner
    k to the next, and end; `neighbour` (F, 3) across each edge, -1 on the border."""

    point: np.ndarray
    neighbour: np.ndarray
    slot: np.ndarray  # (F, 3) the edge's own number in the neighbour


def thicken(model: ExportModel) -> Solid:
    """Build the solid of a model.

    Raises `InputError` where an edge has more than two facets, or where mitres leave nothing of a
    facet.
    """
    neighbour, slot = _find_neighbours(model.facets)
    ends = _Ends(_end_points(model, neighbour, slot), neighbour, slot)
    _check(model, ends)
    number = np.arange(ends.point[..., 0].size).reshape(ends.point.shape[:-1])
    middle = number.size + model.facets  # a border's edges from top to bottom go through vertices
    faces = [*_sheets(number), *_steps(number, ends), *_walls(number, middle, ends)]
    faces += _corners(number, middle, ends)
    points = np.concatenate([ends.point.reshape(-1, 3), model.vertices])
    return _join(points, faces, model.facet_panel)


def _find_neighbours(facets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    count = int(facets.max()) + 1
    ends = facets[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    keys, back = ends @ [count, 1], ends @ [1, count]
    order = np.argsort(keys)
    twin = np.diff(keys[order]) == 0
    if twin.any():
        first, second = ends[order[np.flatnonzero(twin)[0]]]
        raise InputError(
            f"exports: solid: the edge between vertices {first} and {second} has more than two "
            "facets, or facets turned over: each edge of a solid joins two"
        )
    place = np.minimum(np.searchsorted(keys[order], back), len(keys) - 1)
    found = np.where(keys[order][place] == back, order[place], -1)
    facet, slot = np.divmod(found, 3)
    return np.where(found < 0, -1, facet).reshape(-1, 3), slot.reshape(-1, 3)


def fold_tangents(model: ExportModel, neighbour: np.ndarray) -> np.ndarray:
    """tan(phi / 2) of the fold at every edge of every facet, valley positive, 0 on the border."""
    corner = model.vertices[model.facets]
    along = np.roll(corner, -1, axis=1) - corner
    along /= np.linalg.norm(along, axis=2, keepdims=True)
    mine, other = model.normals[:, None], model.normals[neighbour]
    sine = np.einsum("fkx,fkx->fk", np.cross(mine, other), along)
    cosine = np.einsum("fkx,fkx->fk", np.broadcast_to(mine, other.shape), other)
    # seen along an edge with its facet on the left, a valley turns the right one's normal to it
    return np.where(neighbour < 0, 0.0, np.tan(np.arctan2(-sine, cosine) / 2))


def _end_points(model: ExportModel, neighbour: np.ndarray, slot: np.ndarray) -> np.ndarray:
    """Return the ends of every facet's edges on both offset planes, (2, F, 3, 2, 3)."""
    corner = model.vertices[model.facets]
    along = np.roll(corner, -1, axis=1) - corner
    along /= np.linalg.norm(along, axis=2, keepdims=True)
    inward = np.cross(model.normals[:, None], along)
    half = model.thickness[:, None] / 2
    tangent = fold_tangents(model, neighbour)
    points = []
    for side in (1.0, -1.0):
        shift = side * half * tangent  # of the edge's line into the facet
        start, stop = _lengths(along, inward, shift)
        start, stop = (
            np.where(neighbour < 0, own, (own + other[neighbour, slot]) / 2)
            for own, other in ((start, stop), (stop, start))
        )
        base = shift[..., None] * inward + (side * half)[..., None] * model.normals[:, None]
        first = corner + start[..., None] * along + base
        last = np.roll(corner, -1, axis=1) - stop[..., None] * along + base
        points.append(np.stack([first, last], axis=2))
    return np.stack(points)


def _lengths(
    along: np.ndarray, inward: np.ndarray, shift: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return how much each edge (F, 3) loses at its start and its end where it meets its facet's
    other two: d . inward = shift for both edges at a corner."""
    before = np.roll(np.arange(3), 1)
    cosine = np.einsum("fkx,fkx->fk", inward[:, before], inward)
    sine = np.einsum("fkx,fkx->fk", inward[:, before], along)
    start = (shift[:, before] - cosine * shift) / sine
    back = np.einsum("fkx,fkx->fk", inward, -along[:, before])
    stop = (shift - cosine * shift[:, before]) / back
    return start, np.roll(stop, -1, axis=1)


def _check(model: ExportModel, ends: _Ends) -> None:
    """Refuse facets whose edges are used up by the mitres."""
    corner = model.vertices[model.facets]
    along = np.roll(corner, -1, axis=1) - corner
    left = np.einsum("sfkx,fkx->sfk", ends.point[..., 1, :] - ends.point[..., 0, :], along)
    bad = np.flatnonzero((left <= 0).any(axis=(0, 2)))
    if len(bad):
        panel = model.panels[model.facet_panel[bad[0]]]
        raise InputError(
            f"{model.design}: exports: solid: panel {panel.name}: {1000 * panel.thickness:g} mm: "
            "too thick for its folds, the mitres leave nothing of an edge"
        )


def _sheets(number: np.ndarray) -> list[tuple[list[int], int]]:
    top, bottom = number.reshape(2, number.shape[1], 6).tolist()
    faces = [(ring, facet) for facet, ring in enumerate(top)]
    return faces + [(ring[::-1], facet) for facet, ring in enumerate(bottom)]


def _steps(number: np.ndarray, ends: _Ends) -> list[tuple[list[int], int]]:
    faces = []
    for facet, edge in np.argwhere(ends.neighbour >= 0).tolist():
        other, own = int(ends.neighbour[facet, edge]), int(ends.slot[facet, edge])
        if facet > other:
            continue
        for side in (0, 1):
            (ax, ay), (by, bx) = number[side, facet, edge], number[side, other, own]
            ring = [int(ay), int(ax), int(bx), int(by)]
            faces.append((ring[::-1] if side else ring, facet))
    return faces


def _walls(number: np.ndarray, middle: np.ndarray, ends: _Ends) -> list[tuple[list[int], int]]:
    faces = []
    for facet, edge in np.argwhere(ends.neighbour < 0).tolist():
        (tx, ty), (bx, by) = number[:, facet, edge].tolist()
        vx, vy = int(middle[facet, edge]), int(middle[facet, (edge + 1) % 3])
        faces.append(([ty, tx, vx, bx, by, vy], facet))
    return faces


def _corners(number: np.ndarray, middle: np.ndarray, ends: _Ends) -> list[tuple[list[int], int]]:
    """Caps around inner vertices, top and bottom, and what closes the wall at border vertices."""
    faces, done = [], np.zeros(middle.shape, dtype=bool)
    starts = np.argwhere(ends.neighbour < 0).tolist() + np.argwhere(ends.neighbour >= 0).tolist()
    for facet, corner in starts:  # an edge k starts at corner k: border fans from their first facet
        if done[facet, corner]:
            continue
        fan, closed = _go_round(facet, corner, ends, done)
        top, bottom = (
            [int(n) for f, c in fan for n in (number[s, f, c, 0], number[s, f, (c + 2) % 3, 1])]
            for s in (0, 1)
        )
        if closed:
            faces += [(top, facet), (bottom[::-1], facet)]
            continue
        hub = int(middle[facet, corner])
        for chain in (top, bottom[::-1]):
            faces += [([hub, a, b], facet) for a, b in itertools.pairwise(chain)]
    return faces


def _go_round(facet: int, corner: int, ends: _Ends, done: np.ndarray):
    """Return the fan of (facet, corner) counter-clockwise from one of them, and if it closes."""
    fan, first = [], (facet, corner)
    while True:
        fan.append((facet, corner))
        done[facet, corner] = True
        into = (corner + 2) % 3  # the edge that ends at this corner
        facet, corner = int(ends.neighbour[facet, into]), int(ends.slot[facet, into])
        if facet < 0:
            return fan, False
        if (facet, corner) == first:
            return fan, True


def _join(points: np.ndarray, faces, facet_panel: np.ndarray) -> Solid:
    """Merge points that coincide, and cut faces into triangles about their middle."""
    owner = _find_owners(points)
    triangles, panel, middles = [], [], []
    for ring, facet in faces:
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
        panel += [int(facet_panel[facet])] * (len(triangles) - len(panel))
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
