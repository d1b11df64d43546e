"""Paper mode: soft springs, as a physics engine would have it."""

from foldshell.folding.levenberg import minimise_terms
from foldshell.folding.problem import build_terms, place_sheet
from foldshell.folding.settings import FoldSettings
from foldshell.folding.shape import Shape
from foldshell.pattern.sheet import Sheet


def fold_softly(sheet: Sheet, target, settings: FoldSettings) -> Shape:
    """Paper mode: minimise the weighted squares of stretch, hinges, attraction, plan edge."""
    terms = build_terms(sheet, target, settings.attract, settings.weights)
    minimum = minimise_terms(
        terms,
        place_sheet(sheet, target, settings.attract),
        max_iterations=settings.max_iterations,
        cost_tolerance=settings.tolerance,
        step_tolerance=1e-9 * target.span,
    )
    return Shape(
        minimum.vertices, sheet.flat, minimum.iterations, minimum.converged, minimum.reason,
        {"cost": minimum.cost},
    )  # fmt: skip
