"""Elastic mode: soft springs, as a physics engine would have it."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from foldshell.folding.levenberg import Minimum, minimise_terms
from foldshell.folding.placement import round_as_written
from foldshell.folding.problem import build_terms, place_sheet
from foldshell.folding.projections import average_projections
from foldshell.folding.shape import Shape
from foldshell.folding.terms import Target, Term
from foldshell.pattern.sheet import Sheet
from foldshell.settings.fold import Fold

# Averaged projections creep: many more iterations, judged over a window of them.
EXPLICIT_ITERATIONS, EXPLICIT_TOLERANCE = 50, 10.0
SETTLED = 1e-2  # last fall of the cost, of itself, from which the shape hardly changes any more

SHORTENED_FROM = 10_000
"""Unknowns from which on a factorisation is dear beside a look at a shorter step."""


def fold_softly(sheet: Sheet, target: Target, settings: Fold) -> Shape:
    """Elastic mode: minimise the weighted squares of stretch, hinges, attraction, plan edge."""
    terms = build_terms(sheet, target, settings.attract, settings.weights)
    start = place_sheet(sheet, target, settings.attract)
    minimum = minimise_softly(terms, start, settings, target.span)
    vertices = round_as_written(minimum.vertices, target)
    settled = minimum.converged or minimum.fall <= SETTLED
    return Shape(
        vertices, sheet.flat, minimum.iterations, settled, minimum.reason,
        {"cost": minimum.cost},
    )  # fmt: skip


def minimise_softly(
    terms: Sequence[Term], start: np.ndarray, settings: Fold, span: float
) -> Minimum:
    """argmin over vertices (V, 3) of 1/2 sum r2 by the engine of the settings, from `start`.

    Vertices in m.
    """
    explicit = settings.engine == "averaged_projections"
    minimise = average_projections
    if not explicit:
        minimise = partial(minimise_terms, shorten=start.size >= SHORTENED_FROM)
    return minimise(
        terms,
        start,
        max_iterations=settings.max_iterations * (EXPLICIT_ITERATIONS if explicit else 1),
        cost_tolerance=settings.tolerance * (EXPLICIT_TOLERANCE if explicit else 1.0),
        step_tolerance=1e-9 * span,
    )
