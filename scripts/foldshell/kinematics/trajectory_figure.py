"""Picture of Fig. 1b: the module on its way, and what the rules differ by from the closed form."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from foldshell.files.whole import atomic_path
from foldshell.kinematics.geometric_rules import PANELS, place_module, trace_points
from foldshell.pattern.miura import Miura
from foldshell.records.kinematics import RuleDifference

STAGES_DEG = (0.0, 30.0, 54.7, 80.0)
HELD_DEG = 40.0  # the state with names and circles
CENTRES = {"S1": "tab:orange", "S3": "tab:blue", "S5": "tab:purple"}
POINTS = "EFGHIL"
MEASURES = {
    "vertices_max_m": "vertices, rules - closed form [m]",
    "edge_strain_max": "strain of edges and diagonals [-]",
    "planarity_max": "planarity of panels [-]",
    "angle_defect_max_rad": "vertex angle sum - 2$\\pi$ [rad]",
    "kawasaki_max_rad": "Kawasaki's alternating sum [rad]",
}
FLOOR = 1e-17  # where a difference of nothing is drawn on the logarithmic axis
REACH = 1e-12


def draw_trajectories(
    path: str | Path, sector_angle: float, differences: Sequence[RuleDifference]
) -> None:
    """Draw the module's trajectories, its stages and the table of differences as a PNG.

    `sector_angle` [rad] is the drawn module's; its panels are 1.0 by 1.2.
    """
    from matplotlib.figure import Figure

    pattern = Miura(1.0, 1.2, sector_angle, 3, 3)

    figure = Figure(figsize=(16, 10), layout="constrained")
    above, below = figure.subfigures(2, 1, height_ratios=(2.0, 1))
    left, right = above.subplots(1, 2, width_ratios=(1.45, 1))
    _draw_module(left, pattern)
    _draw_differences(right, differences)
    for axis, angle in zip(below.subplots(1, len(STAGES_DEG)), STAGES_DEG, strict=True):
        at = place_module(pattern, math.radians(angle))
        _draw_panels(axis, at)
        _draw_folds(axis, at)
        axis.set_title(f"fold angle {angle:g} deg")
        _frame(axis, pattern)
    with atomic_path(path) as temporary:
        figure.savefig(temporary, dpi=110, metadata={"Software": None})


def project(points: np.ndarray, azimuth: float = 16.0, elevation: float = 48.0) -> np.ndarray:
    """Parallel view (..., 2) [m] of points (..., 3) [m].

    `azimuth` and `elevation` [deg] say where the eye is, about the z axis from x and above level.
    """
    right, up, _ = _view_axes(azimuth, elevation)
    return points @ np.column_stack([right, up])


def _view_axes(azimuth: float = 16.0, elevation: float = 48.0) -> tuple[np.ndarray, ...]:
    """Unit vectors (3,) to the right, upward and towards the eye."""
    turn, rise = math.radians(azimuth), math.radians(elevation)
    eye = np.array(
        [math.cos(turn) * math.cos(rise), math.sin(turn) * math.cos(rise), math.sin(rise)]
    )
    right = np.array([-math.sin(turn), math.cos(turn), 0.0])
    return right, np.cross(eye, right), eye


def _draw_module(axis: Any, pattern: Miura) -> None:
    path = np.radians(np.linspace(0, 90, 91))
    flat, held = (place_module(pattern, math.radians(angle)) for angle in (0.0, HELD_DEG))
    for panel in PANELS.values():
        outline = project(np.array([flat[corner] for corner in panel + panel[0]]))
        axis.plot(*outline.T, color="0.6", lw=0.8, zorder=1)
    _draw_panels(axis, held)
    _draw_folds(axis, held)
    _draw_circles(axis, held)
    for curve in trace_points(pattern, path, POINTS).values():
        axis.plot(*project(curve).T, ":", color="0.2", lw=1.3, zorder=50)
    for name, curve in trace_points(pattern, path, list(CENTRES)).items():
        _draw_arrow(axis, project(curve), CENTRES[name], f"centre of {name}")
    _draw_drive(axis, flat)
    _name_points(axis, held)
    axis.plot([], [], ":", color="0.2", label="points E, F, G, H, I, L")
    axis.plot([], [], color="0.6", lw=0.8, label="flat module")
    axis.set_title(f"Reverse fold driven by E along V1 (Fig. 1b), panels at {HELD_DEG:g} deg")
    _frame(axis, pattern)
    axis.legend(loc="lower left", fontsize="small")


def _frame(axis: Any, pattern: Miura) -> None:
    """Give every drawing of the module the same window."""
    flat = project(np.array(list(place_module(pattern, 0.0).values())))
    margin = 0.12 * np.ptp(flat, axis=0)
    low, high = flat.min(axis=0) - margin, flat.max(axis=0) + margin
    axis.set(xlim=(low[0], high[0]), ylim=(low[1], high[1] + margin[1]), aspect="equal")
    axis.axis("off")


def _draw_panels(axis: Any, at: dict[str, np.ndarray]) -> None:
    """Draw the panels, far ones first."""
    eye = _view_axes()[2]
    corners = {name: np.array([at[corner] for corner in panel]) for name, panel in PANELS.items()}
    far_first = sorted(corners, key=lambda name: float(np.mean(corners[name] @ eye)))
    for rank, name in enumerate(far_first):
        axis.fill(
            *project(corners[name]).T, zorder=10 + rank, facecolor=CENTRES.get(name, "0.8"),
            alpha=0.45, edgecolor="k", lw=1.0,
        )  # fmt: skip


def _draw_folds(axis: Any, at: dict[str, np.ndarray]) -> None:
    """Valleys EF and HG red, mountain IL green, as in the paper."""
    for edge, colour in (("EF", "tab:red"), ("HG", "tab:red"), ("IL", "tab:green")):
        line = project(np.array([at[end] for end in edge]))
        axis.plot(*line.T, color=colour, lw=2.6, zorder=40)


def _draw_arrow(axis: Any, curve: np.ndarray, colour: str, label: str) -> None:
    axis.plot(*curve.T, color=colour, lw=2.4, zorder=60, label=label)
    axis.annotate(
        "", xy=curve[-1], xytext=curve[-6], zorder=61,
        arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 2.4, "mutation_scale": 16},
    )  # fmt: skip


def _draw_drive(axis: Any, flat: dict[str, np.ndarray]) -> None:
    """Vectors V1 and V2 along which E and H come together."""
    for name, end, start in (("V1", "E", "H"), ("V2", "H", "E")):
        ahead = flat[end] + 0.32 * (flat[start] - flat[end])
        axis.annotate(
            "", xy=project(ahead), xytext=project(flat[end]), zorder=62,
            arrowprops={"arrowstyle": "-|>", "color": "k", "lw": 1.6},
        )  # fmt: skip
        axis.annotate(name, project(ahead), (0, 5), textcoords="offset points", zorder=62)


def _draw_circles(axis: Any, at: dict[str, np.ndarray]) -> None:
    """Paths c and d of P about K1 and K2: circles at right angles to EF and HG."""
    turn = np.linspace(0, np.pi, 91)[:, None]
    for foot, edge, name in (("K1", "EF", "c"), ("K2", "HG", "d")):
        along = at[edge[1]] - at[edge[0]]
        along = along / np.linalg.norm(along)
        radius = float(np.linalg.norm(at["I"] - at[foot]))
        level = np.cross(along, [0.0, 0.0, 1.0])
        circle = project(
            at[foot] + radius * (np.cos(turn) * level + np.sin(turn) * np.array([0.0, 0.0, 1.0]))
        )
        axis.plot(*circle.T, color="0.45", lw=0.9, zorder=45)
        spoke = project(np.array([at[foot], at["I"]]))
        axis.plot(*spoke.T, "--", color="0.45", lw=0.9, zorder=45)
        axis.plot(*project(at[foot]), "o", color="0.3", ms=4, zorder=46)
        axis.annotate(foot, project(at[foot]), (5, -12), textcoords="offset points", zorder=71)
        axis.annotate(
            name,
            circle[30 if name == "c" else 60],
            (3, 3),
            textcoords="offset points",
            style="italic",
        )


def _name_points(axis: Any, at: dict[str, np.ndarray]) -> None:
    for name in POINTS:
        place = project(at[name])
        axis.plot(*place, "o", color="k", ms=4, zorder=70)
        shown = "I = P" if name == "I" else name
        axis.annotate(shown, place, (5, 6), textcoords="offset points", weight="bold", zorder=71)
    for name, panel in PANELS.items():
        centre = project(np.mean([at[corner] for corner in panel], axis=0))
        axis.annotate(name, centre, ha="center", va="center", fontsize=11, zorder=72)


def _draw_differences(axis: Any, differences: Sequence[RuleDifference]) -> None:
    """Every measure of every sheet over the fold angle, as marks on a logarithmic axis."""
    angles = [row.fold_angle_deg for row in differences]
    for (key, words), mark in zip(MEASURES.items(), "os^Dv", strict=True):
        values = [max(getattr(row, key), FLOOR) for row in differences]
        axis.plot(angles, values, mark, ms=4, alpha=0.6, label=words)
    axis.axhline(REACH, color="k", lw=1, ls="--")
    axis.annotate("to be reached: 1e-12", (1, REACH * 1.3))
    axis.set(
        yscale="log", ylim=(FLOOR / 2, 1e-10), xlabel="fold angle of a facet [deg]",
        ylabel="largest on the sheet; 1e-17 stands for 0",
        title="Rules against closed form, from flat to folded flat",
    )  # fmt: skip
    axis.legend(loc="upper right", fontsize="small")
