"""Quality of a folded sheet: what was distorted, what crumpled, what the target misses."""

from collections.abc import Sequence

import numpy as np

from foldshell.folding.intersections import find_intersections
from foldshell.folding.problem import edge_lengths, place_sheet
from foldshell.folding.terms import Target
from foldshell.pattern.angles import developability_residual, measure_folds
from foldshell.pattern.grid import Grid
from foldshell.pattern.sheet import Sheet
from foldshell.records.quality import QualityMeasures


def measure_quality(
    vertices: np.ndarray,
    grid: Grid,
    flat: np.ndarray,
    distances: np.ndarray,
    span: float,
    folded: bool = True,
    sides: tuple[float, float] | None = None,
) -> QualityMeasures:
    """Measure a folded sheet: vertices and flat state (V, 3) [m], signed distances (N,) [m].

    `folded` False leaves out the fold directions, for sheets without folds. `span` is that of
    distances, `sides` are those of a rectangular plan [m].
    """
    strain = edge_lengths(vertices, grid.edges) / edge_lengths(flat, grid.edges) - 1
    planarity = measure_planarity(vertices, grid.quads)
    folds = measure_folds(vertices, grid)
    neutral = np.degrees(np.abs(folds[grid.neutral]))
    return QualityMeasures(
        rms_over_span=root_mean_square(distances) / span,
        max_over_span=float(np.abs(distances).max(initial=0.0)) / span,
        edge_strain_max=float(np.abs(strain).max()),
        edge_strain_rms=root_mean_square(strain),
        angle_defect_max_rad=float(np.abs(developability_residual(vertices, grid)).max()),
        planarity_max=float(planarity.max()),
        planarity_mean=float(planarity.mean()),
        neutral_fold_mean_deg=float(neutral.mean()),
        neutral_fold_max_deg=float(neutral.max()),
        flipped_folds=count_flipped(folds, grid) if folded else 0,
        self_intersections=len(find_intersections(vertices, grid.facets)),
        plan_coverage=measure_coverage(vertices, grid.facets, span if sides is None else sides),
        panels_not_convex=int((~find_convex(vertices, grid.quads)).sum()),
        edge_ratio_max=float(measure_edge_ratio(vertices, grid.quads).max()),
    )


def root_mean_square(values: np.ndarray) -> float:
    """sqrt(mean(v2)) of values (N,) in their own unit; 0 for nothing."""
    return float(np.sqrt(np.mean(values**2))) if len(values) else 0.0


def measure_planarity(vertices: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """Distance between the diagonals' lines over their mean length (P,), quads (P, 4).

    vertices (V, 3) m; the ratio has no unit.
    """
    a, b, c, d = (vertices[quads[:, k]] for k in range(4))
    normal = np.cross(c - a, d - b)
    distance = np.abs(np.einsum("ij,ij->i", b - a, normal)) / np.linalg.norm(normal, axis=1)
    return distance / (np.linalg.norm(c - a, axis=1) + np.linalg.norm(d - b, axis=1)) * 2


def count_flipped(folds: np.ndarray, grid: Grid) -> int:
    """Number of creases whose fold angle (E,) [rad] is against their assignment."""
    wrong_valley = (grid.assignments == "V") & (folds < 0)
    wrong_mountain = (grid.assignments == "M") & (folds > 0)
    return int((wrong_valley | wrong_mountain).sum())


def find_convex(vertices: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """Panels (P,) all of whose corners turn the same way about the panel's mean normal.

    vertices (V, 3) m, quads (P, 4); bool.
    """
    corners = vertices[quads]
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    ahead = np.roll(corners, -1, axis=1) - corners
    turn = np.einsum("ijk,ik->ij", np.cross(np.roll(ahead, 1, axis=1), ahead), normal)
    return (turn > 0).all(axis=1)


def measure_sides(vertices: np.ndarray, polygons: np.ndarray) -> np.ndarray:
    """Lengths (N, k) [m] of the sides of polygons (N, k), each from its corner to the next."""
    corners = vertices[polygons]
    return np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)


def measure_edge_ratio(vertices: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """Longest over shortest side of each panel (P,).

    vertices (V, 3) m, quads (P, 4); the ratio has no unit.
    """
    sides = measure_sides(vertices, quads)
    return sides.max(axis=1) / sides.min(axis=1)


def measure_strain(vertices: np.ndarray, flat: np.ndarray, facets: np.ndarray) -> np.ndarray:
    """Largest edge strain of each facet (F,).

    vertices and flat (V, 3) m, facets (F, 3); strain has no unit.
    """
    strain = measure_sides(vertices, facets) / measure_sides(flat, facets) - 1
    return np.abs(strain).max(axis=1)


def measure_coverage(
    vertices: np.ndarray, facets: np.ndarray, span: float | Sequence[float], samples: int = 200
) -> float:
    """Share of the plan that lies under the sheet, on a grid of sample points.

    Each facet's bounding box in plan is scanned; its points are tested by the signs of the
    three edge functions, whichever way up the facet is.

    vertices (V, 3) m, facets (F, 3), span in m, of a rectangle both sides.
    """
    spacing = np.broadcast_to(span, 2) / samples
    corners = vertices[facets][:, :, :2] / spacing + samples / 2 - 0.5
    low = np.clip(np.ceil(corners.min(axis=1)), 0, samples).astype(int)
    high = np.clip(np.floor(corners.max(axis=1)) + 1, 0, samples).astype(int)
    size = np.maximum(high - low, 0)
    counts = size[:, 0] * size[:, 1]
    facet = np.repeat(np.arange(len(facets)), counts)
    place = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    row, column = np.divmod(place, size[facet, 0])
    points = low[facet] + np.column_stack([column, row])
    turns = [_turn(corners[facet, k], corners[facet, (k + 1) % 3], points) for k in range(3)]
    inside = (np.min(turns, axis=0) >= 0) | (np.max(turns, axis=0) <= 0)
    covered = np.zeros((samples, samples), dtype=bool)
    covered[points[inside, 0], points[inside, 1]] = True
    return float(covered.mean())


def measure_start_coverage(sheet: Sheet, target: Target, attract: str) -> float:
    """Share of the plan under the sheet as it is laid on the target: what it could cover.

    A coarse zig-zag border leaves much of the plan free without anything being wrong.
    """
    start = place_sheet(sheet, target, attract)
    return measure_coverage(start, sheet.grid.facets, target.sides)


def _turn(start: np.ndarray, end: np.ndarray, point: np.ndarray) -> np.ndarray:
    one, two = end - start, point - start
    return one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]
