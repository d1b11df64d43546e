"""Exact and rigid modes of any crease pattern: true origami near the pattern that was given.

Constraints are planar panels, the angle sum about inner vertices of any degree, and the attracted
vertices on the target; in rigid mode Kawasaki's condition takes the place of the target.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from foldshell.folding.constraints import (
    CornerRange,
    Fairness,
    FoldRange,
    PlanarPanels,
    VertexAngles,
)
from foldshell.folding.exact import (
    ACCEPTED,
    CORNER_MARGIN,
    FOLD_MARGIN,
    Solution,
    describe_residual,
    measure_residual,
    project_vertices,
)
from foldshell.folding.intersections import find_intersections
from foldshell.folding.levenberg import minimise_terms
from foldshell.folding.net import FoldNet
from foldshell.folding.normal_equations import NormalEquations
from foldshell.folding.panel_problem import build_net_terms
from foldshell.folding.panel_quality import count_not_convex, count_turned
from foldshell.folding.placement import measure_rounding, round_as_written
from foldshell.folding.soft_panels import Start
from foldshell.folding.terms import Attraction, Target, Term
from foldshell.pattern.angles import measure_hinges
from foldshell.pattern.panel_graph import list_half_edges
from foldshell.pattern.unfold import Assembly
from foldshell.pattern.unfold_panels import overlaps_itself, unfold_net
from foldshell.settings.fold import ExactWeights, FoldWeights

WIDE = math.radians(27)
"""Corners stay further than this from 0 and pi at first: a shell needs facets below 155 deg."""
CLOSURE = 1e-9
"""Gap [m] of the unfolded sheet up to which it is developable."""
TRIES = {
    True: ((0.02, 0.1, 1.0, WIDE), (0.02, 0.1, 30.0, WIDE), (0.02, 0.1, 1.0, CORNER_MARGIN)),
    False: (
        (0.2, 0.0, 1.0, WIDE), (0.02, 0.1, 1.0, WIDE), (0.2, 0.0, 1.0, CORNER_MARGIN),
        (0.02, 0.0, 1.0, CORNER_MARGIN),
    ),
}  # fmt: skip
"""(stretch, fairness, weight of margins, margin of corners) that are tried in turn, for
quadrilaterals and for other panels."""

Weights = tuple[ExactWeights, float]
"""Weights of the terms and the margin of corners [rad]."""


@dataclass(frozen=True)
class NetAttempt:
    """Where one set of weights led; `faults` is empty when it is true origami."""

    solution: Solution
    iterations: int
    unfolded: Assembly | None
    faults: tuple[str, ...]


def solve_net(
    net: FoldNet, start: Start, soft: np.ndarray, target: Target, weights: ExactWeights, rigid: bool
) -> NetAttempt:
    """Try sets of weights from a soft shape (V, 3) m; return the first true one, else the best."""
    quads = bool((np.diff(net.mesh.panels.starts) == 4).all())
    attempts: list[NetAttempt] = []
    for stretch, fairness, margin, corner in TRIES[quads]:
        chosen = weights.changed(stretch=stretch, fairness=fairness, margin=margin)
        attempts.append(_attempt(net, start, soft, target, (chosen, corner), rigid))
        if not attempts[-1].faults:
            break
    best = min(attempts, key=lambda a: (bool(a.faults), a.unfolded is None, a.solution.residual))
    total = sum(attempt.iterations for attempt in attempts)
    return NetAttempt(best.solution, total, best.unfolded, best.faults)


def _attempt(
    net: FoldNet, start: Start, soft: np.ndarray, target: Target, weights: Weights, rigid: bool
) -> NetAttempt:
    solution = _tighten(net, start, soft, target, weights, rigid)
    allowed = ACCEPTED + 64 * measure_rounding(target) / net.reference
    if not solution.residual <= allowed:
        return NetAttempt(solution, solution.iterations, None, (solution.reason,))
    unfolded = unfold_net(solution.vertices, net.mesh.panels, net.flat)
    closure = CLOSURE + 1e4 * measure_rounding(target)
    faults = tuple(find_net_faults(solution.vertices, net, unfolded, closure))
    return NetAttempt(solution, solution.iterations, unfolded, faults)


def _tighten(
    net: FoldNet, start: Start, soft: np.ndarray, target: Target, weights: Weights, rigid: bool
) -> Solution:
    """Constraint weights 1 to 1e4 (1e7 in rigid mode), each from the last, then projection."""
    gentle = list_soft_terms(net, start, target, *weights, rigid)
    vertices, iterations, equations = soft, 0, None
    for power in range(8 if rigid else 5):
        terms = [*gentle, *list_constraints(net, start, target, 10.0**power, rigid)]
        equations = equations or NormalEquations([t.columns for t in terms], soft.size)
        minimum = minimise_terms(
            terms, vertices, max_iterations=40, cost_tolerance=1e-3 if rigid else 1e-2,
            step_tolerance=1e-9 * target.span, equations=equations,
        )  # fmt: skip
        vertices, iterations = minimum.vertices, iterations + minimum.iterations
    constraints = list_constraints(net, start, target, 1.0, rigid)
    projected = project_vertices(constraints, vertices)
    written = round_as_written(projected.vertices, target)
    residual = measure_residual(constraints, written)
    allowed = ACCEPTED + 64 * measure_rounding(target) / net.reference
    reason = describe_residual(residual, allowed)
    return Solution(written, residual, iterations + projected.iterations, reason)


def list_constraints(
    net: FoldNet, start: Start, target: Target, weight: float, rigid: bool
) -> list[Term]:
    """Planar panels, angle sums by degree, then the target or Kawasaki's condition."""
    found: list[Term] = list(list_planar(net, start.vertices, weight))
    for sectors in net.sectors:
        found.append(VertexAngles(sectors, (1.0,) * len(sectors), 2 * np.pi, weight))
    if not rigid:
        found.append(Attraction(start.attracted, target, net.reference, weight))
        return found
    for sectors in net.sectors:
        if len(sectors) % 2 == 0:
            found.append(VertexAngles(sectors, (1.0, -1.0) * (len(sectors) // 2), 0.0, weight))
    return found


def list_planar(net: FoldNet, vertices: np.ndarray, weight: float) -> Iterator[PlanarPanels]:
    """Yield planarity of panels: each further corner against the three of the largest area.

    The volume that makes a residual non-dimensional is twice that area times ell; of a
    quadrilateral that of its diagonals. vertices (V, 3) m.
    """
    rows, volumes = [], []
    shape = net.flat
    for panel in net.mesh.panels:
        if len(panel) < 4:
            continue
        if len(panel) == 4:
            a, b, c, d = shape[panel]
            rows.append(panel)
            volumes.append(np.linalg.norm(np.cross(c - a, d - b)))
            continue
        three, area = _choose_three(shape[panel])
        rest = [k for k in range(len(panel)) if k not in three]
        rows += [panel[[*three, k]] for k in rest]
        volumes += [2 * area] * len(rest)
    if rows:
        yield PlanarPanels(np.array(rows), np.array(volumes) * net.reference, weight)


def _choose_three(points: np.ndarray) -> tuple[tuple[int, int, int], float]:
    """The three corners of the largest area of a polygon (k, 3) m, and that area in m2."""
    count = len(points)
    rows = [(i, j, k) for i in range(count) for j in range(i + 1, count)
            for k in range(j + 1, count)]  # fmt: skip
    p = points[np.array(rows)]
    areas = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
    return rows[int(areas.argmax())], float(areas.max())


def list_soft_terms(
    net: FoldNet,
    start: Start,
    target: Target,
    weights: ExactWeights,
    corner: float,
    rigid: bool,
) -> list[Term]:
    """What shapes a true sheet where its constraints leave it free; `corner` [rad] of panels."""
    alike = FoldWeights(
        stretch=weights.stretch, hinge=weights.hinge, hinge_steep=weights.hinge,
        neutral_fold=weights.neutral_fold, neutral_fold_steep=weights.neutral_fold,
        attraction=weights.attraction, plan_edge=weights.plan_edge,
        plan_edge_steep=weights.plan_edge,
    )  # fmt: skip
    stretch, creases, neutral, attraction, edges = build_net_terms(
        net, target, start.attracted, start.plan, start.rest, alike
    )
    terms: list[Term] = [stretch, creases, neutral, edges]
    if len(net.chains) and weights.fairness:
        terms.append(Fairness(net.chains, net.reference, weights.fairness))
    terms += [hold_convex(net, corner, weights.margin), hold_folded(net, weights.margin)]
    return [*terms, attraction] if rigid else terms


def hold_convex(net: FoldNet, corner: float, weight: float) -> CornerRange:
    """Keep panel corners that are so in the flat pattern further than `corner` from 0 and pi."""
    half, _ = list_half_edges(net.mesh.panels)
    first = net.mesh.panels.starts[:-1]
    before = np.arange(-1, len(half) - 1)
    before[first] = net.mesh.panels.starts[1:] - 1
    corners = np.column_stack([half[:, 0], half[:, 1], half[before, 0]])
    one, two = (net.flat[corners[:, k], :2] - net.flat[corners[:, 0], :2] for k in (1, 2))
    turn = np.arctan2(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0], (one * two).sum(axis=1))
    inside = (turn > corner) & (turn < np.pi - corner)
    return CornerRange(corners[inside], corner, np.pi - corner, weight)


def hold_folded(net: FoldNet, weight: float) -> FoldRange:
    """Keep every mountain and valley folded its own way by FOLD_MARGIN at least."""
    crease = net.creases
    hinges, directions = net.hinges.vertices[crease], net.directions[crease]
    return FoldRange(hinges, directions, FOLD_MARGIN, np.pi - FOLD_MARGIN, weight)


def find_net_faults(
    vertices: np.ndarray, net: FoldNet, unfolded: Assembly, closure: float
) -> Iterator[str]:
    """Say what keeps a shape (V, 3) m of met constraints from being true origami.

    `closure` [m] is how far the copies of a vertex may lie apart in the unfolded sheet.
    """
    if not unfolded.closure <= closure:
        yield f"panels part by {unfolded.closure:.1e} m when the sheet is unfolded"
    bent = count_not_convex(vertices, net.mesh.panels) - count_not_convex(net.flat, net.mesh.panels)
    if bent > 0:
        yield f"{bent} panels not convex"
    flipped = count_turned(measure_hinges(vertices, net.hinges.vertices), net.letters)
    if flipped:
        yield f"{flipped} folds turned over"
    if not flipped and len(find_intersections(vertices, net.facets.facets)):
        yield "the sheet cuts itself"
    if overlaps_itself(unfolded.vertices, net.facets.facets, np.array(net.border)):
        yield "the unfolded pattern overlaps itself"


def name_faults(faults: Sequence[str], reason: str) -> str:
    """Join faults to a sentence, or give the reason where there are none."""
    return "; ".join(faults) or reason
