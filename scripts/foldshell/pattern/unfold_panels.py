"""Unfold planar panels of any number of corners into the plane, and fold them again by hinges.

Panels are laid one after the other across their sides, from the middle of the sheet outwards; how
far apart the copies of a vertex then lie is the closure, 0 for a developable sheet.
"""

from collections import deque

import numpy as np

from foldshell.pattern.panel_graph import Ragged, find_sides
from foldshell.pattern.panel_repair import measure_normals
from foldshell.pattern.unfold import Assembly, rotate_about


def order_panels(panels: Ragged, first: int) -> list[tuple[int, int, int, int]]:
    """Return (panel, neighbour laid before, a, b) over the tree of shared sides, breadth first.

    The panel runs along its side from a to b, the neighbour from b to a. All are numbers.
    """
    sides, place, number = find_sides(panels)
    beside: dict[int, list[int]] = {}
    panel = np.repeat(np.arange(len(panels)), np.diff(panels.starts))
    for side, owner in zip(place.tolist(), panel.tolist(), strict=True):
        if number[side] == 2:
            beside.setdefault(side, []).append(owner)
    own = np.split(place, panels.starts[1:-1])
    seen, steps, queue = {first}, [], deque([first])
    while queue:
        at = queue.popleft()
        for side in own[at].tolist():
            for other in beside.get(side, ()):
                if other not in seen:
                    seen.add(other)
                    row = panels[other].tolist()
                    a, b = sides[side].tolist()
                    if row[(row.index(a) + 1) % len(row)] != b:
                        a, b = b, a
                    steps.append((other, at, a, b))
                    queue.append(other)
    return steps


def find_middle_panel(vertices: np.ndarray, panels: Ragged) -> int:
    """Return the panel whose corners lie nearest to the middle of vertices (V, 3) m."""
    total = np.add.reduceat(vertices[panels.corners], panels.starts[:-1], axis=0)
    middle = total / np.diff(panels.starts)[:, None]
    return int(np.linalg.norm(middle - middle.mean(axis=0), axis=1).argmin())


def unfold_net(vertices: np.ndarray, panels: Ragged, like: np.ndarray) -> Assembly:
    """Lay every panel, congruent to the folded one, in the plane z = 0, turned as `like` lies.

    vertices (V, 3) m, like (V, 3) m another flat state of the same panels.
    """
    local = lay_panels(vertices, panels)
    values = np.split(local, panels.starts[1:-1])
    rows = zip(panels, values, strict=True)
    place = [dict(zip(row.tolist(), there, strict=True)) for row, there in rows]
    placed = np.empty(len(panels.corners), dtype=complex)
    first = find_middle_panel(vertices, panels)
    laid = {first: place[first]}
    for panel, before, a, b in order_panels(panels, first):
        own, other = place[panel], laid[before]
        turn = (other[b] - other[a]) / (own[b] - own[a])
        turn /= abs(turn)
        shift = (other[a] + other[b]) / 2 - turn * (own[a] + own[b]) / 2
        laid[panel] = {vertex: turn * value + shift for vertex, value in own.items()}
    for panel, values in laid.items():
        start = panels.starts[panel]
        placed[start : start + len(values)] = [values[v] for v in panels[panel].tolist()]
    copies = np.stack([placed.real, placed.imag, 0 * placed.real], axis=1)
    flat = gather_copies(copies, panels, len(vertices))
    return Assembly(_turn_alike(flat.vertices, like), flat.closure)


def lay_panels(vertices: np.ndarray, panels: Ragged) -> np.ndarray:
    """Complex coordinates (C,) of all corners in the planes of their panels, seen from above.

    vertices (V, 3) m.
    """
    size = np.diff(panels.starts)
    normal = measure_normals(vertices, panels)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    start = vertices[panels.corners[panels.starts[:-1]]]
    first = vertices[panels.corners[panels.starts[:-1] + 1]] - start
    first -= np.einsum("ij,ij->i", first, normal)[:, None] * normal
    first /= np.linalg.norm(first, axis=1)[:, None]
    second = np.cross(normal, first)
    arms = vertices[panels.corners] - np.repeat(start, size, axis=0)
    x = np.einsum("ij,ij->i", arms, np.repeat(first, size, axis=0))
    return x + 1j * np.einsum("ij,ij->i", arms, np.repeat(second, size, axis=0))


def gather_copies(copies: np.ndarray, panels: Ragged, count: int) -> Assembly:
    """Average the copies (C, 3) m of each vertex in all panels, and measure how far apart they lie.

    Vertices of no panel stay at 0.
    """
    number = np.maximum(np.bincount(panels.corners, minlength=count), 1)
    total = [np.bincount(panels.corners, copies[:, k], count) for k in range(3)]
    mean = np.stack(total, axis=1) / number[:, None]
    gap = np.linalg.norm(copies - mean[panels.corners], axis=1).max()
    return Assembly(mean, 2 * float(gap))


def _turn_alike(flat: np.ndarray, like: np.ndarray) -> np.ndarray:
    """Turn a flat state about z to the least squares from another one, its low corner at 0."""
    one, two = (state[:, 0] + 1j * state[:, 1] for state in (flat, like))
    turn = np.vdot(one - one.mean(), two - two.mean())
    turned = one * (turn / abs(turn) if abs(turn) > 0 else 1.0)
    points = np.stack([turned.real, turned.imag, flat[:, 2]], axis=1)
    return points - points.min(axis=0)


def fold_net(flat: np.ndarray, panels: Ragged, folds: dict[tuple[int, int], float]) -> Assembly:
    """Fold a flat sheet (V, 3) m by hinge rotations, valley positive, over the tree of sides.

    `folds` [rad] of each side by its vertices, the lower one first.
    """
    first = find_middle_panel(flat, panels)
    turns, shifts = {first: np.eye(3)}, {first: np.zeros(3)}
    for panel, before, a, b in order_panels(panels, first):
        axis = flat[b] - flat[a]
        angle = folds.get((min(a, b), max(a, b)), 0.0)
        local = rotate_about(axis / np.linalg.norm(axis), np.asarray(angle))
        turns[panel] = turns[before] @ local
        shifts[panel] = turns[before] @ (flat[a] - local @ flat[a]) + shifts[before]
    size = np.diff(panels.starts)
    turn = np.repeat(np.array([turns[k] for k in range(len(panels))]), size, axis=0)
    shift = np.repeat(np.array([shifts[k] for k in range(len(panels))]), size, axis=0)
    copies = np.einsum("nij,nj->ni", turn, flat[panels.corners]) + shift
    return gather_copies(copies, panels, len(flat))


def overlaps_itself(flat: np.ndarray, facets: np.ndarray, border: np.ndarray) -> bool:
    """Tell whether a flat sheet (V, 3) m overlaps: a facet turned over, or its border crossing.

    facets (F, 3), border (K,) in turn.
    """
    one, two = (flat[facets[:, k], :2] - flat[facets[:, 0], :2] for k in (1, 2))
    if (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0] <= 0).any():
        return True
    start, end = flat[border, :2], flat[np.roll(border, -1), :2]

    def side(p: np.ndarray, q: np.ndarray, r: np.ndarray) -> np.ndarray:
        """Return twice the areas (...) of triangles of points (..., 2)."""
        u, v = q - p, r - p
        return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]

    s, e = start[:, None], end[:, None]
    crosses = side(s, e, start) * side(s, e, end) < 0
    return bool((crosses & (side(start, end, s) * side(start, end, e) < 0)).any())
