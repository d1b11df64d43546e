"""Fold a sheet onto a target: one interface for every mode."""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from foldshell.folding.developable_pattern import fold_exactly, fold_rigidly
from foldshell.folding.isometric import fold_isometrically
from foldshell.folding.placement import place_vertices, round_as_written
from foldshell.folding.problem import attracted_vertices
from foldshell.folding.quality import measure_quality, measure_start_coverage
from foldshell.folding.shape import Shape
from foldshell.folding.soft import fold_softly
from foldshell.folding.terms import Target, measure_distances
from foldshell.pattern.sheet import Sheet
from foldshell.records.quality import QualityMeasures
from foldshell.settings.fold import Fold, FoldLimits

# 2e-3 is what rigid domes are to reach; isometric saddles come nearer, or something went wrong.
SADDLE_RMS = 1.6e-3

SURFACE_STEPS = 6
"""Steps of a smooth panel between its corners: what meshes of 2, 3 and 6 quads a side take."""

WELL_WITHIN = 0.05  # of the limit on the rms distance


@dataclass(frozen=True)
class FoldResult:
    """A folded sheet: shape, signed distances (V,) [m] to the target, quality, state.

    `attracted` are the rows of the vertices that were drawn to it, which the quality measures.
    `state` is ok, not_reached (target or tolerance missed) or crumpled (folds turned over, the
    sheet cuts itself, or too little of the plan is covered); `reason` says why in words.
    """

    shape: Shape
    attracted: np.ndarray
    distances: np.ndarray
    quality: QualityMeasures
    state: str
    reason: str
    seconds: float


def fold_sheet(sheet: Sheet, target: Target, mode: str, settings: Fold) -> FoldResult:
    """Fold `sheet` so that its lowest or highest vertices lie on `target`.

    mode: elastic (soft springs), isometric (hard lengths), exact (true crease pattern), rigid
    (exact and rigidly foldable). Smooth and flat sheets are only laid out.
    """
    start = time.perf_counter()
    if mode not in SOLVERS:
        raise ValueError(f"fold_mode {mode!r}: must be one of {', '.join(SOLVERS)}")
    solve = LAYOUTS.get(sheet.kind) or SOLVERS[mode]
    shape = solve(sheet, target, settings)
    shape = replace(shape, vertices=round_as_written(shape.vertices, target))
    attracted = attracted_vertices(sheet, settings.attract)
    if sheet.kind == "flat":  # it is not meant to reach the target
        distances = np.zeros(len(shape.vertices))
    else:
        distances = measure_distances(shape.vertices, target)
    folded = sheet.kind not in LAYOUTS
    quality = measure_quality(
        shape.vertices, sheet.grid, shape.flat, distances[attracted], target.span, folded,
        target.sides,
    )  # fmt: skip
    start_coverage = measure_start_coverage(sheet, target, settings.attract) if folded else 0.0
    least = settings.limits.plan_coverage * start_coverage
    state, reason = judge_shape(shape, quality, allowed_rms(settings.limits, mode), least, mode)
    reach = target.measure_reach(shape.vertices[attracted]) if folded else 0.0
    if reach:
        shape = replace(shape, residuals={**shape.residuals, "beyond_border_m": reach})
    seconds = time.perf_counter() - start
    placed = replace(shape, vertices=place_vertices(shape.vertices, target))
    if shape.surface is not None:
        points = place_vertices(shape.surface.reshape(-1, 3), target)
        placed = replace(placed, surface=points.reshape(shape.surface.shape))
    return FoldResult(placed, attracted, distances, quality, state, reason, seconds)


def allowed_rms(limits: FoldLimits, mode: str) -> float:
    """rms distance over span that `mode` may leave: an isometric saddle at most SADDLE_RMS."""
    return min(limits.rms_over_span, SADDLE_RMS) if mode == "isometric" else limits.rms_over_span


def judge_shape(
    shape: Shape, quality: QualityMeasures, rms_limit: float, coverage_limit: float, mode: str
) -> tuple[str, str]:
    """Name the state of a folded sheet and the reason for it.

    An isometric sheet that misses its target or the plan is not_reached whatever else is wrong
    with it: that no isometry leads there is the finding, and folds turned over its consequence.
    """
    faults = []
    if quality.flipped_folds:
        faults.append(f"{quality.flipped_folds} folds turned over")
    if quality.self_intersections:
        faults.append(f"{quality.self_intersections} facet pairs cut each other")
    if not quality.plan_coverage >= coverage_limit:
        faults.append(f"plan coverage {quality.plan_coverage:.3f} < {coverage_limit:.3f}")
    missed = not quality.rms_over_span <= rms_limit
    if faults and mode != "isometric":
        return "crumpled", "; ".join(faults)
    if missed or faults:
        distance = f"rms distance {quality.rms_over_span:.2e} span, allowed {rms_limit:g}"
        return "not_reached", "; ".join([distance, shape.reason, *faults])
    # Where the iterations of soft springs end well within the limits, they have done their work.
    ended_well = mode == "elastic" and quality.rms_over_span <= WELL_WITHIN * rms_limit
    return ("ok" if shape.converged or ended_well else "not_reached"), shape.reason


def lay_smooth(sheet: Sheet, target: Target, settings: Fold) -> Shape:
    """Lay the panel grid on the target itself by arc length of its central sections."""
    del settings
    centred = sheet.flat - sheet.flat.mean(axis=0)
    x = target.walk_section(0, centred[:, 0])
    y = target.walk_section(1, centred[:, 1])
    vertices = np.column_stack([x, y, target.evaluate_height(x, y)])
    # Lengths are those of the surface itself: a smooth shell is not bent from a plane.
    points = _fill_panels(sheet, target, centred, vertices)
    return Shape(vertices, vertices, 0, True, "laid on the target surface", surface=points)


def _fill_panels(
    sheet: Sheet, target: Target, flat: np.ndarray, vertices: np.ndarray
) -> np.ndarray:
    """Return points (Y, K, 3) [m] of the target, `SURFACE_STEPS` a panel, vertices among them."""
    counts = sheet.grid.zigzag_index.max(), sheet.grid.strip_index.max()
    lines = []
    for axis, count in zip((1, 0), counts, strict=True):
        ends = flat[:, axis].min(), flat[:, axis].max()
        lines.append(target.walk_section(axis, np.linspace(*ends, SURFACE_STEPS * count + 1)))
    y, x = (values.ravel() for values in np.meshgrid(*lines, indexing="ij"))
    points = np.column_stack([x, y, target.evaluate_height(x, y)])
    points = points.reshape(len(lines[0]), len(lines[1]), 3)
    rows, columns = sheet.grid.zigzag_index, sheet.grid.strip_index
    points[SURFACE_STEPS * rows, SURFACE_STEPS * columns] = vertices
    return points


def lay_flat(sheet: Sheet, target: Target, settings: Fold) -> Shape:
    """Centre the unfolded sheet on the plan, at height 0."""
    del target, settings
    middle = 0.5 * (sheet.flat.min(axis=0) + sheet.flat.max(axis=0))
    return Shape(sheet.flat - middle, sheet.flat, 0, True, "left unfolded")


Solver = Callable[[Sheet, Target, Fold], Shape]
LAYOUTS: dict[str, Solver] = {"smooth": lay_smooth, "flat": lay_flat}
SOLVERS: dict[str, Solver] = {
    "elastic": fold_softly,
    "isometric": fold_isometrically,
    "exact": fold_exactly,
    "rigid": fold_rigidly,
}
