"""Elastic mode of any crease pattern: soft springs from a planar rest state, or from flat on.

A pattern that folds into a plane, as a Miura sheet does, is folded first and then laid on the
target. One that curls by itself would have to be bent back so: it is draped over the target
unfolded, as arc lengths of its central sections, and its folds grow there.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.folding.free_fold import fold_freely
from foldshell.folding.levenberg import minimise_terms
from foldshell.folding.net import FoldNet
from foldshell.folding.panel_problem import (
    CURLED,
    FREE_BORDER,
    align_plan,
    build_net_terms,
    choose_attracted,
    lay_planar,
    lay_rest,
    measure_curl,
    place_on_target,
)
from foldshell.folding.shape import Shape
from foldshell.folding.soft import SETTLED, minimise_softly
from foldshell.folding.terms import Target
from foldshell.pattern.angles import measure_hinges
from foldshell.settings.fold import Fold

STEPS = ((0.2, 0.01), (0.4, 0.1), (0.6, 1.0), (0.8, 10.0), (1.0, 100.0))
"""Share of the folds and weight of the attraction, over a curling pattern's way to its target."""
FIRST_FOLD = 0.3
"""Of shut, to which folds are asked to turn where the pattern gives no angles: what they come to is
where its folds are at rest, until the target says more."""
ROUNDS = 2
PROBED = 1e-4  # fall of the cost at which a first look at the freely folded sheet ends


@dataclass(frozen=True)
class Start:
    """How a net begins: rows that are attracted, its plan (V, 2) m that tells the border's sides,
    vertices (V, 3) m on the target, the rest angles (H,) rad, whether it curls by itself; if not,
    its planar rest state `level` (V, 3) m over the plan."""

    attracted: np.ndarray
    plan: np.ndarray
    vertices: np.ndarray
    rest: np.ndarray
    curls: bool
    level: np.ndarray | None = None


def start_net(net: FoldNet, target: Target, attract: str) -> Start:
    """Fold a net freely, see what is low and whether it curls, and lay it on the target."""
    share = 1.0 if net.given else FIRST_FOLD
    free = fold_freely(net, share, PROBED)
    shape = lay_rest(net, free.vertices)
    attracted = choose_attracted(net, shape, attract)
    curls = not net.given or measure_curl(lay_rest(net, shape, attracted)[attracted]) > CURLED
    rest = net.rest
    if not net.given:
        rest = np.where(net.creases, measure_hinges(free.vertices, net.hinges.vertices), 0.0)
    if curls:
        plan = align_plan(net.flat)
        vertices = place_on_target(plan, attracted, target)
        if FREE_BORDER in net.mesh.sets:
            plan = shape - 0.5 * (shape.min(axis=0) + shape.max(axis=0))
        return Start(attracted, plan[:, :2], vertices, rest, True)
    free = fold_freely(net, 1.0, 1e-16, free.vertices)
    shape = lay_rest(net, free.vertices, attracted)
    vertices = place_on_target(shape, attracted, target)
    return Start(attracted, shape[:, :2], vertices, rest, False, lay_planar(shape, target))


def fold_net_softly(net: FoldNet, start: Start, target: Target, settings: Fold) -> Shape:
    """Minimise the weighted squares of stretch, hinges, attraction, plan edges."""
    if start.curls:
        return _fold_from_flat(net, start, target, settings)
    terms = build_net_terms(net, target, start.attracted, start.plan, start.rest, settings.weights)
    minimum = minimise_softly(terms, start.vertices, settings, target.span)
    settled = minimum.converged or minimum.fall <= SETTLED
    return Shape(minimum.vertices, net.flat, minimum.iterations, settled, minimum.reason,
                 {"cost": minimum.cost})  # fmt: skip


def _fold_from_flat(net: FoldNet, start: Start, target: Target, settings: Fold) -> Shape:
    vertices, rest, iterations = start.vertices, start.rest, 0
    rounds = 1 if net.given or FREE_BORDER in net.mesh.sets else ROUNDS
    for number in range(rounds):
        steps = STEPS if number == 0 else STEPS[-1:]
        for share, attraction in steps:
            weights = settings.weights.changed(
                attraction=attraction * settings.weights.attraction / STEPS[-1][1]
            )
            terms = build_net_terms(net, target, start.attracted, start.plan, share * rest, weights)
            last = share == 1.0
            minimum = minimise_terms(
                terms, vertices, max_iterations=settings.max_iterations,
                cost_tolerance=settings.tolerance if last else 1e-2,
                step_tolerance=1e-9 * target.span,
            )  # fmt: skip
            vertices, iterations = minimum.vertices, iterations + minimum.iterations
        if not net.given:  # take the folds that the target asks for on the mean
            folds = measure_hinges(vertices, net.hinges.vertices)[net.creases]
            factor = float(folds @ rest[net.creases] / (rest[net.creases] ** 2).sum())
            rest = max(factor, 0.1) * rest
    settled = minimum.converged or minimum.fall <= SETTLED
    return Shape(vertices, net.flat, iterations, settled, minimum.reason, {"cost": minimum.cost})
