"""Isometric mode: panels bend about their neutral folds, but no edge changes its length.

What can be reached so is bending and twisting of the Miura sheet: saddles and twisted surfaces,
not domes or cylinders (Schenk and Guest, PNAS 110 (2013) 3276).
"""

import numpy as np

from foldshell.folding.constraints import keep_folded
from foldshell.folding.exact import FOLD_MARGIN, project_vertices
from foldshell.folding.levenberg import minimise_terms
from foldshell.folding.normal_equations import NormalEquations
from foldshell.folding.problem import Weights, build_terms, edge_lengths
from foldshell.folding.settings import FoldSettings
from foldshell.folding.shape import Shape
from foldshell.folding.terms import Stretch, Target, Term
from foldshell.pattern.sheet import Sheet

STRAIN = 1e-12
# (stretch, attraction): from the unstretched planar state, first pulled gently, then hardened.
STAGES = ((1e2, 0.01), (1e2, 0.1), (1e3, 1.0), (1e4, 10.0), (1e5, 10.0), (1e6, 10.0), (1e8, 10.0))


def fold_isometrically(sheet: Sheet, target: Target, settings: FoldSettings) -> Shape:
    """Bend the planar rest state towards the target, harden the lengths, project onto r = 0.

    Folds are held on their own side with the weight of the lengths, so that a target that
    cannot be reached leaves a distance rather than a crumpled sheet.
    """
    vertices, iterations, equations = _lay_planar(sheet, target), 0, None
    for stretch, attraction in STAGES:
        terms = _stage_terms(sheet, target, settings, stretch, attraction)
        equations = equations or NormalEquations([t.columns for t in terms], vertices.size)
        minimum = minimise_terms(
            terms, vertices, max_iterations=settings.max_iterations,
            cost_tolerance=settings.tolerance, step_tolerance=1e-9 * target.span,
            equations=equations,
        )  # fmt: skip
        vertices, iterations = minimum.vertices, iterations + minimum.iterations
    lengths = Stretch(sheet.grid.edges, edge_lengths(sheet.flat, sheet.grid.edges), 1.0)
    projected = project_vertices([lengths], vertices)
    return Shape(
        projected.vertices, sheet.flat, iterations + projected.iterations,
        projected.residual <= STRAIN, f"edge lengths kept to {projected.residual:.1e}",
        {"constraint_residual": projected.residual},
    )  # fmt: skip


def _lay_planar(sheet: Sheet, target: Target) -> np.ndarray:
    """Rest state, centred on the plan at the mean height of the target."""
    centred = sheet.placement - 0.5 * (sheet.placement.min(axis=0) + sheet.placement.max(axis=0))
    inside = np.clip(centred[:, :2], -target.span / 2, target.span / 2)
    height = target.evaluate_height(*inside.T).mean()
    return centred + np.array([0.0, 0.0, height])


def _stage_terms(
    sheet: Sheet, target: Target, settings: FoldSettings, stretch: float, attraction: float
) -> list[Term]:
    given = settings.weights
    weights = Weights(
        stretch=stretch,
        hinge=given.hinge,
        hinge_steep=given.hinge,
        neutral_fold=given.neutral_fold,
        neutral_fold_steep=given.neutral_fold,
        attraction=attraction,
        plan_edge=given.plan_edge,
        plan_edge_steep=given.plan_edge,
    )
    terms = build_terms(sheet, target, settings.attract, weights)
    return [*terms, keep_folded(sheet.grid, FOLD_MARGIN, stretch)]
