"""An independent look at a folded sheet: from folded.npz and the target alone.

Shares no code with the library. Formulas are other ones than the library's where there is a
choice: half-angle tangents for angles, signed volumes for intersections, lines across the shadow
for the coverage, closest points region by region. `find_creases` states the files' convention.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Triangulation:
    """A target: vertices (V, 3) and triangles (F, 3), over a plan of side span about middle."""

    vertices: np.ndarray
    triangles: np.ndarray
    span: float
    middle: tuple[float, float]


@dataclass(frozen=True)
class Graph:
    """A target z = c + p x2 + q y2 + r x y over a plan about 0."""

    span: float
    coefficients: tuple[float, float, float, float]
    middle: tuple[float, float] = (0.0, 0.0)


def measure(path: Path, target: Triangulation | Graph, highest: bool = False) -> dict[str, float]:
    """Everything that quality.json tells of a folded sheet, under its names."""
    with np.load(path) as data:
        file = {name: data[name] for name in data.files}
    points, flat = file["vertices"], file["flat"]
    attracted = points[file["zigzag"] % 2 == highest]
    distances = find_distances(attracted, target) / target.span
    strain = find_strain(points, flat, file)
    warp = find_warp(points, file["quads"])
    return {
        "rms_over_span": float(np.sqrt((distances**2).mean())),
        "max_over_span": float(np.abs(distances).max()),
        "edge_strain_max": float(np.abs(strain).max()),
        "edge_strain_rms": float(np.sqrt((strain**2).mean())),
        "angle_defect_max_rad": float(np.abs(find_defects(points, file)).max()),
        "planarity_max": float(warp.max()),
        "planarity_mean": float(warp.mean()),
        "flipped_folds": count_flips(points, file),
        "self_intersections": count_cuts(points, file["facets"]),
        "plan_coverage": find_coverage(points, file["facets"], target),
        "unfold_closure_m": find_closure(points, file["quads"]),
    }


def find_distances(points, target):
    """Distance of each point to the target; past its border, to the tangent plane there."""
    if isinstance(target, Graph):
        return _to_graph(points, target)
    normals = np.zeros_like(target.vertices)
    corners = target.vertices[target.triangles]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area[area[:, 2] < 0] *= -1
    for k in range(3):
        for axis in range(3):
            normals[:, axis] += np.bincount(
                target.triangles[:, k], area[:, axis], len(target.vertices)
            )
    sides = np.sort(target.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges, number = np.unique(sides, axis=0, return_counts=True)
    border = {tuple(edge) for edge in edges[number == 1].tolist()}
    rim = {vertex for edge in border for vertex in edge}
    found = []
    for point in points:
        cell, weights = _closest_on_triangles(point, corners)
        row = target.triangles[cell]
        foot = weights @ target.vertices[row]
        used = [int(v) for v, w in zip(row, weights, strict=True) if w > 1e-9]
        over = (len(used) == 1 and used[0] in rim) or (
            len(used) == 2 and tuple(sorted(used)) in border
        )
        if over:
            units = normals[row] / np.linalg.norm(normals[row], axis=1)[:, None]
            normal = weights @ units
            found.append(abs((point - foot) @ normal) / np.linalg.norm(normal))
        else:
            found.append(np.linalg.norm(point - foot))
    return np.array(found)


def _closest_on_triangles(point, corners):
    """Triangle nearest to a point, and the barycentric weights of the nearest place on it.

    The foot in the plane where it lies inside, else the nearest place on one of the three sides.
    """
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    u, v, w = b - a, c - a, point - a
    uu, uv, vv = (u * u).sum(1), (u * v).sum(1), (v * v).sum(1)
    wu, wv = (w * u).sum(1), (w * v).sum(1)
    full = uu * vv - uv**2
    s, t = (vv * wu - uv * wv) / full, (uu * wv - uv * wu) / full
    choices = [np.stack([1 - s - t, s, t], 1)]
    zero = np.zeros_like(s)
    along_ab = np.clip(wu / uu, 0, 1)
    along_ac = np.clip(wv / vv, 0, 1)
    x = c - b
    along_bc = np.clip(((point - b) * x).sum(1) / (x * x).sum(1), 0, 1)
    choices.append(np.stack([1 - along_ab, along_ab, zero], 1))
    choices.append(np.stack([1 - along_ac, zero, along_ac], 1))
    choices.append(np.stack([zero, 1 - along_bc, along_bc], 1))
    best, answer = np.inf, None
    for weights in choices:
        gaps = np.linalg.norm(np.einsum("fk,fkc->fc", weights, corners) - point, axis=1)
        gaps[(weights < 0).any(axis=1)] = np.inf
        cell = int(gaps.argmin())
        if gaps[cell] < best - 1e-13:
            best, answer = gaps[cell], (cell, weights[cell])
    return answer


def _to_graph(points, target):
    """Newton on the foot's plan position from the nearest of a grid of feet."""
    c, p, q, r = target.coefficients
    ticks = np.linspace(-0.75 * target.span, 0.75 * target.span, 151)
    gx, gy = (k.ravel() for k in np.meshgrid(ticks, ticks))
    grid = np.column_stack([gx, gy, c + p * gx**2 + q * gy**2 + r * gx * gy])
    found = []
    for point in points:
        x, y = grid[((grid - point) ** 2).sum(1).argmin(), :2]
        for _ in range(50):
            z = c + p * x * x + q * y * y + r * x * y
            zx, zy = 2 * p * x + r * y, 2 * q * y + r * x
            d = z - point[2]
            slope = np.array([x - point[0] + d * zx, y - point[1] + d * zy])
            curve = np.array([[1 + zx * zx + 2 * p * d, zx * zy + r * d],
                              [zx * zy + r * d, 1 + zy * zy + 2 * q * d]])  # fmt: skip
            step = np.linalg.solve(curve, slope)
            x, y = x - step[0], y - step[1]
            if np.abs(step).max() < 1e-14 * target.span:
                break
        foot = np.array([x, y, c + p * x * x + q * y * y + r * x * y])
        found.append(np.linalg.norm(foot - point))
    return np.array(found)


def find_strain(points, flat, file):
    """Change of length of all sides of panels and of the folds across them, of itself."""
    quads = file["quads"].tolist()
    corners = [(quad[k - 1], quad[k]) for quad in quads for k in range(4)]
    for one, two in zip(file["facets"][::2].tolist(), file["facets"][1::2].tolist(), strict=True):
        corners.append(tuple(sorted(set(one) & set(two))))
    pairs = np.array(sorted({tuple(sorted(pair)) for pair in corners}))
    length = [np.sqrt(((k[pairs[:, 0]] - k[pairs[:, 1]]) ** 2).sum(1)) for k in (points, flat)]
    return (length[0] - length[1]) / length[1]


def find_defects(points, file):
    """2 pi less the angles of the facets about each vertex inside the sheet [rad]."""
    total = np.zeros(len(points))
    for k in range(3):
        centre, one, two = (file["facets"][:, (k + m) % 3] for m in range(3))
        a, b = points[one] - points[centre], points[two] - points[centre]
        la, lb = np.linalg.norm(a, axis=1)[:, None], np.linalg.norm(b, axis=1)[:, None]
        apart, along = (
            np.linalg.norm(a * lb - b * la, axis=1),
            np.linalg.norm(a * lb + b * la, axis=1),
        )
        np.add.at(total, centre, 2 * np.arctan2(apart, along))
    i, j = file["zigzag"], file["strip"]
    inside = (i > 0) & (i < i.max()) & (j > 0) & (j < j.max())
    return 2 * np.pi - total[inside]


def find_warp(points, quads):
    """Least distance of the two diagonals' lines over their mean length, by least squares."""
    a, b, c, d = (points[quads[:, k]] for k in range(4))
    found = []
    for p, u, q, v in zip(a, c - a, b, d - b, strict=True):
        places = np.linalg.lstsq(np.column_stack([u, -v]), q - p, rcond=None)[0]
        gap = np.linalg.norm(p + places[0] * u - q - places[1] * v)
        found.append(2 * gap / (np.linalg.norm(u) + np.linalg.norm(v)))
    return np.array(found)


def find_creases(file):
    """Creases inside the sheet as (vertex, vertex, is valley).

    Along zig-zag i, counted from 0, all are valleys where i is even. Across, from zig-zag i to
    i + 1 on strip line j, it is a valley where i + j is odd.
    """
    place = {(i, j): k for k, (i, j) in enumerate(zip(file["zigzag"], file["strip"], strict=True))}
    last_i, last_j = file["zigzag"].max(), file["strip"].max()
    for (i, j), k in place.items():
        if 0 < i < last_i and j < last_j:
            yield k, place[i, j + 1], i % 2 == 0
        if 0 < j < last_j and i < last_i:
            yield k, place[i + 1, j], (i + j) % 2 == 1


def count_flips(points, file):
    """Creases that fold the other way: where the far corner is below instead of above."""
    beside = {}
    for facet in file["facets"].tolist():
        for k in range(3):
            beside[facet[k], facet[(k + 1) % 3]] = facet[(k + 2) % 3]
    flips = 0
    for a, b, valley in find_creases(file):
        left, right = beside[a, b], beside[b, a]
        above = np.linalg.det(points[[b, left, right]] - points[a])
        flips += bool(above < 0) if valley else bool(above > 0)
    return flips


def count_cuts(points, facets):
    """Pairs of facets of which a side of one goes through the other, by signs of volumes."""
    first, second = np.triu_indices(len(facets), 1)
    low, high = points[facets].min(axis=1), points[facets].max(axis=1)
    near = ((low[first] <= high[second]) & (low[second] <= high[first])).all(axis=1)
    first, second = first[near], second[near]
    common = (facets[first][:, :, None] == facets[second][:, None, :]).sum(axis=(1, 2))
    first, second = first[common < 2], second[common < 2]
    cut = np.zeros(len(first), dtype=bool)

    def volume(a, b, c, d):
        return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)

    for one, two in ((first, second), (second, first)):
        a, b, c = (points[facets[two][:, k]] for k in range(3))
        for k in range(3):
            start, end = facets[one][:, k], facets[one][:, (k + 1) % 3]
            s, e = points[start], points[end]
            apart = ~((facets[two] == start[:, None]) | (facets[two] == end[:, None])).any(axis=1)
            sides = np.stack([volume(s, e, a, b), volume(s, e, b, c), volume(s, e, c, a)])
            ends = np.stack([volume(a, b, c, s), -volume(a, b, c, e)])
            cut |= apart & _all_of_one_sign(sides) & _all_of_one_sign(ends)
    return int(cut.sum())


def _all_of_one_sign(values):
    """Columns whose values all have one sign, none of them next to nothing beside their sum.

    What only touches does not cut: 1e-9 is the share that the files' own measure leaves out.
    """
    total = values.sum(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return (values / total > 1e-9).all(axis=0)


def find_coverage(points, facets, target):
    """Share of the plan's area below the sheet: lengths of its shadow along 1500 lines."""
    half, lines = target.span / 2, 1500
    corners = (points[:, :2] - target.middle)[facets]
    covered = 0.0
    for y in half * (2 * (np.arange(lines) + 0.5) / lines - 1):
        ends = []
        for k in range(3):
            start, end = corners[:, k], corners[:, (k + 1) % 3]
            crosses = (start[:, 1] > y) != (end[:, 1] > y)
            with np.errstate(divide="ignore", invalid="ignore"):
                share = (y - start[:, 1]) / (end[:, 1] - start[:, 1])
            ends.append(np.where(crosses, start[:, 0] + share * (end[:, 0] - start[:, 0]), np.nan))
        met = ~np.isnan(ends).all(axis=0)
        if not met.any():
            continue
        low = np.clip(np.nanmin(np.array(ends)[:, met], axis=0), -half, half)
        high = np.clip(np.nanmax(np.array(ends)[:, met], axis=0), -half, half)
        order = np.argsort(low)
        reached = np.maximum.accumulate(high[order])
        before = np.concatenate([[-half], reached[:-1]])
        covered += np.maximum(high[order] - np.maximum(low[order], before), 0).sum()
    return float(covered / lines / target.span)


def find_closure(points, quads):
    """Largest gap [m] between copies of a vertex when panels are laid out across shared sides.

    From the middle panel outwards, breadth first, each on the side it was reached over.
    """
    sides = {}
    for panel, quad in enumerate(quads.tolist()):
        for k in range(4):
            sides.setdefault(frozenset((quad[k], quad[(k + 1) % 4])), []).append(panel)
    laid, copies = {}, {}
    first = len(quads) // 2
    queue = [(first, None)]
    seen = {first}
    while queue:
        panel, over = queue.pop(0)
        quad = quads[panel].tolist()
        flat = _flatten(points[quad])
        if over is not None:
            known = laid[over]
            a, b = [v for v in quad if v in known]
            own = {v: flat[k] for k, v in enumerate(quad)}
            turn = (known[b] - known[a]) / (own[b] - own[a])
            turn /= abs(turn)
            middle, own_middle = (known[a] + known[b]) / 2, (own[a] + own[b]) / 2
            flat = [middle + turn * (value - own_middle) for value in flat]
        laid[panel] = dict(zip(quad, flat, strict=True))
        for vertex, place in laid[panel].items():
            copies.setdefault(vertex, []).append(place)
        for k in range(4):
            for other in sides[frozenset((quad[k], quad[(k + 1) % 4]))]:
                if other not in seen:
                    seen.add(other)
                    queue.append((other, panel))
    return max(abs(one - two) for found in copies.values() for one in found for two in found)


def _flatten(corners):
    """Complex coordinates of a panel in its plane, found by singular values, seen from above."""
    centred = corners - corners.mean(axis=0)
    _, _, axes = np.linalg.svd(centred)
    x, y = centred @ axes[0], centred @ axes[1]
    area = sum(x[k] * y[(k + 1) % 4] - x[(k + 1) % 4] * y[k] for k in range(4))
    return list(x + 1j * (y if area > 0 else -y))
