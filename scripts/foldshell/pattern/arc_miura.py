"""Arc-Miura: a first-level derivative whose zig-zags alternate between two sector angles.

Folded, it is curved along its strips, yet developable, flat-foldable and rigidly foldable.
Gattas, Wu and You, J. Mech. Des. 135 (2013) 111011.
"""

import math
from dataclasses import dataclass

import numpy as np

from foldshell.pattern.grid import Grid, build_grid
from foldshell.pattern.miura import rest_fold_angle
from foldshell.pattern.sheet import FRAMES, Frame, Sheet
from foldshell.pattern.unfold import fold_panels

LARGEST_CHANGE = math.radians(25)  # of the odd zig-zags' sector angle against the even ones'


@dataclass(frozen=True)
class ArcMiura:
    """Side along strips and strip pitch of the flat sheet [m]; sector angles [rad].

    `angle_even` belongs to the even (valley) zig-zags, `angle_odd` to the mountains.
    """

    side: float
    pitch: float
    angle_even: float
    angle_odd: float
    zigzag_count: int
    strip_count: int

    @property
    def grid(self) -> Grid:
        """Panels, facets, edges and fold directions, those of the standard pattern."""
        return build_grid(self.zigzag_count, self.strip_count)


def flat_arc_vertices(pattern: ArcMiura) -> np.ndarray:
    """x = j w, y = i a + (j odd) w / tan g_i, z = 0: vertices (V, 3) [m]."""
    row, column = np.divmod(
        np.arange(pattern.zigzag_count * pattern.strip_count), pattern.strip_count
    )
    angle = np.where(row % 2 == 0, pattern.angle_even, pattern.angle_odd)
    y = row * pattern.side + (column % 2) * pattern.pitch / np.tan(angle)
    return np.column_stack([column * pattern.pitch, y, np.zeros(len(row))])


def fold_arc_vertices(pattern: ArcMiura, strip_fold: float) -> np.ndarray:
    """Vertices (V, 3) [m] of the state whose strip creases fold by `strip_fold` [rad].

    Each vertex folds as tan(zig-zag / 2) = tan(strip / 2) / cos g, so one strip fold drives the
    sheet; panels are then turned about their creases.
    """
    grid = pattern.grid
    folds = np.zeros(len(grid.edges))
    first = grid.edges[:, 0]
    sign = np.select([grid.assignments == "V", grid.assignments == "M"], [1.0, -1.0], 0.0)
    angle = np.where(grid.zigzag_index[first] % 2 == 0, pattern.angle_even, pattern.angle_odd)
    along_zigzag = np.arange(len(folds)) < grid.zigzag_count * (grid.strip_count - 1)
    size = np.where(
        along_zigzag, 2 * np.arctan(math.tan(strip_fold / 2) / np.cos(angle)), strip_fold
    )
    return fold_panels(flat_arc_vertices(pattern), grid, sign * size).vertices


def strip_slope(sector_angle: float, strip_fold: float) -> float:
    """tan e = tan g sin(strip fold / 2): a strip's edges turn by 2 e at such a zig-zag."""
    return math.atan(math.tan(sector_angle) * math.sin(strip_fold / 2))


def size_arc_miura(
    lengths: tuple[float, float],
    turning: float,
    sector_angle: float,
    zigzag_count: int,
    strip_count: int,
) -> tuple[ArcMiura, float]:
    """Choose angles, side and pitch for section lengths [m] and a turning along strips [rad].

    Per two rows the strips turn by 2 (e_odd - e_even); a positive `turning` is a dome. Returns
    the pattern and the strip fold of its rest state, that of the standard pattern with the
    mean sector angle.
    """
    fold = 2 * math.atan(math.cos(sector_angle) * math.tan(rest_fold_angle(sector_angle)))

    def miss(half_change: float) -> float:
        """Turning (rad) beyond the wanted one."""
        odd, even = (strip_slope(sector_angle + side * half_change, fold) for side in (1.0, -1.0))
        return (zigzag_count - 1) * (odd - even) - turning

    most = min(LARGEST_CHANGE / 2, (math.radians(88) - sector_angle))
    if miss(most) < 0 or miss(-most) > 0:
        raise ValueError(
            f"turning of {math.degrees(turning):.0f} deg: too much for {zigzag_count} rows"
        )
    from scipy.optimize import brentq  # takes longer to import than most patterns to make

    change = brentq(miss, -most, most)
    even, odd = sector_angle - change, sector_angle + change
    # Even (lowest) vertices are a chord over an odd one apart, so its slope sets their distance.
    slope = strip_slope(odd, fold)
    pitch = lengths[0] / ((strip_count - 1) * math.cos(fold / 2))
    offset = _zigzag_offset(pitch, even, odd, fold)
    side = (lengths[1] - offset) / ((zigzag_count - 1) * math.cos(slope))
    if side <= 0:
        raise ValueError(f"strips {strip_count}: too few for zig-zags {zigzag_count}")
    return ArcMiura(float(side), float(pitch), even, odd, zigzag_count, strip_count), fold


def _zigzag_offset(pitch: float, even: float, odd: float, fold: float) -> float:
    """How far odd strips stand ahead of even ones, the mean over both kinds of zig-zag [m]."""
    lean = math.sin(fold / 2)
    return pitch * (math.hypot(1 / math.tan(even), lean) + math.hypot(1 / math.tan(odd), lean)) / 2


def make_arc_sheet(pattern: ArcMiura, strip_fold: float, frames: int = FRAMES) -> Sheet:
    """Arc-Miura sheet with its rest state, that state unrolled, and frames of its path."""
    slope = strip_slope(pattern.angle_odd, strip_fold)
    grid = pattern.grid
    offset = _zigzag_offset(pattern.pitch, pattern.angle_even, pattern.angle_odd, strip_fold)
    unrolled = np.column_stack(
        [
            grid.strip_index * pattern.pitch * math.cos(strip_fold / 2),
            grid.zigzag_index * pattern.side * math.cos(slope) + (grid.strip_index % 2) * offset,
            (grid.zigzag_index % 2) * pattern.side * math.sin(slope),
        ]
    )
    folds = np.linspace(0, strip_fold, frames) if frames else []
    return Sheet(
        kind="arc_miura",
        grid=grid,
        flat=flat_arc_vertices(pattern),
        rest=fold_arc_vertices(pattern, strip_fold),
        path=tuple(
            Frame(f"strip fold {math.degrees(fold):.1f} deg", fold_arc_vertices(pattern, fold))
            for fold in folds
        ),
        settings={
            "side_m": pattern.side,
            "pitch_m": pattern.pitch,
            "sector_angle_even_deg": math.degrees(pattern.angle_even),
            "sector_angle_odd_deg": math.degrees(pattern.angle_odd),
            "rest_strip_fold_deg": math.degrees(strip_fold),
        },
        unrolled=unrolled,
    )
