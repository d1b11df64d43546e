"""One figure of the kinematics study: ratios, isometries, force strengths."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from foldshell.files.whole import atomic_path
from foldshell.pattern.miura import poissons_ratio
from foldshell.records.kinematics import ForceRatioTrial, KinematicsRecord, SheetRecord

SHAPES = ("twist", "saddle", "arch", "arch_strip", "dome")
FLOOR = 1e-16  # where a residual of nothing is drawn on the logarithmic axis


def draw_kinematics(path: str | Path, table: KinematicsRecord) -> None:
    """Draw the table that `scripts/kinematics.py` writes as a PNG of four panels."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13, 8), layout="constrained")
    axes = figure.subplots(2, 2)
    _draw_ratios(axes[0, 0], table)
    _draw_isometries(axes[0, 1], table.sheets)
    for axis, kind in zip(axes[1], ("quadrilaterals", "triangles"), strict=True):
        _draw_force_ratios(axis, table.force_ratios, kind)
    with atomic_path(path) as temporary:
        figure.savefig(temporary, dpi=110, metadata={"Software": None})


def _draw_ratios(axis, table: KinematicsRecord) -> None:
    gamma = np.radians(table.sector_angle_deg)
    angle = np.linspace(5, 85, 161)
    exact = np.array([poissons_ratio(gamma, np.radians(a)) for a in angle])
    axis.plot(angle, exact, "k-", lw=1, label="closed form")
    axis.plot(angle, -exact, "k-", lw=1)
    rows = table.ratios
    for key, mark in (("in_plane", "o"), ("bending", "s")):
        axis.plot(
            [row.fold_angle_deg for row in rows], [getattr(row, key) for row in rows], mark,
            label=f"{key.replace('_', ' ')}, measured",
        )  # fmt: skip
    axis.set(xlabel="fold angle [deg]", ylabel="Poisson's ratio [-]", title="Auxetic in plane")
    axis.axhline(0, color="0.7", lw=0.8)
    axis.legend()


def _draw_isometries(axis, sheets: Sequence[SheetRecord]) -> None:
    place = np.arange(len(SHAPES))
    width = 0.8 / len(sheets)
    for number, sheet in enumerate(sheets):
        values = [max(sheet.isometry_residual[shape], FLOOR) for shape in SHAPES]
        axis.bar(
            place + (number - (len(sheets) - 1) / 2) * width, values, width,
            label=f"{sheet.zigzag} x {sheet.strip}",
        )  # fmt: skip
    axis.set_yscale("log")
    axis.set_xticks(place, SHAPES)
    axis.set(ylabel="share missed without stretching [-]", title="Shapes a sheet can follow")
    axis.legend(title="zig-zags x strips")


def _draw_force_ratios(axis, rows: Sequence[ForceRatioTrial], kind: str) -> None:
    """One mark per trial: shape by surface, colour by outcome, hollow for the explicit engine."""
    rows = [row for row in rows if row.panels == kind]
    for surface, mark in (("paraboloid", "o"), ("hypar", "^")):
        for folded, colour in ((True, "tab:blue"), (False, "tab:orange")):
            for explicit in (False, True):
                shown = [
                    row for row in rows
                    if row.surface == surface and row.folded == folded
                    and (row.engine == "averaged_projections") == explicit
                ]  # fmt: skip
                outcome = "reached, panels kept" if folded else "missed or sheared"
                axis.scatter(
                    [row.rms_over_span for row in shown],
                    [max(row.shear_max, 1e-4) for row in shown],
                    marker=mark, edgecolors=colour, alpha=0.7, s=40,
                    facecolors="none" if explicit else colour,
                    label=None if explicit else f"{surface}, {outcome}",
                )  # fmt: skip
    axis.scatter([], [], edgecolors="k", facecolors="none", label="hollow: averaged projections")
    axis.set(
        xscale="log", yscale="log", title=f"Force strengths on {kind}",
        xlabel="rms distance to target / span [-]", ylabel="largest strain of a diagonal [-]",
        xlim=(1e-7, 0.2), ylim=(1e-4, 2),
    )  # fmt: skip
    axis.legend(fontsize="small", loc="lower left")
