"""Topology of a quadrilateral crease grid: panels, facets, edges, fold directions, hinges."""

from dataclasses import dataclass, replace

import numpy as np

BOUNDARY, MOUNTAIN, VALLEY, FLAT = "B", "M", "V", "F"


@dataclass(frozen=True)
class Grid:
    """Connectivity of `zigzag_count` x `strip_count` polylines, borders included.

    Vertex (i, j) is row `i * strip_count + j`; panel (i, j) is `i * (strip_count - 1) + j`.
    Edges come in three runs: along zig-zags, along strips, neutral folds (one per panel).
    """

    zigzag_count: int
    strip_count: int
    quads: np.ndarray  # (P, 4) counter-clockwise from above
    facets: np.ndarray  # (2P, 3) rows 2p and 2p + 1 are panel p
    edges: np.ndarray  # (E, 2)
    assignments: np.ndarray  # (E,) of "B", "M", "V", "F"
    zigzag_index: np.ndarray  # (V,) index i of each vertex
    strip_index: np.ndarray  # (V,) index j of each vertex

    @property
    def panels(self) -> int:
        """Number of panels, (zigzag_count - 1)(strip_count - 1)."""
        return len(self.quads)

    @property
    def neutral(self) -> slice:
        """Rows of `edges` that are neutral folds; row p of the run belongs to panel p."""
        return slice(len(self.edges) - self.panels, len(self.edges))


@dataclass(frozen=True)
class Hinges:
    """Interior edges with the facets on both sides.

    `vertices` (H, 4): the edge's two ends, then the vertices opposite in the left and in the
    right facet, seen from above along the edge; `edges` (H,): row in the edge list.
    """

    vertices: np.ndarray
    edges: np.ndarray


def build_grid(zigzag_count: int, strip_count: int) -> Grid:
    """Build panels, facets and edges of a Miura-like grid.

    Even zig-zags fold as valleys, odd ones as mountains; along strips the sign alternates
    with i + j, so that every interior vertex has three folds of its zig-zag's kind and one of
    the other. Neutral folds join the panels' obtuse corners, which alternate by column.
    """
    if zigzag_count < 3 or strip_count < 3:
        raise ValueError(f"zig-zags {zigzag_count} and strips {strip_count}: at least 3 of each")
    number = np.arange(zigzag_count * strip_count).reshape(zigzag_count, strip_count)
    row, column = np.divmod(np.arange(number.size), strip_count)
    quads = _stack(number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1])
    diagonals = _shorter_diagonals(quads, column[quads[:, 0]])
    along_zigzag = _stack(number[:, :-1], number[:, 1:])
    along_strip = _stack(number[:-1], number[1:])
    edges = np.vstack([along_zigzag, along_strip, diagonals])
    assignments = np.concatenate(
        [
            _assign(row[along_zigzag[:, 0]], row[along_zigzag[:, 0]] % (zigzag_count - 1) == 0),
            _assign(
                (row + column)[along_strip[:, 0]] + 1,
                column[along_strip[:, 0]] % (strip_count - 1) == 0,
            ),
            np.full(len(quads), FLAT),
        ]
    )
    return Grid(
        zigzag_count,
        strip_count,
        quads,
        split_quads(quads, column[quads[:, 0]]),
        edges,
        assignments,
        row,
        column,
    )


def remove_creases(grid: Grid) -> Grid:
    """Return the same grid with every inner edge flat: a smooth surface's panels."""
    border = grid.assignments == BOUNDARY
    return replace(grid, assignments=np.where(border, BOUNDARY, FLAT))


def split_quads(quads: np.ndarray, column: np.ndarray) -> np.ndarray:
    """Split panels (P, 4) along the diagonal of their column's parity into facets (2P, 3).

    column (P,); all of them numbers.
    """
    a, b, c, d = quads.T
    even = (column % 2 == 0)[:, None]
    first = np.where(even, np.stack([a, b, d], 1), np.stack([a, b, c], 1))
    second = np.where(even, np.stack([b, c, d], 1), np.stack([a, c, d], 1))
    return np.stack([first, second], axis=1).reshape(-1, 3)


def find_outline(grid: Grid) -> np.ndarray:
    """Border vertices (K,) in counter-clockwise order, as row numbers."""
    number = np.arange(grid.zigzag_count * grid.strip_count).reshape(
        grid.zigzag_count, grid.strip_count
    )
    sides = [number[0, :-1], number[:-1, -1], number[-1, :0:-1], number[:0:-1, 0]]
    return np.concatenate(sides)


def _shorter_diagonals(quads: np.ndarray, column: np.ndarray) -> np.ndarray:
    even = (column % 2 == 0)[:, None]
    return np.where(even, quads[:, [1, 3]], quads[:, [0, 2]])


def _assign(parity: np.ndarray, border: np.ndarray) -> np.ndarray:
    return np.where(border, BOUNDARY, np.where(parity % 2 == 0, VALLEY, MOUNTAIN))


def _stack(*parts: np.ndarray) -> np.ndarray:
    return np.stack([part.ravel() for part in parts], axis=1)


def find_hinges(facets: np.ndarray, edges: np.ndarray) -> Hinges:
    """Find the edges shared by two facets.

    facets (F, 3) counter-clockwise from above, edges (E, 2) in any order and direction; the
    left facet is the one that runs along the edge from its first to its second vertex.

    All of them are numbers of vertices.
    """
    count = int(facets.max()) + 1
    start = facets.ravel()
    end = np.roll(facets, -1, axis=1).ravel()
    opposite = np.roll(facets, -2, axis=1).ravel()
    key = start.astype(np.int64) * count + end
    order = np.argsort(key)

    def look_up(first: np.ndarray, second: np.ndarray) -> np.ndarray:
        """Vertex opposite of each directed edge (k,), -1 for none."""
        wanted = first.astype(np.int64) * count + second
        place = np.minimum(np.searchsorted(key[order], wanted), len(key) - 1)
        return np.where(key[order][place] == wanted, opposite[order][place], -1)

    left = look_up(edges[:, 0], edges[:, 1])
    right = look_up(edges[:, 1], edges[:, 0])
    rows = np.flatnonzero((left >= 0) & (right >= 0))
    return Hinges(np.column_stack([edges[rows], left[rows], right[rows]]), rows)
