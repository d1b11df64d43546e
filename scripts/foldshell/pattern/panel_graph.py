"""The graph of panels: sides, parts, borders, orientation, and faces of a net of lines."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Ragged:
    """Rows of different lengths: row k is `corners[starts[k]:starts[k + 1]]`."""

    starts: np.ndarray
    corners: np.ndarray

    def __len__(self) -> int:
        return len(self.starts) - 1

    def __iter__(self) -> Iterator[np.ndarray]:
        for k in range(len(self)):
            yield self.corners[self.starts[k] : self.starts[k + 1]]

    def __getitem__(self, k: int) -> np.ndarray:
        if not 0 <= k < len(self):
            raise IndexError(k)
        return self.corners[self.starts[k] : self.starts[k + 1]]


def make_ragged(rows: Sequence[Sequence[int] | np.ndarray]) -> Ragged:
    """Build rows (k,) of vertex numbers, of any length."""
    sizes = [len(row) for row in rows]
    starts = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)
    flat = [np.asarray(row, dtype=np.int64) for row in rows]
    return Ragged(starts, np.concatenate(flat) if flat else np.empty(0, dtype=np.int64))


def list_half_edges(panels: Ragged) -> tuple[np.ndarray, np.ndarray]:
    """Sides (H, 2) of all panels in their own direction, and the panel (H,) of each.

    All are numbers.
    """
    sizes = np.diff(panels.starts)
    panel = np.repeat(np.arange(len(panels)), sizes)
    following = np.arange(1, len(panels.corners) + 1)
    following[panels.starts[1:] - 1] = panels.starts[:-1]
    return np.column_stack([panels.corners, panels.corners[following]]), panel


def find_sides(panels: Ragged) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Distinct sides (S, 2), the side (H,) of each half-edge, the number of panels (S,) there."""
    half, _ = list_half_edges(panels)
    sides, place, number = np.unique(
        np.sort(half, axis=1), axis=0, return_inverse=True, return_counts=True
    )
    return sides, place.ravel(), number


def find_neighbours(panels: Ragged) -> tuple[np.ndarray, np.ndarray]:
    """Pairs (N, 2) of panels that share a side between two, and whether they run along it alike.

    Panels that run along their side in opposite directions have the same side up.
    """
    half, panel = list_half_edges(panels)
    _, place, number = find_sides(panels)
    order = np.argsort(place, kind="stable")
    first = np.concatenate([[0], np.cumsum(number)[:-1]])[number == 2]
    one, two = order[first], order[first + 1]
    return np.column_stack([panel[one], panel[two]]), half[one, 0] == half[two, 0]


def group_panels(panels: Ragged) -> np.ndarray:
    """Number of the part (P,) of each panel: parts are joined over sides, of any number."""
    _, panel = list_half_edges(panels)
    _, place, number = find_sides(panels)
    order = np.argsort(place, kind="stable")
    first = np.repeat(np.concatenate([[0], np.cumsum(number)[:-1]]), number)
    pairs = np.column_stack([panel[order], panel[order[first]]])
    return join_groups(len(panels), pairs)


def join_groups(count: int, pairs: np.ndarray) -> np.ndarray:
    """Number of the group (count,) of each thing, where pairs (N, 2) belong together."""
    label = np.arange(count)
    while True:
        least = np.minimum(label[pairs[:, 0]], label[pairs[:, 1]])
        new = label.copy()
        for k in (0, 1):
            np.minimum.at(new, pairs[:, k], least)
        new = new[new]
        if np.array_equal(new, label):
            return np.unique(label, return_inverse=True)[1].ravel()
        label = new


def orient_panels(panels: Ragged) -> np.ndarray | None:
    """Which panels (P,) to turn over so that neighbours run against each other at their side.

    The first panel of each part stays. None where no such choice exists (a band with a twist).

    It is bool.
    """
    pairs, alike = find_neighbours(panels)
    beside: list[list[tuple[int, bool]]] = [[] for _ in range(len(panels))]
    for (one, two), same in zip(pairs.tolist(), alike.tolist(), strict=True):
        beside[one].append((two, same))
        beside[two].append((one, same))
    turned = np.full(len(panels), -1)
    for start in range(len(panels)):
        if turned[start] >= 0:
            continue
        turned[start], queue = 0, [start]
        while queue:
            panel = queue.pop()
            for other, same in beside[panel]:
                due = turned[panel] ^ int(same)
                if turned[other] < 0:
                    turned[other] = due
                    queue.append(other)
                elif turned[other] != due:
                    return None
    return turned.astype(bool)


def trace_borders(panels: Ragged) -> list[np.ndarray]:
    """Loops (k,) of vertex numbers along sides of one panel, in the panels' own direction."""
    half, _ = list_half_edges(panels)
    _, place, number = find_sides(panels)
    following: dict[int, list[int]] = {}
    for start, end in half[number[place] == 1].tolist():
        following.setdefault(start, []).append(end)
    loops = []
    while following:
        start = next(iter(following))
        loop, at = [start], start
        while True:
            ends = following.get(at)
            if not ends:
                break
            at_next = ends.pop()
            if not ends:
                del following[at]
            at = at_next
            if at == start:
                break
            loop.append(at)
        loops.append(np.array(loop))
    return loops


def walk_faces(points: np.ndarray, edges: np.ndarray) -> list[list[int]]:
    """Faces of a planar net, counter-clockwise, the outer ones left out.

    points (V, 2), edges (E, 2) that meet at vertices alone. From each half-edge the walk turns
    as far to the left as it can.

    Points in one unit of length; faces are vertex numbers.
    """
    half = np.vstack([edges, edges[:, ::-1]])
    along = points[half[:, 1]] - points[half[:, 0]]
    angle = np.arctan2(along[:, 1], along[:, 0])
    order = np.lexsort((angle, half[:, 0]))
    first = np.searchsorted(half[order, 0], np.arange(len(points) + 1))
    place = np.empty(len(half), dtype=np.int64)
    place[order] = np.arange(len(half))
    back = np.concatenate([np.arange(len(edges)) + len(edges), np.arange(len(edges))])
    at = place[back]  # of the way back, among the half-edges from the end, by angle
    start = first[half[:, 1]]
    count = first[half[:, 1] + 1] - start
    following = order[start + (at - start - 1) % count]
    faces, seen = [], np.zeros(len(half), dtype=bool)
    for begin in range(len(half)):
        face, k = [], begin
        while not seen[k]:
            seen[k] = True
            face.append(int(half[k, 0]))
            k = int(following[k])
        if face and measure_area(points[face]) > 0:
            faces.append(face)
    return faces


def measure_area(points: np.ndarray) -> float:
    """Signed area of a polygon (k, 2), counter-clockwise positive.

    In the square of the points' unit.
    """
    x, y = points.T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)


def join_polygons(polygons: Ragged, chosen: np.ndarray) -> list[list[int]]:
    """Return the border loops of some polygons (k,) of a cut sheet, as vertex numbers."""
    following: dict[int, list[int]] = {}
    sides = set()
    for k in chosen.tolist():
        ring = polygons[k].tolist()
        sides |= set(zip(ring, [*ring[1:], ring[0]], strict=True))
    for start, end in sorted(sides):
        if (end, start) not in sides:
            following.setdefault(start, []).append(end)
    loops = []
    while following:
        at = start = min(following)
        loop = []
        while at in following:
            loop.append(at)
            ends = following[at]
            at = ends.pop()
            if not ends:
                del following[loop[-1]]
            if at == start:
                break
        loops.append(loop)
    return loops
