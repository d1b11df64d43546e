"""Exact and rigid modes: the crease pattern is unknown too, and true origami is demanded.

Constraints are planar panels and developable vertices; in exact mode the attracted vertices on
the target; in rigid mode Kawasaki's condition instead, which leaves one freedom of rigid folding
(Tachi, J. IASS 50 (2009) 173), while the target is only approached. After Dudte et al. (2016).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from foldshell.folding.constraints import (
    Fairness,
    find_chains,
    keep_convex,
    keep_folded,
    require_developable,
    require_flat_foldable,
    require_planar,
)
from foldshell.folding.levenberg import minimise_terms
from foldshell.folding.normal_equations import NormalEquations, NotPositiveDefinite
from foldshell.folding.placement import measure_rounding, round_as_written
from foldshell.folding.problem import (
    attracted_vertices,
    build_terms,
    reference_length,
)
from foldshell.folding.terms import Attraction, Target, Term
from foldshell.pattern.sheet import Sheet
from foldshell.settings.fold import ExactWeights, FoldWeights

TOLERANCE = 1e-12  # of the constraints, non-dimensional, at which no further step is needed
ACCEPTED = 1e-9  # constraint residual and closures of true origami
ROUNDING = 64  # steps of the written coordinates that a residual may be off by
CORNER_MARGIN, FOLD_MARGIN = math.radians(8), math.radians(5)


@dataclass(frozen=True)
class Solution:
    """Vertices (V, 3) [m], the largest constraint residual, iterations, reason."""

    vertices: np.ndarray
    residual: float
    iterations: int
    reason: str


def solve_exactly(
    sheet: Sheet,
    target: Target,
    attract: str,
    start: np.ndarray,
    weights: ExactWeights,
    rigid: bool,
) -> Solution:
    """Tighten the constraints from a soft start, then project onto them.

    Their weight grows tenfold per stage, 1 to 1e4 (1e7 in rigid mode, where the target pulls
    against them); each stage starts from the last and shares one symbolic factorisation.

    start (V, 3) m.
    """
    # In rigid mode the target is only a pull, so its minimum is worth finding more closely.
    tolerance = 1e-3 if rigid else 1e-2
    soft = _soft_terms(sheet, target, attract, weights, rigid)
    vertices, iterations, equations = start, 0, None
    for power in range(8 if rigid else 5):
        terms = [*soft, *_constraints(sheet, target, attract, 10.0**power, rigid)]
        equations = equations or NormalEquations([t.columns for t in terms], start.size)
        minimum = minimise_terms(
            terms, vertices, max_iterations=40, cost_tolerance=tolerance,
            step_tolerance=1e-9 * target.span, equations=equations,
        )  # fmt: skip
        vertices, iterations = minimum.vertices, iterations + minimum.iterations
    constraints = _constraints(sheet, target, attract, 1.0, rigid)
    projected = project_vertices(constraints, vertices)
    written = round_as_written(projected.vertices, target)
    residual = measure_residual(constraints, written)
    reason = describe_residual(residual, ACCEPTED + allow_rounding(sheet, target))
    return Solution(written, residual, iterations + projected.iterations, reason)


def measure_residual(constraints: Sequence[Term], vertices: np.ndarray) -> float:
    """max |r| over all constraints at vertices (V, 3). Vertices in m, the residual without unit."""
    return max(float(np.abs(term.evaluate(vertices)[0]).max()) for term in constraints)


def allow_rounding(sheet: Sheet, target: Target) -> float:
    """What writing the coordinates can add to a non-dimensional residual."""
    return ROUNDING * measure_rounding(target) / reference_length(sheet)


def describe_residual(residual: float, allowed: float) -> str:
    """Say how far the constraints are met."""
    met = residual <= allowed
    return f"constraints {'met to' if met else 'left at'} {residual:.1e}"


def project_vertices(
    constraints: Sequence[Term], start: np.ndarray, max_iterations: int = 30
) -> Solution:
    """Gauss-Newton steps of least norm onto r = 0, until r <= TOLERANCE and falls no further.

    (J^T J + e I) dx = -J^T r with a tiny e: dependent constraints do no harm, and each step's
    error is taken up by the next. What is returned is the state of the least residual, and that
    residual, whether or not it is small.

    start (V, 3) m.
    """
    equations = NormalEquations([term.columns for term in constraints], start.size)
    vertices, best, least, iteration = start, start, np.inf, 0
    while iteration < max_iterations:
        iteration += 1
        rows = [term.evaluate(vertices) for term in constraints]
        residual = max(float(np.abs(r).max()) for r, _ in rows)
        settled = least <= TOLERANCE and residual > 0.5 * least
        if residual < least:
            best, least = vertices, residual
        if settled or not residual <= 1e3 * least:
            break
        matrix, gradient = equations.assemble(rows)
        shift = np.full(start.size, 1e-12 * equations.diagonal(matrix).max())
        try:
            vertices = vertices + equations.solve(matrix, shift, -gradient).reshape(-1, 3)
        except NotPositiveDefinite:
            break
    return Solution(best, least, iteration, describe_residual(least, ACCEPTED))


def _constraints(
    sheet: Sheet, target: Target, attract: str, weight: float, rigid: bool
) -> list[Term]:
    ell = reference_length(sheet)
    if rigid:
        last: Term = require_flat_foldable(sheet.grid, weight)
    else:
        last = Attraction(attracted_vertices(sheet, attract), target, ell, weight)
    return [
        require_planar(sheet.grid, sheet.rest, ell, weight),
        require_developable(sheet.grid, weight),
        last,
    ]


def _soft_terms(
    sheet: Sheet, target: Target, attract: str, weights: ExactWeights, rigid: bool
) -> list[Term]:
    alike = FoldWeights(
        stretch=weights.stretch,
        hinge=weights.hinge,
        hinge_steep=weights.hinge,
        neutral_fold=weights.neutral_fold,
        neutral_fold_steep=weights.neutral_fold,
        attraction=weights.attraction,
        plan_edge=weights.plan_edge,
        plan_edge_steep=weights.plan_edge,
    )
    stretch, creases, neutral, attraction, edges = build_terms(sheet, target, attract, alike)
    terms: list[Term] = [stretch, creases, neutral, edges]
    chains = find_chains(sheet.grid)
    if len(chains):
        terms.append(Fairness(chains, reference_length(sheet), weights.fairness))
    terms.append(keep_convex(sheet.grid, CORNER_MARGIN, weights.margin))
    terms.append(keep_folded(sheet.grid, FOLD_MARGIN, weights.margin))
    return [*terms, attraction] if rigid else terms
