"""Panels of a design that are no grid of zig-zags and strips: from a file, or by a generator."""

import math
from dataclasses import replace
from pathlib import Path
from typing import Protocol

import numpy as np

from foldshell.files.errors import InputError
from foldshell.pattern.angles import measure_hinges
from foldshell.pattern.drawings import write_drawings
from foldshell.pattern.generators import (
    make_accordion,
    make_fan,
    make_resch,
    make_waterbomb,
    make_yoshimura,
)
from foldshell.pattern.grid import find_hinges
from foldshell.pattern.panel_drawings import draw_panels
from foldshell.pattern.panel_fold_format import write_panel_fold
from foldshell.pattern.panel_mesh import PanelMesh
from foldshell.pattern.read_panels import read_panels
from foldshell.pattern.unfold_panels import unfold_net
from foldshell.settings.design import NONE
from foldshell.settings.exports import Drawings


class Sections(Protocol):
    """What a pattern is sized for."""

    def section_lengths(self) -> tuple[float, float]:
        """Arc lengths [m] of the central sections along x and y."""
        ...


UNFOLDED = 1e-4  # gap over the size, of panels laid flat, up to which files of others unfold
FOLDED_ANGLE = math.radians(1)  # from which on an edge of a folded state is a crease
GENERATORS = {
    "accordion": (make_accordion, {"rest_fold_angle_deg": "fold_angle"}),
    "fan": (make_fan, {"opening_angle_deg": "opening"}),
    "yoshimura": (make_yoshimura, {"take_up": "take_up"}),
    "waterbomb": (make_waterbomb, {"take_up": "take_up"}),
    "resch": (make_resch, {"take_up": "take_up"}),
}
"""Generators by pattern, and their parameters by column."""


def read_folded(path: str | Path, file_unit: str) -> PanelMesh:
    """Read a sheet that is folded already; raises `InputError` for a flat one."""
    mesh = read_panels(path, file_unit)
    if mesh.folded is None:
        raise InputError(f"{path}: a flat sheet: name it in the column pattern, or fold it first")
    return mesh


def read_pattern(path: str | Path, file_unit: str) -> PanelMesh:
    """Read a flat crease pattern; of a file with folded states too, the flat one is taken.

    A file that has folded states alone is unfolded, and its folds are the rest angles. Raises
    `InputError` for one that cannot be.
    """
    mesh = read_panels(path, file_unit)
    return replace(mesh, folded=None) if mesh.flat is not None else _unfold(path, mesh)


def _unfold(path: str | Path, mesh: PanelMesh) -> PanelMesh:
    found = unfold_net(mesh.vertices, mesh.panels, mesh.vertices)
    size = float(np.ptp(mesh.vertices, axis=0).max())
    if not found.closure <= UNFOLDED * size:
        raise InputError(
            f"{path}: holds no flat sheet, and its panels part by {found.closure:.2g} m when they "
            "are laid flat one by one: name it in the column folded"
        )
    hinges = find_hinges(mesh.facets, mesh.edges)
    angles = np.full(len(mesh.edges), np.nan)
    angles[hinges.edges] = measure_hinges(mesh.vertices, hinges.vertices)
    letters = np.where(angles < -FOLDED_ANGLE, "M", np.where(angles > FOLDED_ANGLE, "V", "F"))
    letters = np.where(mesh.assignments == "B", "B", letters)
    note = f"unfolded from its folded state, where panels part by {found.closure:.1g} m"
    return replace(
        mesh, flat=found.vertices, rest=None, folded=None, assignments=letters,
        fold_angles=angles, notes=(*mesh.notes, note),
    )  # fmt: skip


def write_panel_pattern(
    mesh: PanelMesh,
    fold_path: str | Path,
    dxf_path: str | Path | None,
    svg_path: str | Path | None,
    design: str,
    style: Drawings,
) -> None:
    """Write panels as a FOLD file and, where paths are given, as drawings [mm]."""
    drawing = draw_panels(mesh, style.scale, f"{design}, crease pattern")
    write_drawings(drawing, dxf_path, svg_path, style.preset)
    write_panel_fold(fold_path, mesh, design)


def make_panels(
    pattern: str,
    folded: str,
    file_unit: str,
    target: Sections | None,
    counts: tuple[int, int],
    **form: float,
) -> PanelMesh:
    """Return the panels of a design, from its file or by a generator.

    Generators size it for the central sections of a target; `counts` are zigzag and strip, `form`
    the parameters of patterns by their columns, 0 where a pattern has its own. Raises `ValueError`.
    """
    if folded != NONE:
        return read_folded(folded, file_unit)
    if pattern not in GENERATORS:
        return read_pattern(pattern, file_unit)
    make, names = GENERATORS[pattern]
    given = {
        name: math.radians(form[column]) if column.endswith("_deg") else form[column]
        for column, name in names.items() if form.get(column)
    }  # fmt: skip
    return make(target.section_lengths(), *counts, **given)
