"""Free folding of a flat pattern: its creases turn, nothing else pulls.

Mountains and valleys choose the branch, so that no disturbance is needed: the sheet follows them
from the first small angle on, as long as its sides are not much stiffer than its creases.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.folding.exact import project_vertices
from foldshell.folding.levenberg import minimise_terms
from foldshell.folding.net import FoldNet
from foldshell.folding.normal_equations import NormalEquations
from foldshell.folding.panel_quality import count_turned
from foldshell.folding.terms import Hinge, Stretch, Term
from foldshell.pattern.angles import measure_hinges

FRACTIONS = (0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0)
STRETCHES = (100.0, 1.0)
"""Weights of the sides against creases of CREASE; the softer one where folds turned over."""
CREASE = 0.01
EXACT_BELOW = 1e-6  # tolerance below which lengths are kept exactly at the end
CLOSE = 1e-12  # strain at which lengths count as kept


@dataclass(frozen=True)
class FreeState:
    """A freely folded state (V, 3) m, its largest strain, creases that turned, iterations."""

    vertices: np.ndarray
    strain: float
    turned: int
    iterations: int


def fold_freely(
    net: FoldNet, share: float = 1.0, tolerance: float = 1e-8, begun: np.ndarray | None = None
) -> FreeState:
    """Fold a pattern from flat by `share` of its rest angles, then keep its lengths exactly.

    `tolerance` ends the last step, as a fall of the cost over itself; a fold that has `begun`
    (V, 3) m goes on from there.
    """
    best = None
    for stretch in STRETCHES:
        state = _fold(net, share, stretch, tolerance, begun)
        if best is None or state.turned < best.turned:
            best = state
        if not best.turned:
            break
    return best


def _fold(
    net: FoldNet, share: float, stretch: float, tolerance: float, begun: np.ndarray | None
) -> FreeState:
    vertices, iterations, equations = net.flat if begun is None else begun, 0, None
    size = float(np.ptp(net.flat, axis=0).max())
    lengths = Stretch(net.facets.edges, net.lengths, 1.0)
    for part in FRACTIONS if begun is None else FRACTIONS[-1:]:
        last = part == FRACTIONS[-1]
        terms = list_free_terms(net, part * share * net.rest, stretch)
        equations = equations or NormalEquations([t.columns for t in terms], vertices.size)
        minimum = minimise_terms(
            terms, vertices, max_iterations=200 if last else 30, equations=equations,
            cost_tolerance=tolerance if last else 1e-2, step_tolerance=1e-14 * size,
        )  # fmt: skip
        vertices, iterations = minimum.vertices, iterations + minimum.iterations
    if tolerance < EXACT_BELOW:
        kept = project_vertices([lengths], vertices)
        iterations += kept.iterations
        vertices = kept.vertices if kept.residual <= CLOSE else vertices
    strain = float(np.abs(lengths.evaluate(vertices)[0]).max())
    turned = count_turned(measure_hinges(vertices, net.hinges.vertices), net.letters)
    return FreeState(vertices, strain, turned, iterations)


def list_free_terms(net: FoldNet, angles: np.ndarray, stretch: float) -> list[Term]:
    """Sides that keep their length, hinges that turn to `angles` (H,) rad, panels that stay."""
    hinges, crease = net.hinges.vertices, net.creases
    return [
        Stretch(net.facets.edges, net.lengths, stretch),
        Hinge(hinges[crease], angles[crease], CREASE),
        Hinge(hinges[~crease], np.zeros((~crease).sum()), CREASE),
    ]
