"""Folding by geometric rules: the reverse fold driven by one translation.

Tsiamis, Oliva and Calvano, Nexus Netw. J. 20 (2018) 59, Fig. 1. Edges EF, IL and HG run along
neighbouring zig-zags; E moves along V1 towards H, and IL rises (mountain) or sinks (valley).
"""

import math
from dataclasses import dataclass

import numpy as np

from foldshell.pattern.miura import Cell, Miura, place_cells


@dataclass(frozen=True)
class Travel:
    """Translation of E along V1 [m], and what is left of it until the unit is folded flat.

    Both are kept because each end of the path loses digits in the other's difference.
    """

    done: float
    left: float


def largest_travel(pattern: Miura) -> float:
    """2 a (1 - cos g): EI has turned onto EF [m]."""
    # 1 - cos g = 2 sin2(g / 2), without cancellation
    return 4.0 * pattern.side_a * math.sin(pattern.sector_angle / 2) ** 2


def travel_at(pattern: Miura, fold_angle: float) -> Travel:
    """t = 2 (a - L) with L = a sqrt(1 - sin2(angle) sin2 g), free of cancellation [m]."""
    a, gamma = pattern.side_a, pattern.sector_angle
    sine = math.sin(gamma)
    root = math.hypot(math.cos(gamma), math.cos(fold_angle) * sine)
    return Travel(
        done=2 * a * (math.sin(fold_angle) * sine) ** 2 / (1 + root),
        left=2 * a * (math.cos(fold_angle) * sine) ** 2 / (math.cos(gamma) + root),
    )


def make_travel(pattern: Miura, done: float) -> Travel:
    """Complete a translation given as one number [m]."""
    largest = largest_travel(pattern)
    if not 0 <= done <= largest:
        raise ValueError(f"translation {done}: must lie in [0, {largest}]")
    return Travel(done, largest - done)


def fold_unit(pattern: Miura, travel: Travel, fold: str = "M") -> dict[str, np.ndarray]:
    """Positions (3,) [m] of E, F, G, H, I, L and of the projections K1, K2 of I.

    E stays at the origin and V1 is +y, so the translation brings H nearer; `fold` says whether
    IL is a mountain ("M") or a valley ("V").
    """
    a, b, gamma = pattern.side_a, pattern.side_b, pattern.sector_angle
    half = a - travel.done / 2  # |EH| / 2
    point_e, point_h = np.zeros(3), np.array([0.0, 2 * half, 0.0])
    # EF keeps its length and its angle with EI; of EF . EI only the part along V1 is not zero.
    along = a * b * math.cos(gamma) / half
    across = math.sqrt(b * travel.left / (2 * half) * (b + along))  # b - along, factored
    direction = np.array([across, along, 0.0]) / b
    foot = a * math.cos(gamma) * direction
    point_k1, point_k2 = point_e + foot, point_h - foot
    point_i = meet_circles(point_k1, point_k2, travel.done / 2 * (a + half), fold)
    return {
        "E": point_e, "F": point_e + b * direction, "G": point_h + b * direction, "H": point_h,
        "I": point_i, "L": point_i + b * direction, "K1": point_k1, "K2": point_k2,
    }  # fmt: skip


def meet_circles(
    centre_1: np.ndarray, centre_2: np.ndarray, height_squared: float, fold: str
) -> np.ndarray:
    """Meet two equal upright circles about `centre_1` and `centre_2`; pick upper or lower.

    `height_squared` is r2 - (d/2)2 for radius r and centre distance d, which the caller can
    give in a factored form that keeps its digits when the circles nearly touch.

    Centres and the point returned are (3,) m, `height_squared` is m2.
    """
    if fold not in ("M", "V"):
        raise ValueError(f"fold {fold!r}: must be 'M' or 'V'")
    side = 1.0 if fold == "M" else -1.0
    return (centre_1 + centre_2) / 2 + [0, 0, side * math.sqrt(height_squared)]


def fold_by_rules(pattern: Miura, travel: Travel, fold: str = "M") -> np.ndarray:
    """Vertices (V, 3) [m] of the whole sheet, driven by one unit's translation.

    Every other unit is a copy of the first one, moved by the unit's edges or mirrored in the
    strip line; `fold` is the direction of the odd zig-zags.
    """
    unit = fold_unit(pattern, travel, fold)
    edge = unit["F"] - unit["E"]
    cell = Cell(edge[0], unit["I"][1], edge[1], unit["I"][2])
    return place_cells(cell, pattern.zigzag_count, pattern.strip_count)
