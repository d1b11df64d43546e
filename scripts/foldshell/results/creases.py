"""Crease lines of a sheet as polylines that follow its result mesh, bent or not."""

from dataclasses import dataclass

import numpy as np

from foldshell.pattern.angles import measure_folds, measure_hinges
from foldshell.pattern.grid import build_grid, find_hinges
from foldshell.records.arrays import list_arrays
from foldshell.records.sheet_arrays import FoldedArrays
from foldshell.shell.curved_panels import PARTS, refine_panels
from foldshell.shell.mesh import ShellMesh

FOLD_MIN = np.radians(1.0)
"""An edge that folds less is drawn as a panel border."""


@dataclass(frozen=True)
class Creases:
    """Nodes of each crease (K, n+1) in the result mesh, by kind."""

    mountain: np.ndarray
    valley: np.ndarray
    flat: np.ndarray
    border: np.ndarray


def find_creases(cells: ShellMesh, folded: FoldedArrays, creased: bool = True) -> Creases:
    """Sort panel edges by the way they fold; neutral folds are left out.

    Parameters
    ----------
    cells : result mesh over the facets of the folded sheet
    creased : False where a smooth surface bends at its panels' borders, which are no creases
    """
    if folded.surface is not None:
        edges, border = _list_curved_sides(folded)
        fold = np.zeros(len(edges))
    elif folded.zigzag is None:
        edges, kinds = folded.edges, folded.edge_kind
        fold, border = _measure_sides(folded), kinds == 0
    else:
        grid = build_grid(int(folded.zigzag.max()) + 1, int(folded.strip.max()) + 1)
        edge = slice(0, grid.neutral.start)
        edges, fold = grid.edges[edge], measure_folds(folded.vertices, grid)[edge]
        border = grid.assignments[edge] == "B"
    nodes = cells.pair_nodes[_find_pairs(cells, edges)]
    inner = ~border & creased
    mountain, valley = inner & (fold < -FOLD_MIN), inner & (fold > FOLD_MIN)
    flat = ~border & ~mountain & ~valley
    return Creases(nodes[mountain], nodes[valley], nodes[flat], nodes[border])


def _list_curved_sides(folded: FoldedArrays) -> tuple[np.ndarray, np.ndarray]:
    """Return the facet edges (X, 2) along the sides of smooth panels, and which are the border."""
    fine = refine_panels(list_arrays(folded), PARTS)
    ends = np.sort(fine["facets"][:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, which, count = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
    owner = np.repeat(fine["facet_panel"], 3)
    low, high = np.full(len(edges), owner.max()), np.zeros(len(edges), dtype=owner.dtype)
    np.minimum.at(low, which.ravel(), owner)
    np.maximum.at(high, which.ravel(), owner)
    side = (count == 1) | (low != high)
    return edges[side], count[side] == 1


def _measure_sides(folded: FoldedArrays) -> np.ndarray:
    """Fold (X,) rad of each side of a panel, 0 on the border and where three panels meet."""
    hinges = find_hinges(folded.facets, folded.edges)
    fold = np.zeros(len(folded.edges))
    fold[hinges.edges] = measure_hinges(folded.vertices, hinges.vertices)
    return fold


def _find_pairs(cells: ShellMesh, pairs: np.ndarray) -> np.ndarray:
    width = int(cells.node_pairs.max()) + 1
    known = cells.node_pairs[:, 0] * width + cells.node_pairs[:, 1]
    low, high = pairs.min(axis=1), pairs.max(axis=1)
    return np.searchsorted(known, low * width + high)


def cut_dashes(polylines: np.ndarray, period: float, share: float = 0.55) -> np.ndarray:
    """Cut polylines (K, n, 3) into dashes (D, 2, 3), a whole number of periods to each line."""
    sides = np.linalg.norm(np.diff(polylines, axis=1), axis=2)
    counts = np.maximum(np.round(sides.sum(axis=1) / period).astype(int), 1)
    line = np.repeat(np.arange(len(polylines)), counts)
    number = np.arange(len(line)) - np.repeat(np.cumsum(counts) - counts, counts)
    gap = (1 - share) / 2
    ends = (number[:, None] + [gap, 1 - gap]) / counts[line][:, None]
    steps = polylines.shape[1] - 1
    place = np.minimum((ends * steps).astype(int), steps - 1)
    rest = (ends * steps - place)[..., None]
    start, end = polylines[line[:, None], place], polylines[line[:, None], place + 1]
    return (1 - rest) * start + rest * end
