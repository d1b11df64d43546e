"""Elastic mode of any crease pattern: soft springs from a planar rest state, or from flat on.

A pattern that folds into a plane, as a Miura sheet does, is folded first and then laid on the
target. One that curls by itself would have to be bent back so: it is laid flat on the target's
middle, and both its folds and the pull to the target grow together.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.folding.free_fold import fold_freely
from foldshell.folding.levenberg import minimise_terms
from foldshell.folding.net import FoldNet
from foldshell.folding.panel_problem import (
    CURLED,
    build_net_terms,
    choose_attracted,
    lay_planar,
    lay_rest,
    lay_tangent,
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
"""Of shut, to which folds turn that the pattern gives no angle for, until the target says more."""
ROUNDS = 2
PROBE = 0.15
"""Of shut, at which a pattern without angles is looked at: which vertices are low, does it curl."""


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
    free = fold_freely(net, 1.0 if net.given else PROBE, 1e-16)
    shape = lay_rest(net, free.vertices)
    attracted = choose_attracted(net, shape, attract)
    shape = lay_rest(net, free.vertices, attracted)
    curls = not net.given or measure_curl(shape[attracted]) > CURLED
    rest = net.rest if net.given else FIRST_FOLD * net.rest
    if curls:
        vertices = lay_tangent(net.flat, target)
        return Start(attracted, vertices[:, :2], vertices, rest, True)
    vertices = place_on_target(shape, attracted, target)
    return Start(attracted, shape[:, :2], vertices, rest, False, lay_planar(shape, target))


def fold_net_softly(net: FoldNet, start: Start, target: Target, settings: Fold) -> Shape:
    """Minimise the weighted squares of stretch, hinges, attraction, plan edges."""
    if start.curls:
        return _fold_from_flat(net, start, target, settings)
    terms = build_net_terms(
        net, target, start.attracted, start.plan, start.rest, settings.weights
    )
    minimum = minimise_softly(terms, start.vertices, settings, target.span)
    settled = minimum.converged or minimum.fall <= SETTLED
    return Shape(minimum.vertices, net.flat, minimum.iterations, settled, minimum.reason,
                 {"cost": minimum.cost})  # fmt: skip


def _fold_from_flat(net: FoldNet, start: Start, target: Target, settings: Fold) -> Shape:
    vertices, rest, iterations = start.vertices, start.rest, 0
    for number in range(1 if net.given else ROUNDS):
        steps = STEPS if number == 0 else STEPS[-1:]
        for share, attraction in steps:
            weights = settings.weights.changed(
                attraction=attraction * settings.weights.attraction / STEPS[-1][1]
            )
            terms = build_net_terms(
                net, target, start.attracted, start.plan, share * rest, weights
            )
            last = share == 1.0
            minimum = minimise_terms(
                terms, vertices, max_iterations=settings.max_iterations,
                cost_tolerance=settings.tolerance if last else 1e-2,
                step_tolerance=1e-9 * target.span,
            )  # fmt: skip
            vertices, iterations = minimum.vertices, iterations + minimum.iterations
        if not net.given:  # take the folds that the target asks for on the mean
            folds = net.directions * measure_hinges(vertices, net.hinges.vertices)
            mean = float(np.clip(folds[net.creases], 0.02, np.pi).mean())
            rest = mean * net.directions
    settled = minimum.converged or minimum.fall <= SETTLED
    return Shape(vertices, net.flat, iterations, settled, minimum.reason, {"cost": minimum.cost})


