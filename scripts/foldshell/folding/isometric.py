"""Isometric mode: panels bend about their neutral folds, but no edge changes its length.

What can be reached so is bending and twisting of the Miura sheet: saddles and twisted surfaces,
not domes or cylinders (Schenk and Guest, PNAS 110 (2013) 3276).
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from foldshell.folding.constraints import Fairness, find_chains, keep_folded
from foldshell.folding.exact import (
    FOLD_MARGIN,
    Solution,
    allow_rounding,
    measure_residual,
    project_vertices,
)
from foldshell.folding.intersections import find_intersections
from foldshell.folding.levenberg import Minimum, minimise_terms
from foldshell.folding.normal_equations import NormalEquations
from foldshell.folding.placement import round_as_written
from foldshell.folding.problem import (
    STEEP,
    attracted_vertices,
    build_terms,
    edge_lengths,
    reference_length,
)
from foldshell.folding.quality import (
    count_flipped,
    measure_coverage,
    measure_start_coverage,
    root_mean_square,
)
from foldshell.folding.shape import Shape
from foldshell.folding.terms import Stretch, Target, Term, measure_distances
from foldshell.pattern.angles import measure_folds
from foldshell.pattern.miura import size_miura
from foldshell.pattern.sheet import Sheet, make_miura_sheet
from foldshell.settings.fold import Fold, FoldWeights

STRAIN = 1e-12
# (stretch, attraction, share of the bending weights, fairness): from the unstretched planar
# state, first pulled gently, then hardened.
STAGES = (
    (1e2, 0.01, 1.0, 0.0), (1e2, 0.1, 1.0, 0.0), (1e3, 1.0, 1.0, 0.0), (1e4, 10.0, 1.0, 0.0),
    (1e5, 10.0, 1.0, 0.0), (1e6, 10.0, 1.0, 0.0), (1e8, 10.0, 1.0, 0.0),
)  # fmt: skip
# On steep targets a fair sheet, without waves from panel to panel, goes further before it locks.
STEEP_STAGES = (
    (1e2, 0.01, 1.0, 1.0), (1e2, 0.1, 1.0, 1.0), (1e3, 1.0, 1.0, 1.0), (1e4, 10.0, 1.0, 1.0),
    (1e6, 10.0, 1.0, 1.0), (1e6, 200.0, 0.3, 0.1), (1e8, 200.0, 0.3, 0.01),
)  # fmt: skip
# (sector angle [deg], Poisson's ratio, share): steep targets need another sheet, since its
# ratio must vary from the middle to the edges as the target's curvatures do. It is sized so
# that, folded to that ratio, it measures this share of the target's sections. Found by trial
# on the study's own 28 m / 28 m designs: the first suits twisted surfaces, the others saddles.
STEEP_SHEETS = ((82.0, -4.0, 0.89), (76.0, -3.0, 0.93), (74.0, -5.0, 1.0), (72.0, -3.0, 0.81))
# (as above) and the change of width: the last resort on a steep twist. Its zig-zags run along an
# S, as even strips are wider than odd ones by this share at both ends, and narrower by a third
# of it in the middle. The form was read off the widths that came nearest with all of them free,
# the numbers are by trial: 28 m / 28 m, 8x32; 74 degrees and a change of 0.6 to 0.7 do as well.
SWAYED_SHEET, SWAY = (76.0, -6.0, 0.95), 0.65
# (stretch, attraction, share of the bending weights, fairness), and the weight of the folds'
# sides: held as hard as the lengths, as in the stages above, they jam the descent.
SLIDE, SLIDE_FOLDS = (1e6, 200.0, 0.0, 1e-3), 1.0
CLOSE = 6e-4  # rms distance over span at which no other sheet is tried


@dataclass(frozen=True)
class Attempt:
    """One sheet and where it led: rms distance over span; whether it kept its folds and plan."""

    sheet: Sheet
    solution: Solution
    distance: float
    crumpled: bool


def fold_isometrically(sheet: Sheet, target: Target, settings: Fold) -> Shape:
    """Bend the planar rest state towards the target, harden the lengths, project onto r = 0.

    On a steep target the sheets of `list_sheets` are tried in place of the given one, until one
    is CLOSE; of those that did not crumple the nearest is kept, and `reason` names it.
    Folds are held on their own side with the weight of the lengths, so that a target that
    cannot be reached leaves a distance rather than a crumpled sheet.
    """
    steep = target.height >= STEEP * min(target.sides)
    least = settings.limits.plan_coverage * measure_start_coverage(sheet, target, settings.attract)
    attempts: list[Attempt] = []
    for start in list_sheets(sheet, target, settings.attract) if steep else [sheet]:
        stages = STEEP_STAGES if steep else STAGES
        attempts.append(_attempt(start, target, settings, stages, least))
        if attempts[-1].distance <= CLOSE and not attempts[-1].crumpled:
            break
    allowed = STRAIN + allow_rounding(sheet, target)
    best = min(attempts, key=lambda a: (a.solution.residual > allowed, a.crumpled, a.distance))
    residuals, reason = {"constraint_residual": best.solution.residual}, best.solution.reason
    if "sector_angle_deg" in best.sheet.settings:
        angle = best.sheet.settings["sector_angle_deg"]
        residuals["start_sector_angle_deg"] = angle
        if best.sheet is not sheet:
            reason += f"; another sheet than the given one, of {angle:.0f} deg"
            if "sway" in best.sheet.settings:
                reason += ", its strips of unequal width"
            reason += f", the best of {len(attempts)} tried"
    return Shape(
        best.solution.vertices, best.sheet.flat, sum(a.solution.iterations for a in attempts),
        best.solution.residual <= allowed, reason, residuals,
    )  # fmt: skip


def list_sheets(sheet: Sheet, target: Target, attract: str) -> Iterator[Sheet]:
    """Yield Miura sheets of the same counts for a steep target; other patterns stay as they are.

    First those of STEEP_SHEETS; then, where the target is twisted, the swayed one.
    """
    if sheet.kind != "miura":
        yield sheet
        return
    counts = sheet.grid.zigzag_count, sheet.grid.strip_count
    for steep in STEEP_SHEETS:
        yield _make_steep_sheet(target, counts, *steep)
    twist = measure_twist(target)
    if abs(twist) > 0.5:
        sway = math.copysign(SWAY, twist if attract == "lowest" else -twist)
        swayed = _make_steep_sheet(target, counts, *SWAYED_SHEET, sway_widths(counts[1], sway))
        yield replace(swayed, settings={**swayed.settings, "sway": sway})


def measure_twist(target: Target) -> float:
    """Rise of one diagonal's corners over the other's, over the height: 1 on a pure twist.

    Positive where the corners at x = y are the high ones.
    """
    half = np.array(target.sides)[:, None] / 2
    x, y = half * np.array([[1, -1, 1, -1], [1, -1, -1, 1]])
    return float(target.evaluate_height(x, y) @ [1, 1, -1, -1]) / (2 * target.height)


def sway_widths(strip_count: int, sway: float) -> np.ndarray:
    """Widths (strip_count - 1,) over `side_b` that bend a zig-zag's course into an S.

    1 + e and 1 - e in turn, with e = sway (4 u2 - 1) / 3 for u from -1 to 1 along the zig-zag:
    its mean slope is e / tan(sector angle).

    Without unit.
    """
    place = np.linspace(-1.0, 1.0, strip_count - 1)
    sign = np.where(np.arange(strip_count - 1) % 2 == 0, 1.0, -1.0)
    return 1 + sign * sway * (4 * place**2 - 1) / 3


def _make_steep_sheet(
    target: Target,
    counts: tuple[int, int],
    angle: float,
    poisson: float,
    share: float,
    widths: np.ndarray | None = None,
) -> Sheet:
    lengths = [share * length for length in target.section_lengths()]
    pattern = size_miura(*lengths, math.radians(angle), *counts, poisson)
    return make_miura_sheet(pattern, 0, poisson, widths)


def _attempt(
    sheet: Sheet,
    target: Target,
    settings: Fold,
    stages: tuple[tuple[float, ...], ...],
    least: float,
) -> Attempt:
    listed = (_stage_terms(sheet, target, settings, *stage) for stage in stages)
    vertices, iterations = bend_by_stages(listed, _lay_planar(sheet, target), settings, target.span)
    if "sway" in sheet.settings:
        minimum = _slide(sheet, target, settings, vertices)
        vertices, iterations = minimum.vertices, iterations + minimum.iterations
    lengths = Stretch(sheet.grid.edges, edge_lengths(sheet.flat, sheet.grid.edges), 1.0)
    projected, relaxed = project_lengths(lengths, vertices)
    iterations += relaxed
    written = round_as_written(projected.vertices, target)
    residual = measure_residual([lengths], written)
    iterations += projected.iterations
    solution = Solution(written, residual, iterations, f"edge lengths kept to {residual:.1e}")
    points = solution.vertices[attracted_vertices(sheet, settings.attract)]
    distance = root_mean_square(measure_distances(points, target)) / target.span
    return Attempt(sheet, solution, distance, _is_crumpled(solution.vertices, sheet, target, least))


def bend_by_stages(
    stages: Iterable[list[Term]], vertices: np.ndarray, settings: Fold, span: float
) -> tuple[np.ndarray, int]:
    """Minimise the terms of one stage after the other, each from where the last one ended.

    Returns vertices (V, 3) m and the iterations of all; `span` in m scales the least step. The
    terms of all stages have the same columns.
    """
    iterations, equations = 0, None
    for terms in stages:
        equations = equations or NormalEquations([t.columns for t in terms], vertices.size)
        minimum = minimise_terms(
            terms, vertices, max_iterations=settings.max_iterations,
            cost_tolerance=settings.tolerance, step_tolerance=1e-9 * span,
            equations=equations,
        )  # fmt: skip
        vertices, iterations = minimum.vertices, iterations + minimum.iterations
    return vertices, iterations


def project_lengths(lengths: Stretch, vertices: np.ndarray) -> tuple[Solution, int]:
    """Project vertices (V, 3) m onto edge lengths; those that were pulled too far relax before.

    Returns the projection and the iterations of relaxing alone.
    """
    projected = project_vertices([lengths], vertices)
    if projected.residual <= STRAIN:
        return projected, 0
    relaxed = minimise_terms(
        [lengths], vertices, max_iterations=500, cost_tolerance=0.0, step_tolerance=1e-9
    )
    return project_vertices([lengths], relaxed.vertices), relaxed.iterations


def _slide(sheet: Sheet, target: Target, settings: Fold, vertices: np.ndarray) -> Minimum:
    """Come nearer to the target without leaving the rest lengths.

    Each step (V, 3) is along the lengths to first order, then projected back onto them. Stages
    that only weigh the lengths creep along that curved valley and stop far from its end.
    """
    lengths = Stretch(sheet.grid.edges, edge_lengths(sheet.flat, sheet.grid.edges), 1.0)
    terms = _stage_terms(sheet, target, settings, *SLIDE, SLIDE_FOLDS)
    return minimise_terms(
        terms, vertices, max_iterations=settings.max_iterations,
        cost_tolerance=settings.tolerance, step_tolerance=1e-9 * target.span,
        damping=1e-2 / SLIDE[0],  # on the diagonal, where the lengths' weight outdoes all else
        retract=lambda trial: project_vertices([lengths], trial).vertices,
    )  # fmt: skip


def _is_crumpled(vertices: np.ndarray, sheet: Sheet, target: Target, least: float) -> bool:
    """Tell whether folds turned over, the sheet cuts itself, or covers too little of the plan."""
    grid = sheet.grid
    return (
        count_flipped(measure_folds(vertices, grid), grid) > 0
        or measure_coverage(vertices, grid.facets, target.sides) < least
        or len(find_intersections(vertices, grid.facets)) > 0
    )


def _lay_planar(sheet: Sheet, target: Target) -> np.ndarray:
    """Rest state, centred on the plan at the mean height of the target."""
    centred = sheet.placement - 0.5 * (sheet.placement.min(axis=0) + sheet.placement.max(axis=0))
    inside = np.clip(centred[:, :2], -np.array(target.sides) / 2, np.array(target.sides) / 2)
    height = target.evaluate_height(*inside.T).mean()
    return centred + np.array([0.0, 0.0, height])


def _stage_terms(
    sheet: Sheet,
    target: Target,
    settings: Fold,
    stretch: float,
    attraction: float,
    bending: float,
    fairness: float,
    folds: float = 0.0,
) -> list[Term]:
    """Terms of one stage; folds are held to their side with the weight `folds`, or the lengths'."""
    given = settings.weights
    weights = FoldWeights(
        stretch=stretch,
        hinge=bending * given.hinge,
        hinge_steep=bending * given.hinge,
        neutral_fold=bending * given.neutral_fold,
        neutral_fold_steep=bending * given.neutral_fold,
        attraction=attraction,
        plan_edge=given.plan_edge,
        plan_edge_steep=given.plan_edge,
    )
    terms = build_terms(sheet, target, settings.attract, weights)
    chains = find_chains(sheet.grid)
    if fairness and len(chains):
        terms.append(Fairness(chains, reference_length(sheet), fairness))
    return [*terms, keep_folded(sheet.grid, FOLD_MARGIN, folds or stretch)]
