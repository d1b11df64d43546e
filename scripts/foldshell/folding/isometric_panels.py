"""Isometric mode of any crease pattern: no edge changes its length, panels bend across."""

import numpy as np

from foldshell.folding.constraints import Fairness
from foldshell.folding.exact import measure_residual
from foldshell.folding.exact_panels import hold_folded
from foldshell.folding.isometric import STAGES, STRAIN, bend_by_stages, project_lengths
from foldshell.folding.net import FoldNet
from foldshell.folding.panel_problem import build_net_terms
from foldshell.folding.placement import measure_rounding, round_as_written
from foldshell.folding.shape import Shape
from foldshell.folding.soft_panels import Start
from foldshell.folding.terms import Stretch, Target, Term
from foldshell.settings.fold import Fold


def bend_net(net: FoldNet, start: Start, soft: np.ndarray, target: Target, settings: Fold) -> Shape:
    """Bend a net towards its target, harden the lengths, project onto them.

    A net that folds to a plane begins there; one that curls by itself with its soft shape (V, 3) m.
    """
    stages = (_list_stage(net, start, target, settings, stage) for stage in STAGES)
    vertices = soft if start.curls else start.level
    vertices, iterations = bend_by_stages(stages, vertices, settings, target.span)
    lengths = Stretch(net.facets.edges, net.lengths, 1.0)
    projected, relaxed = project_lengths(lengths, vertices)
    iterations += relaxed
    written = round_as_written(projected.vertices, target)
    residual = measure_residual([lengths], written)
    allowed = STRAIN + 64 * measure_rounding(target) / net.reference
    reason = f"edge lengths kept to {residual:.1e}"
    iterations += projected.iterations
    measured = {"constraint_residual": residual}
    return Shape(written, net.flat, iterations, residual <= allowed, reason, measured)


def _list_stage(
    net: FoldNet, start: Start, target: Target, settings: Fold, stage: tuple[float, ...]
) -> list[Term]:
    """Terms of one stage: weights of stretch and attraction, share of bending, fairness."""
    stretch, attraction, bending, fairness = stage
    given = settings.weights
    weights = given.changed(
        stretch=stretch, hinge=bending * given.hinge, hinge_steep=bending * given.hinge,
        neutral_fold=bending * given.neutral_fold, neutral_fold_steep=bending * given.neutral_fold,
        attraction=attraction, plan_edge_steep=given.plan_edge,
    )  # fmt: skip
    terms = build_net_terms(net, target, start.attracted, start.plan, start.rest, weights)
    if fairness and len(net.chains):
        terms.append(Fairness(net.chains, net.reference, fairness))
    return [*terms, hold_folded(net, stretch)]
