"""Panels of a design that are no grid of zig-zags and strips: from a file, or by a generator."""

import math
from dataclasses import replace
from pathlib import Path
from typing import Protocol

from foldshell.files.errors import InputError
from foldshell.pattern.drawings import write_drawings
from foldshell.pattern.generators import (
    make_accordion,
    make_fan,
    make_resch,
    make_waterbomb,
    make_yoshimura,
)
from foldshell.pattern.panel_drawings import draw_panels
from foldshell.pattern.panel_fold_format import write_panel_fold
from foldshell.pattern.panel_mesh import PanelMesh
from foldshell.pattern.read_panels import read_panels
from foldshell.settings.design import NONE
from foldshell.settings.exports import Drawings


class Sections(Protocol):
    """What a pattern is sized for."""

    def section_lengths(self) -> tuple[float, float]:
        """Arc lengths [m] of the central sections along x and y."""
        ...


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

    Raises `InputError` for a file without a flat state.
    """
    mesh = read_panels(path, file_unit)
    if mesh.flat is None:
        raise InputError(
            f"{path}: holds no flat sheet: name it in the column folded, or unfold it first"
        )
    return replace(mesh, folded=None)


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
