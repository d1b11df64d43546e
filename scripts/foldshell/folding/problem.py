"""The folding problem in elastic mode: start, weights, terms."""

import numpy as np

from foldshell.folding.terms import Attraction, Hinge, PlanEdge, Stretch, Target, Term
from foldshell.pattern.angles import measure_hinges
from foldshell.pattern.grid import find_hinges
from foldshell.pattern.sheet import Sheet
from foldshell.settings.fold import FoldWeights

STEEP = 0.8  # height / span from which folds and plan edges are held more firmly


def attracted_vertices(sheet: Sheet, attract: str) -> np.ndarray:
    """Row numbers (N,) of the lowest or the highest vertices, even or odd zig-zags, or of all."""
    if attract == "all":
        return np.arange(len(sheet.grid.zigzag_index))
    if attract not in ("lowest", "highest"):
        raise ValueError(f"attract {attract!r}: must be lowest, highest or all")
    return np.flatnonzero(sheet.grid.zigzag_index % 2 == (attract == "highest"))


def reference_length(sheet: Sheet) -> float:
    """ell = sqrt(a b), from the mean edge lengths of both families [m]."""
    grid = sheet.grid
    along_zigzag = grid.zigzag_count * (grid.strip_count - 1)
    lengths = edge_lengths(sheet.flat, grid.edges)
    side_b = lengths[:along_zigzag].mean()
    side_a = lengths[along_zigzag : grid.neutral.start].mean()
    return float(np.sqrt(side_a * side_b))


def edge_lengths(vertices: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Length (E,) [m] of edges (E, 2)."""
    return np.linalg.norm(vertices[edges[:, 1]] - vertices[edges[:, 0]], axis=1)


def place_sheet(sheet: Sheet, target: Target, attract: str) -> np.ndarray:
    """Lay the rest state on the target: vertices (V, 3) [m].

    Plan coordinates become arc lengths of the target's two central sections; heights above
    the attracted vertices are set off along the surface normal.
    """
    placed = sheet.placement
    rest = placed - 0.5 * (placed.min(axis=0) + placed.max(axis=0))
    x = target.walk_section(0, rest[:, 0])
    y = target.walk_section(1, rest[:, 1])
    height = placed[:, 2] - placed[attracted_vertices(sheet, attract), 2].mean()
    base = np.column_stack([x, y, target.evaluate_height(x, y)])
    return base + height[:, None] * target.find_normals(x, y)


def build_terms(sheet: Sheet, target: Target, attract: str, weights: FoldWeights) -> list[Term]:
    """Stretch, crease hinges, neutral folds, attraction, plan edges; in that order."""
    grid = sheet.grid
    hinges = find_hinges(grid.facets, grid.edges)
    neutral = grid.assignments[hinges.edges] == "F"
    rest = measure_hinges(sheet.rest, hinges.vertices)
    steep = target.height >= STEEP * min(target.sides)
    crease_weight = weights.hinge_steep if steep else weights.hinge
    neutral_weight = weights.neutral_fold_steep if steep else weights.neutral_fold
    edge_weight = weights.plan_edge_steep if steep else weights.plan_edge
    ell = reference_length(sheet)
    return [
        Stretch(grid.edges, edge_lengths(sheet.flat, grid.edges), weights.stretch),
        Hinge(hinges.vertices[~neutral], rest[~neutral], crease_weight),
        Hinge(hinges.vertices[neutral], np.zeros(neutral.sum()), neutral_weight),
        Attraction(attracted_vertices(sheet, attract), target, ell, weights.attraction),
        hold_plan_edges(sheet, target.sides, ell, edge_weight),
    ]


def hold_plan_edges(
    sheet: Sheet, sides: tuple[float, float], reference: float, weight: float
) -> PlanEdge:
    """Hold every border vertex near its edge of the plan; corners near both."""
    grid = sheet.grid
    vertices, axes, positions = [], [], []
    for axis, index, last in (
        (0, grid.strip_index, grid.strip_count - 1),
        (1, grid.zigzag_index, grid.zigzag_count - 1),
    ):
        for border, side in ((0, -1), (last, 1)):
            chosen = np.flatnonzero(index == border)
            vertices.append(chosen)
            axes.append(np.full(len(chosen), axis))
            positions.append(np.full(len(chosen), side * sides[axis] / 2))
    return PlanEdge(
        np.concatenate(vertices), np.concatenate(axes), np.concatenate(positions), reference, weight
    )
