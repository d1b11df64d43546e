"""Unfold planar panels into the plane, and fold them again along the rigid path.

Panels are laid one after the other across shared edges; how far apart the copies of a vertex
then lie is the closure, 0 for a developable sheet (and, folding, for a rigidly foldable one).
"""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.pattern.angles import measure_folds
from foldshell.pattern.grid import Grid, find_outline
from foldshell.pattern.sheet import Frame, Sheet
from foldshell.records.sheet_arrays import FoldedArrays

RIGID = 1e-9  # gap between panels, of the sheet's size, up to which a path is called rigid


@dataclass(frozen=True)
class Assembly:
    """Vertices (V, 3) [m], mean over the panels that share them, and the largest gap [m]."""

    vertices: np.ndarray
    closure: float


def unfold_panels(vertices: np.ndarray, grid: Grid) -> Assembly:
    """Lay every panel, congruent to the folded one, in the plane z = 0.

    The first column is laid upwards from panel (0, 0), then every row across from it. The
    sheet's middle is turned so that its strip lines run along y.
    """
    local = flatten_panels(vertices[grid.quads]).reshape(grid.zigzag_count - 1, -1, 4)
    placed = np.empty_like(local)
    placed[0, 0] = local[0, 0]
    for i in range(1, len(local)):  # edge a-b of a panel is edge d-c of the one below
        placed[i, 0] = _match(local[i, 0], (0, 1), placed[i - 1, 0][[3, 2]])
    for j in range(1, local.shape[1]):  # edge a-d of a panel is edge b-c of the one before
        placed[:, j] = _match(local[:, j], (0, 3), placed[:, j - 1][:, [1, 2]])
    flat = placed.reshape(-1, 4)
    sheet = _gather(np.stack([flat.real, flat.imag, 0 * flat.real], axis=-1), grid)
    return Assembly(_align(sheet.vertices, grid), sheet.closure)


def flatten_panels(corners: np.ndarray) -> np.ndarray:
    """Complex coordinates (P, 4) of panels (P, 4, 3) in their own planes, seen from above.

    All in m.
    """
    diagonals = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
    normal = np.cross(*diagonals)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    first = corners[:, 1] - corners[:, 0]
    first -= np.einsum("ij,ij->i", first, normal)[:, None] * normal
    first /= np.linalg.norm(first, axis=1)[:, None]
    second = np.cross(normal, first)
    arms = corners - corners[:, :1]
    return np.einsum("pkc,pc->pk", arms, first) + 1j * np.einsum("pkc,pc->pk", arms, second)


def _match(panel: np.ndarray, edge: tuple[int, int], onto: np.ndarray) -> np.ndarray:
    """Turn and shift panels (..., 4) so that their edge lies on `onto` (..., 2), middle to middle.

    The turn has modulus 1: a difference in length is left as a gap, not scaled away.
    """
    ends = panel[..., list(edge)]
    turn = (onto[..., 1] - onto[..., 0]) / (ends[..., 1] - ends[..., 0])
    turn /= np.abs(turn)
    shift = onto.mean(axis=-1) - turn * ends.mean(axis=-1)
    return turn[..., None] * panel + shift[..., None]


def _gather(corners: np.ndarray, grid: Grid) -> Assembly:
    """Average the copies of each vertex in panels (P, 4, 3); measure how far apart they lie."""
    index = grid.quads.ravel()
    count = np.bincount(index)
    copies = corners.reshape(-1, 3)
    mean = np.stack([np.bincount(index, copies[:, c]) / count for c in range(3)], axis=1)
    gap = np.linalg.norm(copies - mean[index], axis=1).max()
    return Assembly(mean, 2 * float(gap))


def _align(flat: np.ndarray, grid: Grid) -> np.ndarray:
    """Turn a flat sheet so that its strip lines run along y on the whole; corner at 0."""
    along = flat[grid.zigzag_index == grid.zigzag_count - 1].mean(axis=0)
    along -= flat[grid.zigzag_index == 0].mean(axis=0)
    cosine, sine = along[1] / np.hypot(*along[:2]), along[0] / np.hypot(*along[:2])
    turned = flat @ np.array([[cosine, sine, 0], [-sine, cosine, 0], [0, 0, 1.0]])
    return turned - turned.min(axis=0)


def scale_folds(folds: np.ndarray, part: float) -> np.ndarray:
    """tan(phi / 2) times `part`: the fold angles of a rigidly foldable sheet on its way.

    At flat-foldable vertices of degree four the half tangents keep their ratios (Tachi, 2009).

    Angles in rad.
    """
    return 2 * np.arctan(part * np.tan(folds / 2))


def fold_panels(flat: np.ndarray, grid: Grid, folds: np.ndarray) -> Assembly:
    """Fold a flat sheet (V, 3) by hinge rotations to fold angles (E,) [rad], valley positive.

    Each panel takes its neighbour's motion and turns on about the shared edge; the first
    column is folded upwards, then every row across.
    """
    rows, columns = grid.zigzag_count - 1, grid.strip_count - 1
    corners = flat[grid.quads].reshape(rows, columns, 4, 3)
    along_zigzag = folds[: grid.zigzag_count * columns].reshape(grid.zigzag_count, columns)
    along_strip = folds[grid.zigzag_count * columns : grid.neutral.start].reshape(
        rows, grid.strip_count
    )
    turn = np.empty((rows, columns, 3, 3))
    shift = np.empty((rows, columns, 3))
    turn[0, 0], shift[0, 0] = np.eye(3), 0.0
    for i in range(1, rows):
        a, b = corners[i, 0, 0], corners[i, 0, 1]
        turn[i, 0], shift[i, 0] = _hinge(
            turn[i - 1, 0], shift[i - 1, 0], a, b - a, along_zigzag[i, 0]
        )
    for j in range(1, columns):
        a, d = corners[:, j, 0], corners[:, j, 3]
        turn[:, j], shift[:, j] = _hinge(
            turn[:, j - 1], shift[:, j - 1], a, a - d, along_strip[:, j]
        )
    moved = np.einsum("ijcd,ijkd->ijkc", turn, corners) + shift[:, :, None]
    return _gather(moved.reshape(-1, 4, 3), grid)


def _hinge(
    turn: np.ndarray, shift: np.ndarray, point: np.ndarray, axis: np.ndarray, angle: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Motion of the panel beyond an edge: the known motion after a turn about the flat edge."""
    unit = axis / np.linalg.norm(axis, axis=-1, keepdims=True)
    local = rotate_about(unit, np.asarray(angle))
    offset = point - np.einsum("...cd,...d->...c", local, point)
    return turn @ local, np.einsum("...cd,...d->...c", turn, offset) + shift


def rotate_about(unit: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Rodrigues: rotations (..., 3, 3) about unit axes (..., 3)."""
    x, y, z = np.moveaxis(unit, -1, 0)
    zero = np.zeros_like(x)
    skew = np.stack(
        [np.stack([zero, -z, y], -1), np.stack([z, zero, -x], -1), np.stack([-y, x, zero], -1)],
        axis=-2,
    )
    sine, versine = np.sin(angle)[..., None, None], (1 - np.cos(angle))[..., None, None]
    return np.eye(3) + sine * skew + versine * (skew @ skew)


def follow_path(
    folded: np.ndarray, flat: np.ndarray, grid: Grid, parts: np.ndarray
) -> tuple[list[np.ndarray], float]:
    """Refold a sheet along its rigid path: states (V, 3) at each of `parts`, largest gap [m].

    The flat state lies level under the middle of the folded sheet; on the way from there each is
    turned towards where it lies nearest to the state after it, so that nothing jumps from one to
    the next, nor from the last one to the folded sheet.
    """
    folds = measure_folds(folded, grid)
    states = [fold_panels(flat, grid, scale_folds(folds, part)) for part in parts]
    placed, onto = [], folded
    for part, state in zip(reversed(parts), reversed(states), strict=True):
        onto = fit_onto(state.vertices, onto)
        placed.insert(0, turn_towards(lay_level(onto, grid.facets), onto, part))
    return placed, max(state.closure for state in states)


def fit_onto(vertices: np.ndarray, onto: np.ndarray) -> np.ndarray:
    """Move vertices (V, 3) rigidly to the least sum of squared distances from `onto` (V, 3).

    All in m.
    """
    centre, there = vertices.mean(axis=0), onto.mean(axis=0)
    return (vertices - centre) @ fit_turn(vertices - centre, onto - there) + there


def fit_turn(points: np.ndarray, onto: np.ndarray) -> np.ndarray:
    """Rotation R (3, 3) of least |points R - onto|, both (V, 3) about their means.

    W. Kabsch, Acta Crystallographica A32 (1976) 922: with U S V^T of the covariance, R = U V^T,
    the last axis turned where that would mirror. In m.
    """
    left, _, right = np.linalg.svd(points.T @ onto)
    return (left * [1.0, 1.0, np.sign(np.linalg.det(left @ right))]) @ right


def turn_towards(vertices: np.ndarray, onto: np.ndarray, part: float) -> np.ndarray:
    """Turn vertices (V, 3) by `part` of the rotation that lays them on their copy `onto`.

    All in m; the part has no unit.
    """
    centre = vertices.mean(axis=0)
    turn = fit_turn(vertices - centre, onto - onto.mean(axis=0)).T
    axis = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    length = np.linalg.norm(axis)
    if length > 0:
        angle = np.arctan2(length, np.trace(turn) - 1)
        turn = rotate_about(axis / length, part * angle)
    return (vertices - centre) @ turn.T + onto.mean(axis=0)


def lay_level(vertices: np.ndarray, facets: np.ndarray) -> np.ndarray:
    """Turn a state about its middle so that its facets face upwards on the mean.

    vertices (V, 3) m, as returned; facets (F, 3).
    """
    corners = vertices[facets]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).sum(axis=0)
    axis = np.cross(area, [0.0, 0.0, 1.0])
    sine = np.linalg.norm(axis)
    if sine == 0:
        return vertices
    tilt = rotate_about(axis / sine, np.arctan2(sine, area[2]))
    centre = vertices.mean(axis=0)
    return (vertices - centre) @ tilt.T + centre


def find_overlap(flat: np.ndarray, grid: Grid) -> bool:
    """Tell whether the flat sheet overlaps itself: a facet turned over, or its border crossing.

    flat (V, 3) m, of which x and y count.
    """
    corners = flat[grid.facets][:, :, :2]
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    if (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0] <= 0).any():
        return True
    ring = find_outline(grid)
    start, end = flat[ring, :2], flat[np.roll(ring, -1), :2]

    def side(p: np.ndarray, q: np.ndarray, r: np.ndarray) -> np.ndarray:
        """Twice the area of the triangles p, q, r: positive counter-clockwise."""
        return (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1]) - (q[..., 1] - p[..., 1]) * (
            r[..., 0] - p[..., 0]
        )

    s, e = start[:, None], end[:, None]
    crosses = (side(s, e, start) * side(s, e, end) < 0) & (
        side(start, end, s) * side(start, end, e) < 0
    )
    return bool(crosses.any())


def describe_true_sheet(
    sheet: Sheet, flat: np.ndarray, folded: np.ndarray, parts: np.ndarray
) -> Sheet:
    """Build the sheet of a folded design: its flat state, its path, its shape.

    The rigid path is kept only if panels stay together on it, to RIGID of the sheet's size.

    flat and folded (V, 3) m; parts (E,) say how much of each fold the path turns, without unit.
    """
    frames = [Frame("folded", folded)]
    if sheet.kind not in ("smooth", "flat"):
        states, closure = follow_path(folded, flat, sheet.grid, parts)
        if closure <= RIGID * np.ptp(flat, axis=0).max():
            frames = [
                Frame(f"rigid path {part:.3f}", state)
                for part, state in zip(parts, states, strict=True)
            ] + frames
    # Sides and angles of the given pattern do not describe another one.
    settings = sheet.settings if np.array_equal(flat, sheet.flat) else {}
    return replace(
        sheet, flat=flat, rest=folded, path=tuple(frames), settings=settings, unrolled=None
    )


def check_same_vertices(
    sheet: Sheet, folded: FoldedArrays, folded_path: str | Path, pattern_path: str | Path
) -> None:
    """Raise `InputError` where a folded sheet has other vertices than its pattern."""
    if (count := len(folded.vertices)) != (due := len(sheet.flat)):
        raise InputError(f"{folded_path}: vertices: {count}: must be {due} as in {pattern_path}")


def name_flat_state(grid: Grid, folded: FoldedArrays, fold_mode: str) -> str:
    """Name what the flat state of folded.npz is: unfolded, or the given pattern and its stretch."""
    if fold_mode in ("exact", "rigid"):
        return "unfolded from the folded shape"
    flat, shape = (
        np.linalg.norm(np.diff(state[grid.edges], axis=1)[:, 0], axis=1)
        for state in (folded.flat, folded.vertices)
    )
    stretch = np.abs(shape / flat - 1).max()
    return f"the given pattern (mode {fold_mode}: its sides stretch by up to {100 * stretch:.2g} %)"
