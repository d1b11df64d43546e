"""From a design's numbers to the sheet that is to be folded."""

import math

import numpy as np

from foldshell.pattern.arc_miura import make_arc_sheet, size_arc_miura
from foldshell.pattern.grid import build_grid, remove_creases
from foldshell.pattern.miura import grade_widths, poissons_ratio, size_miura
from foldshell.pattern.sheet import FRAMES, Sheet, make_miura_sheet
from foldshell.settings.design import GRID_PATTERNS

SECTOR_ANGLES_DEG = (46.0, 88.0)  # near 45 the rest state is flat, near 90 zig-zags vanish


def design_sheet(
    pattern: str,
    section_lengths: tuple[float, float],
    zigzag_count: int,
    strip_count: int,
    sector_angle_deg: float,
    frames: int = FRAMES,
    turning: float = 0.0,
    rest_fold_angle_deg: float = 0.0,
    strip_grading: float = 0.0,
) -> Sheet:
    """Size a sheet whose rest state measures the target's central sections [m].

    `pattern`: miura; arc_miura, curved along its strips by `turning` [rad]; smooth, a plain
    grid of panels to lay on the target; flat, the Miura sheet before folding. `frames` states
    of the folding path are kept with it. A Miura sheet may have another rest state than that of
    Poisson's ratio -1, and strips of unequal width (`grade_widths`).
    """
    if zigzag_count < 3 or strip_count < 3:
        raise ValueError(f"zigzag {zigzag_count}, strip {strip_count}: must be at least 3 each")
    if pattern == "smooth":
        return _make_smooth_sheet(section_lengths, zigzag_count, strip_count)
    low, high = SECTOR_ANGLES_DEG if not rest_fold_angle_deg else (5.0, 88.0)
    if not low <= sector_angle_deg <= high:
        raise ValueError(f"sector_angle_deg {sector_angle_deg}: must be {low:g} to {high:g}")
    if pattern == "arc_miura":
        arc, fold = size_arc_miura(
            section_lengths, turning, math.radians(sector_angle_deg), zigzag_count, strip_count
        )
        return make_arc_sheet(arc, fold, frames)
    if pattern not in ("miura", "flat"):
        raise ValueError(f"pattern {pattern!r}: must be one of {', '.join(GRID_PATTERNS)}")
    sector = math.radians(sector_angle_deg)
    rest = math.radians(rest_fold_angle_deg)
    poisson = poissons_ratio(sector, rest) if rest else -1.0
    widths = grade_widths(strip_count, strip_grading)
    miura = size_miura(*section_lengths, sector, zigzag_count, strip_count, poisson, widths)
    if pattern == "miura":
        return make_miura_sheet(miura, frames, poisson, widths)
    sheet = make_miura_sheet(miura, 0, poisson, widths)
    return Sheet("flat", sheet.grid, sheet.flat, sheet.flat, (), sheet.settings)


def _make_smooth_sheet(lengths: tuple[float, float], zigzag_count: int, strip_count: int) -> Sheet:
    grid = remove_creases(build_grid(zigzag_count, strip_count))
    flat = np.column_stack(
        [
            grid.strip_index * lengths[0] / (strip_count - 1),
            grid.zigzag_index * lengths[1] / (zigzag_count - 1),
            np.zeros(len(grid.strip_index)),
        ]
    )
    return Sheet("smooth", grid, flat, flat, (), {})
