"""Standard Miura pattern: flat and folded closed forms.

Schenk and Guest, PNAS 110 (2013) 3276, eq. 1-4: unit cell of H, S, L, V.
"""

import math
from dataclasses import dataclass

import numpy as np

from foldshell.pattern.grid import Grid, build_grid


@dataclass(frozen=True)
class Miura:
    """Sides [m] of a panel, its acute angle [rad], and the numbers of polylines.

    `side_a` joins neighbouring zig-zags (runs along a strip), `side_b` neighbouring strips.
    """

    side_a: float
    side_b: float
    sector_angle: float
    zigzag_count: int
    strip_count: int

    def __post_init__(self) -> None:
        if not (self.side_a > 0 and self.side_b > 0):
            raise ValueError(f"sides {self.side_a}, {self.side_b}: must be positive")
        if not 0 < self.sector_angle < math.pi / 2:
            raise ValueError(f"sector angle {self.sector_angle}: must lie in (0, pi/2)")

    @property
    def grid(self) -> Grid:
        """Panels, facets, edges and fold directions."""
        return build_grid(self.zigzag_count, self.strip_count)


@dataclass(frozen=True)
class Cell:
    """Half periods of a folded unit [m]: across strips, across zig-zags, offset, height."""

    across_strips: float  # S
    across_zigzags: float  # L
    offset: float  # V
    height: float  # H


def fold_cell(pattern: Miura, fold_angle: float) -> Cell:
    """H = a sin t sin g, S = b cos t tan g / r, L = a sqrt(1 - sin2 t sin2 g), V = b / r.

    With r = sqrt(1 + cos2 t tan2 g); t = `fold_angle` is a facet's angle to the plane,
    0 flat, pi/2 folded flat.
    """
    a, b, gamma = pattern.side_a, pattern.side_b, pattern.sector_angle
    # Multiplied through by cos g, so that g near 90 degrees stays finite; the square root is
    # written as a sum of squares, so that nothing cancels near the folded state.
    steep = math.cos(fold_angle) * math.sin(gamma)
    root = math.hypot(math.cos(gamma), steep)
    return Cell(
        across_strips=b * steep / root,
        across_zigzags=a * root,
        offset=b * math.cos(gamma) / root,
        height=a * math.sin(fold_angle) * math.sin(gamma),
    )


def place_cells(
    cell: Cell, zigzag_count: int, strip_count: int, widths: np.ndarray | None = None
) -> np.ndarray:
    """X(i, j) = (j S, i L + (j odd) V, (i odd) H): vertices (V, 3) [m].

    `widths` (strip_count - 1,) scales each strip's S and V. The vertices keep their angles, so the
    sheet folds flat as before, but its zig-zags run along a curve.
    """
    row, column = np.divmod(np.arange(zigzag_count * strip_count), strip_count)
    across, ahead = column * 1.0, column % 2 * 1.0
    if widths is not None:
        across, ahead = (path[column] for path in _strip_paths(widths))
    return np.column_stack(
        [
            across * cell.across_strips,
            row * cell.across_zigzags + ahead * cell.offset,
            (row % 2) * cell.height,
        ]
    )


def _strip_paths(widths: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return where the lines between strips stand, in S across them and in V along them."""
    turns = np.where(np.arange(len(widths)) % 2 == 0, widths, -widths)
    return np.append(0.0, np.cumsum(widths)), np.append(0.0, np.cumsum(turns))


def grade_widths(strip_count: int, grading: float) -> np.ndarray | None:
    """w = 1 + g (|2 s - 1| - mean), s from 0 to 1 across: widths (strip_count - 1,), mean 1.

    g = `grading` is the width of the borders' strips less that of the middle, in mean widths, as
    it is for many strips; widths have no unit. None for g = 0.

    Raises
    ------
    ValueError
        for a grading that leaves a strip less than a tenth of the mean width.
    """
    if not grading:
        return None
    middle = (np.arange(strip_count - 1) + 0.5) / (strip_count - 1)
    outward = np.abs(2 * middle - 1)
    widths = 1 + grading * (outward - outward.mean())
    if widths.min() < 0.1:
        raise ValueError(
            f"strip_grading {grading:g}: the narrowest of {strip_count - 1} strips is "
            f"{widths.min():.2g} of the mean width, at least 0.1 is allowed"
        )
    return widths


def flat_vertices(pattern: Miura, widths: np.ndarray | None = None) -> np.ndarray:
    """x = j b sin g, y = i a + (j odd) b cos g, z = 0: vertices (V, 3) [m]."""
    return folded_vertices(pattern, 0.0, widths)


def folded_vertices(
    pattern: Miura, fold_angle: float, widths: np.ndarray | None = None
) -> np.ndarray:
    """Vertices (V, 3) [m] of the folded planar state at `fold_angle` [rad].

    `widths` (strip_count - 1,) are the strips' widths over `side_b`, all 1 unless given.
    """
    cell = fold_cell(pattern, fold_angle)
    return place_cells(cell, pattern.zigzag_count, pattern.strip_count, widths)


def rest_fold_angle(sector_angle: float, poisson: float = -1.0) -> float:
    """cos2 t tan2 g = -poisson: the state of a given in-plane Poisson's ratio [rad].

    At -1 the folded sheet changes size alike in both directions, and both curvatures of its
    saddle have the same size. Exists for sector angles above 45 degrees.
    """
    steepness = math.sqrt(-poisson)
    if not math.atan(steepness) < sector_angle < math.pi / 2:
        least = math.degrees(math.atan(steepness))
        raise ValueError(f"sector angle {sector_angle}: must be {least:g} to 90 deg, both excluded")
    return math.acos(steepness / math.tan(sector_angle))


def poissons_ratio(sector_angle: float, fold_angle: float) -> float:
    """-eps_L / eps_S = -cos2 t tan2 g, in plane; bending has the opposite sign."""
    return -((math.cos(fold_angle) * math.tan(sector_angle)) ** 2)


def size_miura(
    length_across_strips: float,
    length_across_zigzags: float,
    sector_angle: float,
    zigzag_count: int,
    strip_count: int,
    poisson: float = -1.0,
    widths: np.ndarray | None = None,
) -> Miura:
    """Choose sides so that the rest state measures the two given lengths [m].

    (strip_count - 1) S = first, (zigzag_count - 1) L + V = second; `poisson` is the rest state's
    ratio, `widths` (strip_count - 1,) of mean 1 are the strips' over `side_b`. With them the
    zig-zags lean over several V.
    """
    lean = 1.0 if widths is None else float(np.ptp(_strip_paths(widths)[1]))
    rest = rest_fold_angle(sector_angle, poisson)
    unit = fold_cell(Miura(1.0, 1.0, sector_angle, zigzag_count, strip_count), rest)
    side_b = length_across_strips / ((strip_count - 1) * unit.across_strips)
    rows = length_across_zigzags - side_b * unit.offset * lean
    if rows <= 0:
        raise ValueError(
            f"strips {strip_count}: too few for zig-zags {zigzag_count}, one panel is longer than "
            "the span"
        )
    return Miura(
        rows / ((zigzag_count - 1) * unit.across_zigzags),
        side_b,
        sector_angle,
        zigzag_count,
        strip_count,
    )
