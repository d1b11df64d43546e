"""Which strengths of the forces fold a sheet: quadrilateral panels against triangulated ones.

The paper found that on quadrilaterals one force must govern, and that triangulated panels fold
whatever the strengths (Tsiamis, Oliva and Calvano, 2018, 'Folding by physics simulation').
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from foldshell.folding.constraints import require_planar
from foldshell.folding.intersections import find_intersections
from foldshell.folding.problem import (
    build_terms,
    edge_lengths,
    place_sheet,
    reference_length,
)
from foldshell.folding.quality import count_flipped, measure_planarity, root_mean_square
from foldshell.folding.soft import minimise_softly
from foldshell.folding.terms import Stretch, Target, Term
from foldshell.pattern.angles import measure_folds
from foldshell.pattern.sheet import Sheet
from foldshell.settings.fold import Fold

PANELS = ("quadrilaterals", "triangles")
REACHED = 1e-3  # rms distance over span
SHEARED = 0.1  # strain of a panel's diagonal from which the panel is another one


@dataclass(frozen=True)
class Trial:
    """One choice of strengths and what it led to; ratios are non-dimensional.

    `panel` is the strength that keeps panels flat: planarity of quadrilaterals, the neutral
    fold of triangles. `shear_max` is the strain of a diagonal. `reached` says that
    the lowest vertices met the target with every fold its own way and no cuts; `folded` asks
    besides that no diagonal strained by more than SHEARED. On quadrilaterals the two differ:
    nothing but the border and hinges resists shear there, so the verdict depends on which of
    them one calls folded, and both are kept.
    """

    engine: str
    panels: str
    attraction: float
    panel: float
    rms_over_span: float
    crease_strain_max: float
    shear_max: float
    planarity_max: float
    flipped_folds: int
    self_intersections: int
    iterations: int
    reached: bool
    folded: bool


def sweep_force_ratios(
    sheet: Sheet,
    target: Target,
    settings: Fold,
    attractions: Sequence[float],
    panels: Sequence[float],
) -> Iterator[Trial]:
    """Fold once for every pair of strengths, on quadrilaterals and on triangles."""
    for kind in PANELS:
        for attraction in attractions:
            for panel in panels:
                yield try_force_ratios(sheet, target, settings, kind, attraction, panel)


def try_force_ratios(
    sheet: Sheet,
    target: Target,
    settings: Fold,
    panels: str,
    attraction: float,
    panel: float,
) -> Trial:
    """Fold by the given strengths, stretch, hinges and engine as in elastic mode."""
    terms = _build_terms(sheet, target, settings, panels, attraction, panel)
    start = place_sheet(sheet, target, settings.attract)
    minimum = minimise_softly(terms, start, settings, target.span)
    grid, vertices = sheet.grid, minimum.vertices
    strain = np.abs(edge_lengths(vertices, grid.edges) / edge_lengths(sheet.flat, grid.edges) - 1)
    shear = float(strain[grid.neutral].max())
    residual, _ = terms[-2].evaluate(vertices)  # attraction
    distances = residual * reference_length(sheet) / np.sqrt(attraction)
    flipped = count_flipped(measure_folds(vertices, grid), grid)
    cuts = len(find_intersections(vertices, grid.facets))
    rms = root_mean_square(distances) / target.span
    reached = rms <= REACHED and not flipped and not cuts
    return Trial(
        settings.engine, panels, float(attraction), float(panel), rms,
        float(strain[: grid.neutral.start].max()), shear,
        float(measure_planarity(vertices, grid.quads).max()), flipped, cuts,
        minimum.iterations, reached, reached and shear <= SHEARED,
    )  # fmt: skip


def _build_terms(
    sheet: Sheet,
    target: Target,
    settings: Fold,
    panels: str,
    attraction: float,
    panel: float,
) -> list[Term]:
    given = settings.weights
    weights = replace(given, neutral_fold=panel, neutral_fold_steep=panel, attraction=attraction)
    stretch, creases, neutral, pull, edges = build_terms(sheet, target, settings.attract, weights)
    if panels == "triangles":
        return [stretch, creases, neutral, pull, edges]
    grid = sheet.grid
    sides = grid.edges[: grid.neutral.start]
    return [
        Stretch(sides, edge_lengths(sheet.flat, sides), given.stretch),
        creases,
        require_planar(grid, sheet.rest, reference_length(sheet), panel),
        pull,
        edges,
    ]
