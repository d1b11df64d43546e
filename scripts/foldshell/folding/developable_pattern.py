"""Drive exact and rigid modes: choose a start, solve, unfold, refold, accept or try again."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from foldshell.folding.exact import ACCEPTED, Solution, allow_rounding, solve_exactly
from foldshell.folding.intersections import find_intersections
from foldshell.folding.placement import measure_rounding
from foldshell.folding.quality import count_flipped, find_convex
from foldshell.folding.shape import Shape
from foldshell.folding.soft import fold_softly
from foldshell.folding.terms import Target
from foldshell.pattern.angles import measure_folds
from foldshell.pattern.miura import size_miura
from foldshell.pattern.sheet import Sheet, make_miura_sheet
from foldshell.pattern.unfold import Assembly, find_overlap, follow_path, unfold_panels
from foldshell.settings.fold import ExactWeights, Fold

CLOSURE_ROUNDING = 1e4  # steps of the written coordinates that a closure may be off by
OTHER_ANGLES_DEG = (70.0, 65.0, 75.0)  # starts to try when the given sector angle fails
REFOLDED = 1e-10  # gap [m] between panels anywhere on the rigid path
FIRM_MARGIN = 30.0  # times the weight that keeps corners convex, when nothing else helped
PATH_PARTS = np.linspace(0.0, 1.0, 21)


@dataclass(frozen=True)
class Attempt:
    """One start and where it led; `faults` is empty when it is true origami.

    `unfolded` is the sheet in the plane, None where the constraints are not met.
    """

    sheet: Sheet
    solution: Solution
    iterations: int
    unfolded: Assembly | None
    faults: tuple[str, ...]


def fold_exactly(sheet: Sheet, target: Target, settings: Fold) -> Shape:
    """Exact mode: attracted vertices on the target, planar panels, developable."""
    return _fold_truly(sheet, target, settings, rigid=False)


def fold_rigidly(sheet: Sheet, target: Target, settings: Fold) -> Shape:
    """Rigid mode: planar, developable and flat-foldable; as near the target as that allows."""
    return _fold_truly(sheet, target, settings, rigid=True)


def _fold_truly(sheet: Sheet, target: Target, settings: Fold, rigid: bool) -> Shape:
    attempts = []
    firm = replace(settings.exact, margin=FIRM_MARGIN * settings.exact.margin)
    tries = [(start, settings.exact) for start in list_starts(sheet, target)]
    tries += [(start, firm) for start, _ in tries[:2]]
    for start, weights in tries:
        attempts.append(_attempt(start, target, settings, weights, rigid))
        if not attempts[-1].faults:
            break
    best = min(attempts, key=lambda a: (bool(a.faults), a.solution.residual))
    return _finish(best, attempts, rigid, measure_rounding(target))


def list_starts(sheet: Sheet, target: Target) -> Iterator[Sheet]:
    """Yield the sheet itself, then Miura sheets of the same counts with other sector angles.

    The pattern is unknown in these modes, so the sheet is only where the search begins.
    """
    yield sheet
    if sheet.kind != "miura":
        return
    given = sheet.settings.get("sector_angle_deg", 0.0)
    for angle in OTHER_ANGLES_DEG:
        if abs(angle - given) > 2.0:
            lengths = target.section_lengths()
            grid = sheet.grid
            yield make_miura_sheet(
                size_miura(*lengths, math.radians(angle), grid.zigzag_count, grid.strip_count), 0
            )


def _attempt(
    sheet: Sheet, target: Target, settings: Fold, weights: ExactWeights, rigid: bool
) -> Attempt:
    soft = fold_softly(sheet, target, settings)
    solution = solve_exactly(sheet, target, settings.attract, soft.vertices, weights, rigid)
    iterations = soft.iterations + solution.iterations
    if not solution.residual <= ACCEPTED + allow_rounding(sheet, target):
        return Attempt(sheet, solution, iterations, None, (solution.reason,))
    unfolded = unfold_panels(solution.vertices, sheet.grid)
    closure = ACCEPTED + CLOSURE_ROUNDING * measure_rounding(target)
    faults = tuple(find_faults(solution.vertices, sheet, unfolded, closure))
    return Attempt(sheet, solution, iterations, unfolded, faults)


def find_faults(
    vertices: np.ndarray, sheet: Sheet, unfolded: Assembly, closure: float
) -> Iterator[str]:
    """Say what keeps a shape of met constraints from being true origami.

    `closure` [m] is how far the copies of a vertex may lie apart in the unfolded sheet.

    vertices (V, 3) m.
    """
    grid = sheet.grid
    if not unfolded.closure <= closure:
        yield f"panels part by {unfolded.closure:.1e} m when the sheet is unfolded"
    bent = int((~find_convex(vertices, grid.quads)).sum())
    if bent:
        yield f"{bent} panels not convex"
    flipped = count_flipped(measure_folds(vertices, grid), grid)
    if flipped:
        yield f"{flipped} folds turned over"
    if not (bent or flipped) and len(find_intersections(vertices, grid.facets)):
        yield "the sheet cuts itself"
    if find_overlap(unfolded.vertices, grid):
        yield "the unfolded pattern overlaps itself"


def _finish(attempt: Attempt, attempts: list[Attempt], rigid: bool, rounding: float) -> Shape:
    sheet, vertices = attempt.sheet, attempt.solution.vertices
    residuals: dict[str, float] = {"constraint_residual": attempt.solution.residual}
    if "sector_angle_deg" in sheet.settings:
        residuals["start_sector_angle_deg"] = sheet.settings["sector_angle_deg"]
    iterations = sum(a.iterations for a in attempts)
    unfolded, faults = attempt.unfolded, list(attempt.faults)
    if unfolded is None:
        return Shape(vertices, sheet.flat, iterations, False, "; ".join(faults), residuals)
    residuals["unfold_closure_m"] = unfolded.closure
    if rigid:
        states, closure = follow_path(vertices, unfolded.vertices, sheet.grid, PATH_PARTS)
        cuts = sum(len(find_intersections(state, sheet.grid.facets)) for state in states[1::4])
        residuals["path_intersections"] = cuts
        residuals["refold_closure_m"] = closure
        if not closure <= REFOLDED + CLOSURE_ROUNDING * rounding:
            faults.append(f"panels part by {closure:.1e} m on the folding path")
        if cuts:
            faults.append("the sheet cuts itself on the folding path")
    reason = "; ".join(faults) or attempt.solution.reason
    return Shape(vertices, unfolded.vertices, iterations, not faults, reason, residuals)
