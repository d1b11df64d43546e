"""Triangles of a polygon mesh: vertices merged, polygons split, what has no area left out."""

from dataclasses import dataclass

import numpy as np

from foldshell.files.meshes.model import Mesh, MeshError, count

NEAR = 1e-6  # of the mesh's size: border vertices that lie so near are one
EVEN = 1e-5  # lengths and hands that differ by less are alike: single precision holds 1e-7
ASKEW = np.array([0.8017, 0.5345, 0.2673])  # a direction that no panel has an axis along
POWER = 24  # of angles: the largest one decides
MOST_CORNERS = 60  # of a polygon that is cut the best way
FLAT = 1e-14  # of the largest area: triangles below it are no triangles


@dataclass(frozen=True)
class Triangles:
    """Vertices (V, 3), all of them used, triangles (F, 3), and what was left out."""

    vertices: np.ndarray
    triangles: np.ndarray
    notes: tuple[str, ...] = ()


def make_triangles(mesh: Mesh) -> Triangles:
    """Merge equal vertices and split polygons into triangles.

    Polygons are split along diagonals inside them; triangles without area and those that stand
    twice are left out, with a note. Raises `MeshError` where none remains.
    """
    vertices, place = _merge_equal(mesh.vertices)
    triangles, _ = split_polygons(vertices, mesh.starts, place[mesh.corners])
    triangles = _merge_near(vertices, triangles)
    area = measure_double_areas(vertices, triangles)
    flat = ~(area > FLAT * area.max(initial=0.0))
    notes = [f"{count(int(flat.sum()), 'triangle')} without area left out"] if flat.any() else []
    triangles = triangles[~flat]
    if not len(triangles):
        raise MeshError("0 triangles with an area: a mesh of faces is needed")
    _, first = np.unique(np.sort(triangles, axis=1), axis=0, return_index=True)
    if len(first) < len(triangles):
        more = len(triangles) - len(first)
        notes.append(f"{count(more, 'triangle')} that stood twice left out")
        triangles = triangles[np.sort(first)]
    used, triangles = np.unique(triangles, return_inverse=True)
    return Triangles(vertices[used], triangles.reshape(-1, 3), (*mesh.notes, *notes))


def measure_double_areas(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """|e1 x e2|: twice the areas (F,) of triangles (F, 3).

    Coordinates in one unit of length, areas in its square.
    """
    corners = vertices[triangles]
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return np.linalg.norm(np.cross(one, two), axis=1)


def find_border(triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Edges (E, 2) of triangles (F, 3) and the number of triangles (E,) at each."""
    sides = triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    edges = np.sort(sides.astype(np.int64), axis=1)
    size = max(int(edges.max(initial=0)) + 1, 1)
    keys, number = np.unique(edges[:, 0] * size + edges[:, 1], return_counts=True)
    return np.column_stack(np.divmod(keys, size)), number


def _merge_equal(vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distinct vertices in the order of the file, and the row of each vertex among them."""
    order = np.lexsort((vertices + 0.0).T)
    ordered = vertices[order]
    new = np.ones(len(order), dtype=bool)
    new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    group = np.empty(len(order), dtype=np.int64)
    group[order] = np.cumsum(new) - 1
    first = np.full(int(new.sum()), len(order), dtype=np.int64)
    np.minimum.at(first, group, np.arange(len(order)))
    rank = np.argsort(np.argsort(first))
    return vertices[np.sort(first)], rank[group]


def split_polygons(
    vertices: np.ndarray, starts: np.ndarray, corners: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Triangles (F, 3) of all polygons in their order, and the polygon (F,) of each.

    Those of triangles and quadrilaterals at once. Triangles with a corner
    twice are left out.

    vertices (V, 3) in one unit of length.
    """
    sizes, first = np.diff(starts), starts[:-1]
    parts = [corners[first[sizes == 3][:, None] + np.arange(3)]]
    parts.append(_split_quads(vertices, corners[first[sizes == 4][:, None] + np.arange(4)]))
    kinds = [np.flatnonzero(sizes == 3), np.repeat(np.flatnonzero(sizes == 4), 2)]
    for k in np.flatnonzero(sizes > 4):
        parts.append(cut_polygon(vertices, corners[starts[k] : starts[k + 1]]))
        kinds.append(np.full(len(parts[-1]), k))
    polygon = np.concatenate(kinds)
    order = np.argsort(polygon, kind="stable")
    triangles, polygon = np.concatenate(parts)[order], polygon[order]
    distinct = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
    return triangles[distinct], polygon[distinct]


def _split_quads(vertices: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """Split quadrilaterals (Q, 4) along the shorter diagonal that lies inside: (2Q, 3)."""
    a, b, c, d = (vertices[quads[:, k]] for k in range(4))
    normal = np.cross(c - a, d - b)

    def least_turn(p: np.ndarray, q: np.ndarray, r: np.ndarray, s: np.ndarray) -> np.ndarray:
        """The smaller of the areas of p q r and p r s, seen along the normal."""
        one, two = np.cross(q - p, r - p), np.cross(r - p, s - p)
        return np.minimum((one * normal).sum(axis=1), (two * normal).sum(axis=1))

    along_ac, along_bd = least_turn(a, b, c, d), least_turn(b, c, d, a)
    one, two = np.linalg.norm(c - a, axis=1), np.linalg.norm(d - b, axis=1)
    even = np.abs(one - two) <= EVEN * (one + two)
    hands = _measure_hand(a, b, c) - _measure_hand(b, c, d)
    places = ((c - a) @ ASKEW) ** 2 - ((d - b) @ ASKEW) ** 2
    first_hand = np.where(np.abs(hands) > EVEN, hands > 0, places > 0)
    shorter = np.where(even, first_hand, one < two)
    use_ac = np.where((along_ac > 0) == (along_bd > 0), shorter, along_ac > 0)[:, None]
    first = np.where(use_ac, quads[:, [0, 1, 2]], quads[:, [0, 1, 3]])
    second = np.where(use_ac, quads[:, [0, 2, 3]], quads[:, [1, 2, 3]])
    return np.stack([first, second], axis=1).reshape(-1, 3)


def _measure_hand(p: np.ndarray, q: np.ndarray, r: np.ndarray) -> np.ndarray:
    """(l1 - l2)(l2 - l3)(l3 - l1) / (l1 + l2 + l3)^3 (...) of triangles of corners (..., 3).

    A mirror turns its sign, nothing else changes it: of two ways to cut a panel that are as good
    as each other it tells one, however corners are numbered and wherever the panel stands.
    """
    one, two, three = (np.linalg.norm(e - s, axis=-1) for s, e in ((p, q), (q, r), (r, p)))
    whole = one + two + three
    return (one - two) * (two - three) * (three - one) / np.where(whole > 0, whole, 1) ** 3


def cut_polygon(vertices: np.ndarray, polygon: np.ndarray) -> np.ndarray:
    """Triangles (k - 2, 3) of one polygon (k,) in its mean plane.

    Of all ways to cut it along diagonals inside, the one with the least sum of large powers of the
    triangles' largest angles, found by dynamic programming over the polygon's chains; large
    polygons are cut ear by ear. Of ways as good as each other always the same is taken.

    vertices (V, 3) in one unit of length.
    """
    plane = _lay_in_plane(vertices[polygon])
    if len(polygon) > MOST_CORNERS:
        return polygon[_cut_ears(plane)]
    badness = _judge_triangles(plane, vertices[polygon])
    size = len(polygon)
    cost = np.zeros((size, size))
    choice = np.zeros((size, size), dtype=int)
    for width in range(2, size):
        for i in range(size - width):
            j = i + width
            between = np.arange(i + 1, j)
            total = cost[i, between] + cost[between, j] + badness[i, between, j]
            best = int(total.argmin())
            cost[i, j], choice[i, j] = total[best], between[best]
    if not np.isfinite(cost[0, -1]):
        return polygon[_cut_ears(plane)]
    triangles, open_chains = [], [(0, size - 1)]
    while open_chains:
        i, j = open_chains.pop()
        if j - i > 1:
            m = int(choice[i, j])
            triangles.append([i, m, j])
            open_chains += [(i, m), (m, j)]
    return polygon[np.array(triangles)]


def _judge_triangles(plane: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Badness (k, k, k) of the triangles i < m < j of a polygon, infinite where they turn back.

    Slightly more for triangles of one hand, and by their place, so that no two ways tie.
    """
    hand = _measure_hand(corners[:, None, None], corners[None, :, None], corners[None, None, :])
    askew = (corners - corners.mean(axis=0)) @ ASKEW
    place = askew[:, None, None] + askew[None, :, None] + askew[None, None, :]
    slight = 1 + hand + 1e-4 * place / (np.abs(askew).max() or 1.0)
    angle = _largest_angles(plane)
    return np.where(np.isfinite(angle), (angle / np.pi) ** POWER * slight, np.inf)


def _lay_in_plane(corners: np.ndarray) -> np.ndarray:
    """Corners (k, 2) of a polygon (k, 3) in its mean plane, counter-clockwise there."""
    points = corners - corners.mean(axis=0)
    normal = np.cross(points, np.roll(points, -1, axis=0)).sum(axis=0)
    axis = np.eye(3)[int(np.abs(normal).argmin())]
    first = np.cross(axis, normal)
    second = np.cross(normal, first)
    first /= np.linalg.norm(first) or 1.0
    second /= np.linalg.norm(second) or 1.0
    return points @ np.stack([first, second], axis=1)


def _largest_angles(plane: np.ndarray) -> np.ndarray:
    """Largest angle (k, k, k) [rad] of the triangles i < m < j, infinite where they turn back."""
    a, b, c = plane[:, None, None], plane[None, :, None], plane[None, None, :]

    def angle(p: np.ndarray, q: np.ndarray, r: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the angles (...) at p in rad and twice the areas (...), of corners (..., 2)."""
        one, two = q - p, r - p
        turn = one[..., 0] * two[..., 1] - one[..., 1] * two[..., 0]
        return np.arctan2(turn, (one * two).sum(axis=-1)), turn

    angles = [angle(a, b, c), angle(b, c, a), angle(c, a, b)]
    largest = np.max([value for value, _ in angles], axis=0)
    least = 1e-12 * np.ptp(plane, axis=0).max() ** 2
    return np.where(angles[0][1] > least, largest, np.inf)


def _cut_ears(plane: np.ndarray) -> np.ndarray:
    """Triangles (k - 2, 3) of a polygon (k, 2): ears cut off, the best first."""
    left, triangles = list(range(len(plane))), []
    while len(left) > 3:
        ear = max(range(len(left)), key=lambda k: _judge_ear(plane, left, k))
        triangles.append([left[ear - 1], left[ear], left[(ear + 1) % len(left)]])
        del left[ear]
    return np.array([*triangles, left])


def _judge_ear(plane: np.ndarray, left: list[int], k: int) -> float:
    """Shape of the ear at place k, larger for a better one, below 0 for none."""
    p, q, r = plane[left[k - 1]], plane[left[k]], plane[left[(k + 1) % len(left)]]

    def turn(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
        """Return twice the signed areas (...) of triangles a (2,), b (2,), c (..., 2), m2."""
        return (b[0] - a[0]) * (c[..., 1] - a[1]) - (b[1] - a[1]) * (c[..., 0] - a[0])

    area = float(turn(p, q, r))
    sides = float(((q - p) ** 2).sum() + ((r - q) ** 2).sum() + ((p - r) ** 2).sum())
    others = [i for i in left if i not in (left[k - 1], left[k], left[(k + 1) % len(left)])]
    rest = plane[others]
    inside = (turn(p, q, rest) > 0) & (turn(q, r, rest) > 0) & (turn(r, p, rest) > 0)
    return -1.0 if area <= 0 or inside.any() or sides == 0 else area / sides


def _merge_near(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Let border vertices nearer than NEAR of the size be one: rows of the first of each group."""
    edges, number = find_border(triangles) if len(triangles) else (triangles, triangles)
    border = np.unique(edges[number == 1]) if len(triangles) else np.empty(0, dtype=np.int64)
    if not len(border):
        return triangles
    size = np.ptp(vertices[np.unique(triangles)], axis=0).max()
    label = group_near(vertices[border], NEAR * size)
    row = np.arange(len(vertices))
    row[border] = border[label]
    merged = row[triangles]
    return merged[(merged != np.roll(merged, 1, axis=1)).all(axis=1)]


def group_near(points: np.ndarray, distance: float) -> np.ndarray:
    """Row (N,) of the first of all points (N, 3) within about `distance` of each other.

    Points that near share a cell of one of eight grids, shifted by half a cell along the axes.
    """
    place, cell = points - points.min(axis=0), 2 * distance or 1.0
    label = np.arange(len(points))
    for shift in np.ndindex(2, 2, 2):
        key = np.floor(place / cell + 0.5 * np.array(shift)).astype(np.int64)
        _, inverse = np.unique(key, axis=0, return_inverse=True)
        least = np.full(len(points), len(points))
        np.minimum.at(least, inverse.ravel(), label)
        label = least[inverse.ravel()]
    return label
