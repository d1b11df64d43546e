"""From drawn lines to a flat crease pattern: crossings, shared ends, panels."""

from dataclasses import dataclass

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.meshes.model import count
from foldshell.files.meshes.triangles import group_near
from foldshell.pattern.panel_graph import find_sides, join_groups, make_ragged, walk_faces
from foldshell.pattern.panel_mesh import PanelMesh
from foldshell.pattern.panel_repair import say_place

NEAR = 1e-5  # of the drawing's size: ends that near are one
MOST_LINES = 20_000


@dataclass(frozen=True)
class Lines:
    """Straight lines (N, 2, 2) of a drawing in its unit, y up, and the letter (N,) of each.

    `unit` is the one that the file declares, `notes` what was passed over.
    """

    segments: np.ndarray
    letters: np.ndarray
    unit: str | None = None
    notes: tuple[str, ...] = ()


def build_pattern(lines: Lines, unit: float) -> PanelMesh:
    """Build the flat pattern of drawn lines; coordinates in m as they stand.

    Lines are cut where they cross; ends that nearly meet are one; lines drawn twice count once.
    Raises `InputError` without the file's name for creases that end inside, contradict each
    other, or are not joined, and for border lines inside.
    """
    if not len(lines.segments):
        raise InputError("holds no line of a crease pattern")
    if len(lines.segments) > MOST_LINES:
        raise InputError(f"{len(lines.segments)} lines: at most {MOST_LINES} are allowed")
    low = lines.segments.min(axis=(0, 1))
    size = float(np.ptp(lines.segments.reshape(-1, 2), axis=0).max())
    if not size > 0:
        raise InputError("all its lines are points")
    notes = list(lines.notes)
    ends, letters = _cut_at_crossings(lines.segments - low, lines.letters, NEAR * size)
    points, edges, letters = _share_ends(ends, letters, NEAR * size, low)
    _check_ends(points + low, edges)
    panels = make_ragged(walk_faces(points, edges))
    letters = _settle_border(points + low, edges, letters, panels, notes)
    flat = unit * np.column_stack([points + low, np.zeros(len(points))])
    return PanelMesh(
        panels, edges, letters, np.full(len(edges), np.nan), flat=flat, notes=tuple(notes)
    )


def _cut_at_crossings(
    segments: np.ndarray, letters: np.ndarray, near: float
) -> tuple[np.ndarray, np.ndarray]:
    """Segments (M, 2, 2) that meet at their ends alone, and their letters (M,)."""
    start, along = segments[:, 0], segments[:, 1] - segments[:, 0]
    length = np.linalg.norm(along, axis=1)
    keep = length > near
    start, along, length, letters = start[keep], along[keep], length[keep], letters[keep]
    pieces, kinds = [], []
    low, high = np.minimum(start, start + along) - near, np.maximum(start, start + along) + near
    ends = np.vstack([start, start + along])
    for k in range(len(start)):
        close = ((low <= high[k]) & (high >= low[k])).all(axis=1)
        shares = [0.0, 1.0, *_share_of_crossings(start[k], along[k], start[close], along[close])]
        near_ends = ends[np.concatenate([close, close])]
        share = (near_ends - start[k]) @ along[k] / length[k] ** 2
        gap = np.linalg.norm(start[k] + share[:, None] * along[k] - near_ends, axis=1)
        shares += share[gap <= near].tolist()
        inside = np.array(shares)
        inside = np.unique(np.clip(inside, 0, 1))
        fresh = np.concatenate([[True], np.diff(inside) * length[k] > near])
        inside = inside[fresh]
        inside[-1] = 1.0
        places = start[k] + inside[:, None] * along[k]
        pieces.append(np.stack([places[:-1], places[1:]], axis=1))
        kinds.append(np.full(len(places) - 1, letters[k]))
    return np.concatenate(pieces), np.concatenate(kinds)


def _share_of_crossings(
    start: np.ndarray, along: np.ndarray, starts: np.ndarray, alongs: np.ndarray
) -> list[float]:
    """Where on one segment others cross it, as shares of its length."""
    full = along[0] * alongs[:, 1] - along[1] * alongs[:, 0]
    apart = np.abs(full) > 1e-9 * np.linalg.norm(along) * np.linalg.norm(alongs, axis=1)
    offset = starts[apart] - start
    own = (offset[:, 0] * alongs[apart, 1] - offset[:, 1] * alongs[apart, 0]) / full[apart]
    other = (offset[:, 0] * along[1] - offset[:, 1] * along[0]) / full[apart]
    return own[(own > 0) & (own < 1) & (other > 0) & (other < 1)].tolist()


def _share_ends(
    ends: np.ndarray, letters: np.ndarray, near: float, low: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points (V, 2), edges (E, 2) and letters (E,): ends that near are one point."""
    flat = np.column_stack([ends.reshape(-1, 2), np.zeros(2 * len(ends))])
    label = group_near(flat, near)
    used, number = np.unique(label, return_inverse=True)
    edges = np.sort(number.reshape(-1, 2), axis=1)
    different = edges[:, 0] != edges[:, 1]
    edges, letters = edges[different], letters[different]
    unique, place = np.unique(edges, axis=0, return_inverse=True)
    points = flat[used, :2]
    chosen = np.full(len(unique), "", dtype="<U1")
    for k, letter in zip(place.ravel().tolist(), letters.tolist(), strict=True):
        if chosen[k] in ("", "F", "U", letter) or letter == "B":
            chosen[k] = letter
        elif chosen[k] != "B" and letter not in ("F", "U"):
            middle = points[unique[k]].mean(axis=0) + low
            raise InputError(f"a line at {say_place(middle)} is drawn as {chosen[k]} and {letter}")
    return points, unique, chosen


def _check_ends(points: np.ndarray, edges: np.ndarray) -> None:
    degree = np.bincount(edges.ravel(), minlength=len(points))
    loose = np.flatnonzero(degree == 1)
    if len(loose):
        raise InputError(
            f"{count(len(loose), 'line end')} met by no other line, one at "
            f"{say_place(points[loose[0]])}: every crease goes on to another one or to the border"
        )
    part = join_groups(len(points), edges)
    if part.max() > 0:
        least = int(np.bincount(part).argmin())
        place = points[np.flatnonzero(part == least)[0]]
        raise InputError(f"lines near {say_place(place)} are not joined to the others")


def _settle_border(
    points: np.ndarray, edges: np.ndarray, letters: np.ndarray, panels, notes: list[str]
) -> np.ndarray:
    """Letters with B on all edges of one panel and none inside."""
    sides, _, number = find_sides(panels)
    known = {tuple(side): k for side, k in zip(sides.tolist(), number.tolist(), strict=True)}
    panels_there = np.array([known.get(tuple(edge), 0) for edge in edges.tolist()])
    if (panels_there == 0).any():
        place = points[edges[int((panels_there == 0).argmax())]].mean(axis=0)
        raise InputError(f"a line at {say_place(place)} encloses no panel")
    inside = (letters == "B") & (panels_there == 2)
    if inside.any():
        place = points[edges[int(inside.argmax())]].mean(axis=0)
        raise InputError(
            f"{count(int(inside.sum()), 'border line')} inside the sheet, one at "
            f"{say_place(place)}: creases are allowed there, openings are not"
        )
    changed = (letters != "B") & (panels_there == 1)
    if changed.any():
        notes.append(f"{count(int(changed.sum()), 'line')} on the border taken as border")
    return np.where(panels_there == 1, "B", letters)
