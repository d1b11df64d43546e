"""The way of a true sheet of any panels from flat to its shape, without strain.

Where all inner vertices have degree 4 and are flat-foldable the half tangents of all folds grow
alike, and panels are turned about their sides. Others have more freedom: every fold is asked for
the same share of its angle, and what comes of it is projected onto the lengths of the flat sheet.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.folding.exact import project_vertices
from foldshell.folding.free_fold import list_free_terms
from foldshell.folding.intersections import find_intersections
from foldshell.folding.levenberg import minimise_terms
from foldshell.folding.net import FoldNet
from foldshell.folding.normal_equations import NormalEquations
from foldshell.folding.terms import Stretch
from foldshell.pattern.angles import measure_hinges
from foldshell.pattern.unfold import fit_onto, lay_level, scale_folds, turn_towards
from foldshell.pattern.unfold_panels import fold_net

SOFT = 100.0  # weight of the sides on the way, against creases of 0.01


@dataclass(frozen=True)
class NetPath:
    """States (V, 3) m by share of the folds, the largest strain on the way, cuts of the sheet.

    `gap` [m] is how far panels part where they are turned about their sides, 0 elsewhere.
    """

    parts: np.ndarray
    states: list[np.ndarray]
    strain: float
    gap: float
    cuts: int


def follow_net(
    net: FoldNet, flat: np.ndarray, folded: np.ndarray, parts: np.ndarray, rigid: bool
) -> NetPath:
    """Fold a true sheet from flat (V, 3) m towards its shape `folded`, by `parts` of its folds.

    `rigid` turns panels about their sides; else lengths are kept and panels may bend.
    """
    folds = measure_hinges(folded, net.hinges.vertices)
    ends = net.facets.edges[net.hinges.edges]
    gap = 0.0
    if rigid:
        states = []
        for part in parts:
            angles = scale_folds(folds, part)
            pairs = zip(ends.tolist(), angles.tolist(), strict=True)
            named = {(min(end), max(end)): angle for end, angle in pairs}
            found = fold_net(flat, net.mesh.panels, named)
            states.append(found.vertices)
            gap = max(gap, found.closure)
    else:
        states = _bend(net, flat, folded, folds, parts)
    lengths = _measure(flat, net)
    strain = max(float(np.abs(_measure(state, net) / lengths - 1).max()) for state in states)
    cuts = sum(len(find_intersections(state, net.facets.facets)) for state in states[1::4])
    return NetPath(parts, _place(states, folded, parts, net), strain, gap, cuts)


def _measure(vertices: np.ndarray, net: FoldNet) -> np.ndarray:
    ends = vertices[net.facets.edges]
    return np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)


def _bend(
    net: FoldNet, flat: np.ndarray, folded: np.ndarray, folds: np.ndarray, parts: np.ndarray
) -> list[np.ndarray]:
    """States from the shape back to flat, each from the one before and projected."""
    rest = _measure(flat, net)
    kept = Stretch(net.facets.edges, rest, 1.0)
    vertices, found, equations = folded, {}, None
    for part in sorted(parts, reverse=True):
        terms = list_free_terms(net, part * folds, SOFT)
        terms[0] = Stretch(net.facets.edges, rest, SOFT)
        equations = equations or NormalEquations([t.columns for t in terms], vertices.size)
        if part < 1.0:
            vertices = minimise_terms(
                terms, vertices, max_iterations=60, cost_tolerance=1e-3,
                step_tolerance=1e-9 * np.ptp(flat, axis=0).max(), equations=equations,
            ).vertices  # fmt: skip
        if part == 0.0:
            vertices = flat
        vertices = project_vertices([kept], vertices).vertices
        found[part] = vertices
    return [found[part] for part in parts]


def _place(
    states: list[np.ndarray], folded: np.ndarray, parts: np.ndarray, net: FoldNet
) -> list[np.ndarray]:
    """Lay each state nearest to the one after it, and turn it level as it comes near to flat."""
    placed: list[np.ndarray] = []
    onto = folded
    for part, state in zip(reversed(parts), reversed(states), strict=True):
        onto = fit_onto(state, onto)
        placed.insert(0, turn_towards(lay_level(onto, net.facets.facets), onto, part))
    return placed
