"""Faults of folded meshes as programs write them: mended with a sentence, or refused with one."""

from dataclasses import dataclass

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.meshes.model import Mesh, count
from foldshell.files.meshes.triangles import group_near
from foldshell.pattern.panel_graph import (
    Ragged,
    find_neighbours,
    find_sides,
    group_panels,
    join_groups,
    list_half_edges,
    make_ragged,
    orient_panels,
)

MERGED = 1e-6  # of the size: vertices that near are one
COPLANAR = np.cos(np.radians(0.5))  # triangles of one panel, where a format has triangles alone
THIN = 1e-9  # of the size squared: panels of less area are none


@dataclass(frozen=True)
class Repaired:
    """Vertices (V, 3), panels, and a sentence for each kind of fault that was mended."""

    vertices: np.ndarray
    panels: Ragged
    notes: tuple[str, ...]


def repair_panels(mesh: Mesh, triangles_only: bool = False) -> Repaired:
    """Merge, weld, remove doubles, orient; join coplanar triangles where `triangles_only`.

    Raises `InputError` without the file's name for what cannot be mended: parts that are not
    joined, a sheet with one side.
    """
    polygons = [mesh.corners[a:b] for a, b in zip(mesh.starts[:-1], mesh.starts[1:], strict=True)]
    notes: list[str] = []
    size = float(np.ptp(mesh.vertices, axis=0).max())
    # Formats of triangles alone share no vertices: there it is no fault, and not worth a word.
    vertices, rows = _merge(mesh.vertices, polygons, size, [] if triangles_only else notes)
    rows = _drop(vertices, rows, size, notes)
    rows = _weld(vertices, rows, size, notes)
    panels = _orient(vertices, make_ragged(rows), notes)
    if triangles_only:
        panels = join_coplanar(vertices, panels)
    _check_parts(vertices, panels)
    used, corners = np.unique(panels.corners, return_inverse=True)
    return Repaired(vertices[used], Ragged(panels.starts, corners.ravel()), tuple(notes))


def _merge(
    vertices: np.ndarray, polygons: list[np.ndarray], size: float, notes: list[str]
) -> tuple[np.ndarray, list[np.ndarray]]:
    used = np.unique(np.concatenate(polygons))
    label = np.arange(len(vertices))
    label[used] = used[group_near(vertices[used], MERGED * size)]
    merged = int((label[used] != used).sum())
    if merged:
        notes.append(f"{count(merged, 'vertex', 'vertices')} merged with others that near")
    if len(used) < len(vertices):
        left = len(vertices) - len(used)
        notes.append(f"{count(left, 'vertex', 'vertices')} of no panel left out")
    return vertices, [label[polygon] for polygon in polygons]


def _drop(
    vertices: np.ndarray, rows: list[np.ndarray], size: float, notes: list[str]
) -> list[np.ndarray]:
    """Leave out panels without area and those that stand twice; clean repeated corners."""
    kept, seen, flat, double = [], set(), 0, 0
    for row in rows:
        row = row[row != np.roll(row, 1)]
        points = vertices[row] - vertices[row].mean(axis=0) if len(row) > 2 else None
        area = (
            0.0
            if points is None
            else np.linalg.norm(np.cross(points, np.roll(points, -1, axis=0)).sum(axis=0)) / 2
        )
        key = tuple(sorted(row.tolist()))
        if area <= THIN * size**2:
            flat += 1
        elif key in seen:
            double += 1
        else:
            seen.add(key)
            kept.append(row)
    if flat:
        notes.append(f"{count(flat, 'panel')} without area left out")
    if double:
        notes.append(f"{count(double, 'panel')} that stood twice left out")
    if not kept:
        raise InputError("no panel with an area")
    return kept


def _weld(
    vertices: np.ndarray, rows: list[np.ndarray], size: float, notes: list[str]
) -> list[np.ndarray]:
    """Take vertices that hang on a side of a neighbour into that neighbour's polygon."""
    panels = make_ragged(rows)
    sides, _, number = find_sides(panels)
    open_sides = sides[number == 1]
    ends = np.unique(open_sides)
    welded: dict[tuple[int, int], list[tuple[float, int]]] = {}
    for a, b in open_sides.tolist():
        along = vertices[b] - vertices[a]
        share = (vertices[ends] - vertices[a]) @ along / (along @ along)
        gap = np.linalg.norm(vertices[a] + share[:, None] * along - vertices[ends], axis=1)
        inside = (share > 1e-6) & (share < 1 - 1e-6) & (gap < 2 * MERGED * size)
        inside &= ~np.isin(ends, (a, b))
        if inside.any():
            welded[a, b] = sorted(zip(share[inside].tolist(), ends[inside].tolist(), strict=True))
    if not welded:
        return rows
    hanging = {vertex for found in welded.values() for _, vertex in found}
    place = vertices[min(hanging)]
    notes.append(
        f"{count(len(hanging), 'vertex', 'vertices')} on sides of neighbours welded in, one at "
        f"{say_place(place)}"
    )
    return [_insert(row, welded) for row in rows]


def _insert(row: np.ndarray, welded: dict[tuple[int, int], list[tuple[float, int]]]) -> np.ndarray:
    found = []
    for a, b in zip(row.tolist(), np.roll(row, -1).tolist(), strict=True):
        found.append(a)
        between = [vertex for _, vertex in welded.get((min(a, b), max(a, b)), [])]
        found += between if a < b else between[::-1]
    return np.array(found)


def _orient(vertices: np.ndarray, panels: Ragged, notes: list[str]) -> Ragged:
    """Let all panels of a part have the same side up, the one that faces up on the whole."""
    turned = orient_panels(panels)
    if turned is None:
        raise InputError("the sheet has one side only (a band with a twist): two are needed")
    part = group_panels(panels)
    normal = measure_normals(vertices, panels)
    rising = np.bincount(part, np.where(turned, -1, 1) * normal[:, 2])
    over = turned ^ (rising[part] < 0)
    kept = np.minimum(np.bincount(part, over), np.bincount(part, ~over))
    if kept.sum():
        notes.append(f"{count(int(kept.sum()), 'panel')} turned over to face as their neighbours")
    return make_ragged([row[::-1] if k else row for row, k in zip(panels, over, strict=True)])


def measure_normals(vertices: np.ndarray, panels: Ragged) -> np.ndarray:
    """Area vectors (P, 3) of panels. vertices (V, 3) in one unit of length, areas in its square."""
    half, panel = list_half_edges(panels)
    middle = np.zeros((len(panels), 3))
    for axis in range(3):
        total = np.bincount(panel, vertices[half[:, 0], axis], len(panels))
        middle[:, axis] = total / np.bincount(panel, minlength=len(panels))
    arms = vertices[half] - middle[panel][:, None]
    cross = np.cross(arms[:, 0], arms[:, 1])
    return np.stack([np.bincount(panel, cross[:, k], len(panels)) / 2 for k in range(3)], axis=1)


def join_coplanar(vertices: np.ndarray, panels: Ragged) -> Ragged:
    """Join neighbouring panels in one plane, to half a degree, where one outline encloses them.

    vertices (V, 3) in one unit of length.
    """
    normal = measure_normals(vertices, panels)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    pairs, _ = find_neighbours(panels)
    level = (normal[pairs[:, 0]] * normal[pairs[:, 1]]).sum(axis=1) >= COPLANAR
    group = join_groups(len(panels), pairs[level])
    rows: list[np.ndarray] = []
    for k in range(group.max() + 1):
        members = [panels[int(m)] for m in np.flatnonzero(group == k)]
        outline = members[0] if len(members) == 1 else _outline(members)
        rows += members if outline is None else [outline]
    return make_ragged(rows)


def _outline(members: list[np.ndarray]) -> np.ndarray | None:
    """The loop around some panels; None where it is not one loop that passes a vertex once."""
    half = [(int(a), int(b)) for row in members for a, b in zip(row, np.roll(row, -1), strict=True)]
    inner = set(half)
    following = {a: b for a, b in half if (b, a) not in inner}
    edges = sum((b, a) not in inner for a, b in half)
    start = next(iter(following))
    loop, at = [start], following[start]
    while at != start and at in following and len(loop) <= edges:
        loop.append(at)
        at = following[at]
    return np.array(loop) if at == start and len(loop) == edges == len(following) else None


def _check_parts(vertices: np.ndarray, panels: Ragged) -> None:
    part = group_panels(panels)
    sizes = np.bincount(part)
    if len(sizes) > 1:
        least = int(sizes.argmin())
        row = panels[int(np.flatnonzero(part == least)[0])]
        raise InputError(
            f"a part of {count(int(sizes[least]), 'panel')} near "
            f"{say_place(vertices[row].mean(axis=0))} is not joined to the others along an edge: "
            "one sheet is needed"
        )


def say_place(point: np.ndarray) -> str:
    """Write coordinates (2,) or (3,) of a place, in their unit."""
    return ", ".join(f"{axis} = {value:.6g}" for axis, value in zip("xyz", point, strict=False))
