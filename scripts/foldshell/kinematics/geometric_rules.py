"""Folding by the paper's geometric rules, held against the closed form over the whole path.

Tsiamis, Oliva and Calvano, Nexus Netw. J. 20 (2018) 59, Fig. 1, against Schenk and Guest, PNAS
110 (2013) 3276, eq. 1-4. The rules are in `reverse_fold.py`; here stand their study's numbers.
"""

import math
from collections.abc import Sequence

import numpy as np

from foldshell.folding.problem import edge_lengths
from foldshell.folding.quality import measure_planarity
from foldshell.kinematics.reverse_fold import fold_by_rules, fold_unit, largest_travel, travel_at
from foldshell.pattern.angles import developability_residual, flat_foldability_residual
from foldshell.pattern.miura import Miura, flat_vertices, folded_vertices, rest_fold_angle
from foldshell.records.kinematics import RuleDifference

PANELS = {"S1": "EFlp", "S2": "HGnq", "S3": "EFLI", "S4": "ILGH", "S5": "EIvu", "S6": "IHwv"}
"""Panels of Fig. 1 by their corners, one letter each; lower case as in `place_module`."""


def list_patterns(sector_angle: float) -> list[Miura]:
    """Return the sheets of the table: rhombi, long panels, a narrow and a nearly right angle."""
    return [
        Miura(1.0, 1.0, sector_angle, 7, 8),
        Miura(1.3, 0.7, sector_angle, 7, 8),
        Miura(0.4, 2.0, math.radians(48.0), 7, 8),
        Miura(1.0, 1.0, math.radians(85.0), 7, 8),
    ]


def list_angles(sector_angle: float, count: int = 19) -> list[float]:
    """Fold angles [rad] from flat to folded flat, evenly spaced, with the rest state in between."""
    return sorted({*np.linspace(0.0, math.pi / 2, count).tolist(), rest_fold_angle(sector_angle)})


def tabulate_differences(sector_angle: float) -> list[RuleDifference]:
    """Compare rules and closed form for every sheet of the table, from flat to folded flat."""
    return [
        compare_with_closed_form(pattern, angle)
        for pattern in list_patterns(sector_angle)
        for angle in list_angles(pattern.sector_angle)
    ]


def compare_with_closed_form(pattern: Miura, fold_angle: float) -> RuleDifference:
    """Fold the sheet by the rules to `fold_angle` [rad] and measure it against the closed form."""
    travel, grid = travel_at(pattern, fold_angle), pattern.grid
    vertices = fold_by_rules(pattern, travel)
    distance = np.linalg.norm(vertices - folded_vertices(pattern, fold_angle), axis=1)
    strain = edge_lengths(vertices, grid.edges) / edge_lengths(flat_vertices(pattern), grid.edges)
    return RuleDifference(
        side_a_m=pattern.side_a,
        side_b_m=pattern.side_b,
        sector_angle_deg=math.degrees(pattern.sector_angle),
        fold_angle_deg=math.degrees(fold_angle),
        travel_m=travel.done,
        travel_over_largest=travel.done / largest_travel(pattern),
        vertices_max_m=float(distance.max()),
        edge_strain_max=float(np.abs(strain - 1).max()),
        planarity_max=float(measure_planarity(vertices, grid.quads).max()),
        angle_defect_max_rad=float(np.abs(developability_residual(vertices, grid)).max()),
        kawasaki_max_rad=float(np.abs(flat_foldability_residual(vertices, grid)).max()),
    )


def place_module(pattern: Miura, fold_angle: float) -> dict[str, np.ndarray]:
    """Points (3,) [m] of the module of Fig. 1, seen from half-way between E and H.

    Upper case as in the figure. Neighbours follow from the unit by its own edges: l, p and n, q
    are L, I moved by HE and EH; u, v, w are F, L, G mirrored in the strip line E-I-H.
    """
    unit = fold_unit(pattern, travel_at(pattern, fold_angle))
    centre, period = unit["H"] / 2, unit["H"] - unit["E"]
    points = {name: point - centre for name, point in unit.items()}
    moved = {"l": points["L"] - period, "p": points["I"] - period}
    moved |= {"n": points["L"] + period, "q": points["I"] + period}
    mirrored = {key: points[name] * [-1, 1, 1] for key, name in zip("uvw", "FLG", strict=True)}
    return points | moved | mirrored


def trace_points(
    pattern: Miura, fold_angles: Sequence[float], names: Sequence[str]
) -> dict[str, np.ndarray]:
    """Trajectories (S, 3) [m] of named points, or of panel centres S1 ... S6, over S states."""
    states = [place_module(pattern, angle) for angle in fold_angles]
    corners = {name: tuple(PANELS.get(name, (name,))) for name in names}
    return {
        name: np.array([np.mean([at[corner] for corner in corners[name]], axis=0) for at in states])
        for name in names
    }
