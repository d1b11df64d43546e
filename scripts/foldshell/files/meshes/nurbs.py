"""A NURBS surface as a mesh: points exactly on it, as dense as a chord error asks.

Piegl and Tiller, The NURBS Book (1997), eqs. 4.15 and 4.16: homogeneous control points
(w x, w y, w z, w) are blended by B-splines, the sum is divided by its last coordinate.
"""

import math
from dataclasses import dataclass

import numpy as np

from foldshell.files.meshes.model import Mesh, MeshError, make_mesh

SAMPLED = "a curved surface, sampled"
"""Note on a mesh that was no mesh in its file."""
CHORD = 1e-5
"""Largest chord error, of the surface's extent, where the caller names none."""
SHARE = 0.75
"""Of the chord error, for each side: four thirds of a side's sag bound a triangle's."""
FIRST = 32  # intervals along each side to begin with
MOST = 1_000_000  # points of a mesh
RANGE = 1e12  # of homogeneous coordinates; weights lie above its inverse
LARGEST = 3.0  # sizes of the plan that a surface may have, of the span
ROUNDINGS = 64  # of the largest coordinate: points nearer than these are one
ROUNDS = 8  # of refinement


@dataclass(frozen=True)
class NurbsPatch:
    """Homogeneous control points (I, J, 4) in the file's unit, and knots with both end knots.

    There are I + p + 1 knots along u and J + q + 1 along v for the degrees p and q.
    """

    points: np.ndarray
    knots: tuple[np.ndarray, np.ndarray]

    @property
    def degrees(self) -> tuple[int, int]:
        """Degrees p and q of the polynomials along u and v."""
        first, second = (len(self.knots[k]) - self.points.shape[k] - 1 for k in (0, 1))
        return first, second

    def find_spans(self, axis: int) -> np.ndarray:
        """Distinct knots (S + 1,), numbers without unit, that bound the pieces of the domain."""
        degree, number = self.degrees[axis], self.points.shape[axis]
        return np.unique(self.knots[axis][degree : number + 1])


def make_patch(points: np.ndarray, inner_u: np.ndarray, inner_v: np.ndarray) -> NurbsPatch:
    """Build a patch from the knots that Rhino keeps: it leaves out the first and the last one.

    Those two are repeated; within the domain no B-spline depends on them.

    points (I, J, 4) homogeneous, in the file's unit; inner_u (I + p - 1,), inner_v (J + q - 1,).
    Raises `MeshError` for numbers that are not finite or beyond RANGE, weights that are not
    positive, and knots that fall or do not fit the control points.
    """
    wrong = ~((np.abs(points) < RANGE).all(axis=2) & (points[..., 3] > 1 / RANGE))
    if wrong.any():
        i, j = np.argwhere(wrong)[0]
        place = ", ".join(f"{value:g}" for value in points[i, j])
        raise MeshError(
            f"control point {i + 1}, {j + 1} of its surface is {place}: finite coordinates and a "
            f"positive weight, up to {RANGE:g}, are allowed"
        )
    for name, inner, number in (("u", inner_u, len(points)), ("v", inner_v, points.shape[1])):
        degree = len(inner) - number + 1
        fits = 1 <= degree < number and np.isfinite(inner).all() and (np.diff(inner) >= 0).all()
        if not (fits and inner[degree - 1] < inner[number - 1]):
            raise MeshError(
                f"the {len(inner)} knots along {name} of its surface do not fit {number} control "
                "points: finite knots that do not fall are allowed"
            )
    ends = [np.concatenate([inner[:1], inner, inner[-1:]]) for inner in (inner_u, inner_v)]
    return NurbsPatch(np.ascontiguousarray(points, dtype=float), (ends[0], ends[1]))


def evaluate_patch(patch: NurbsPatch, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """S(u, v) = sum_ij N_i(u) N_j(v) (w p)_ij / sum_ij N_i(u) N_j(v) w_ij.

    u (M,) and v (N,) within the domain; returns (M, N, 3) in the file's unit.
    """
    from scipy.interpolate import NdBSpline

    places = np.stack(np.meshgrid(u, v, indexing="ij"), axis=-1)
    found = NdBSpline(patch.knots, patch.points, patch.degrees)(places)
    return found[..., :3] / found[..., 3:]


def mesh_patch(patch: NurbsPatch, chord: float | None = None) -> Mesh:
    """Quadrilaterals whose corners lie on a patch, no farther from it than `chord` between them.

    `chord` is in the file's unit; None is CHORD of the extent. Every knot is a line of the mesh,
    so that creases stay. One that is too large for the span that `chord` stands for is meshed by
    its own size: it will be refused for that. Raises `MeshError` where more than MOST points are
    needed.
    """
    grid = _close(_refine(patch, chord))
    number = np.arange(grid.shape[0] * grid.shape[1]).reshape(grid.shape[:2])
    sides = [number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]]
    quads = np.stack([side.ravel() for side in sides], axis=1)
    return make_mesh(grid.reshape(-1, 3), np.full(len(quads), 4), quads.ravel(), notes=(SAMPLED,))


def _refine(patch: NurbsPatch, chord: float | None) -> np.ndarray:
    """Points (M, N, 3) of the coarsest grid found whose triangles keep to the chord error."""
    spans = [patch.find_spans(axis) for axis in (0, 1)]
    pieces = [max(2, -(-FIRST // (len(knots) - 1))) for knots in spans]
    for _ in range(ROUNDS):
        if math.prod(p * (len(k) - 1) + 1 for p, k in zip(pieces, spans, strict=True)) > MOST:
            break
        u, v = (_divide(knots, 2 * p) for knots, p in zip(spans, pieces, strict=True))
        grid = evaluate_patch(patch, u, v)
        size = np.ptp(grid, axis=(0, 1))
        limit = SHARE * max(chord or CHORD * size.max(), CHORD * size[:2].min() / LARGEST)
        sags = measure_sags(grid)
        if max(sags) <= limit:
            return grid[::2, ::2]
        pieces = _cut_finer(pieces, sags, limit)
    raise MeshError(
        f"its surface of {len(spans[0]) - 1} x {len(spans[1]) - 1} spans bends so sharply that "
        f"more than {MOST:,} points are needed: a smoother surface or a mesh is allowed"
    )


def _cut_finer(pieces: list[int], sags: tuple[float, float, float], limit: float) -> list[int]:
    """More pieces along u and v for sags that fall with their square: half the limit for either.

    What one direction leaves of its half is the other one's.
    """
    twist = max(sags[2] - sags[0] - sags[1], 0.0)
    needs = [sags[0] + twist / 2, sags[1] + twist / 2]
    budgets = [limit - min(need, limit / 2) for need in needs[::-1]]
    finer = [max(1.0, 1.02 * math.sqrt(n / b)) for n, b in zip(needs, budgets, strict=True)]
    least = 1.0 if max(finer) > 1.0 else 1.1
    return [math.ceil(p * max(f, least)) for p, f in zip(pieces, finer, strict=True)]


def _close(grid: np.ndarray) -> np.ndarray:
    """Make poles one point, and both sides of a seam the same ones, where roundings part them."""
    near = ROUNDINGS * np.finfo(float).eps * np.abs(grid).max()
    closed = grid.copy()
    for turned in (closed, closed.transpose(1, 0, 2)):  # views: what is set stays in `closed`
        if np.abs(turned[-1] - turned[0]).max() < near:
            turned[-1] = turned[0]
        for end in (turned[0], turned[-1]):
            if np.ptp(end, axis=0).max() < near:
                end[:] = end[0]
    return closed


def _divide(knots: np.ndarray, pieces: int) -> np.ndarray:
    """Every interval between knots (S + 1,) in equal pieces: (S pieces + 1,), knots unrounded."""
    shares = np.arange(pieces) / pieces
    inner = knots[:-1, None] + np.diff(knots)[:, None] * shares
    return np.append(inner.ravel(), knots[-1])


def measure_sags(grid: np.ndarray) -> tuple[float, float, float]:
    """Largest sag of the sides along u, along v, and of both diagonals of every second line.

    Sides: |d - (d.c) c / c.c|, with d from the middle of the chord c to the surface; diagonals:
    |d.n|, along the normal of the cell.

    grid (2 M + 1, 2 N + 1, 3) in one unit of length, the odd lines halfway between the even ones.
    """
    nodes, middles = grid[::2, ::2], grid[1::2, 1::2]
    along_u = _measure_sag(nodes[:-1], nodes[1:], grid[1::2, ::2])
    along_v = _measure_sag(nodes[:, :-1], nodes[:, 1:], grid[::2, 1::2])
    a, b, c, d = nodes[:-1, :-1], nodes[1:, :-1], nodes[1:, 1:], nodes[:-1, 1:]
    normal = np.cross(c - a, d - b)
    length = np.linalg.norm(normal, axis=2)
    normal /= np.where(length > 0, length, 1.0)[..., None]
    offsets = np.stack([middles - 0.5 * (a + c), middles - 0.5 * (b + d)])
    return along_u, along_v, float(np.abs((offsets * normal).sum(axis=-1)).max())


def _measure_sag(starts: np.ndarray, ends: np.ndarray, middles: np.ndarray) -> float:
    chords, offsets = ends - starts, middles - 0.5 * (starts + ends)
    squared = (chords**2).sum(axis=-1)
    along = (offsets * chords).sum(axis=-1) / np.where(squared > 0, squared, 1.0)
    return float(np.linalg.norm(offsets - along[..., None] * chords, axis=-1).max())
