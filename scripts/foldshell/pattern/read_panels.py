"""Any pattern or folded sheet from a file, by its suffix."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.formats import PATTERN_FORMATS
from foldshell.files.meshes.model import Mesh, count
from foldshell.files.meshes.nurbs import SAMPLED
from foldshell.files.meshes.read import FORMATS, read_mesh
from foldshell.files.units import FACTORS, agree_on_unit, find_factor, name_unit
from foldshell.pattern.line_graph import build_pattern
from foldshell.pattern.panel_graph import find_sides
from foldshell.pattern.panel_mesh import (
    OBTUSE,
    TOO_OBTUSE,
    WARPED,
    PanelMesh,
    measure_largest_angle,
    measure_warp,
)
from foldshell.pattern.panel_repair import repair_panels, say_place
from foldshell.pattern.read_any_fold import read_any_fold
from foldshell.pattern.read_dxf import read_dxf_lines
from foldshell.pattern.read_svg import read_svg_lines

PANEL_FORMATS = (*PATTERN_FORMATS, *FORMATS)
"""Suffixes of all files of patterns and folded sheets."""


def read_panels(path: str | Path, file_unit: str | None = None) -> PanelMesh:
    """Read a flat crease pattern (.fold, .svg, .dxf) or a folded sheet (.fold, any mesh file).

    `file_unit` is m, cm, mm, inch or feet; None takes what the file declares, else m. Coordinates
    come in m, and stand where they stood. Raises `InputError` for what cannot be mended.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in PANEL_FORMATS:
        raise InputError(f"{path}: suffix {suffix!r}: one of {', '.join(PANEL_FORMATS)} is allowed")
    if suffix == ".fold":
        mesh = read_any_fold(path, file_unit)
        return mesh if mesh.folded is None else _check_facets(path, mesh)
    if suffix in PATTERN_FORMATS:
        lines = read_svg_lines(path) if suffix == ".svg" else read_dxf_lines(path)
        unit = agree_on_unit(path, lines.unit, file_unit)
        try:
            return build_pattern(lines, unit)
        except InputError as error:
            raise InputError(f"{path}: {error}") from None
    return _check_facets(path, _read_folded(path, file_unit))


def _read_folded(path: str | Path, file_unit: str | None) -> PanelMesh:
    """A folded sheet from a mesh file: its polygons are the panels."""
    given = read_mesh(path, name_unit(file_unit))
    factor = find_factor(given.unit, file_unit)
    if SAMPLED in given.notes:
        raise InputError(f"{path}: {SAMPLED}: a folded sheet has planar faces or a mesh")
    try:
        mended = repair_panels(given, _has_triangles_alone(path, given))
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    edges, _, number = find_sides(mended.panels)
    letters = np.where(number == 1, "B", "U")
    return PanelMesh(
        mended.panels, edges, letters, np.full(len(edges), np.nan),
        folded=factor * mended.vertices, notes=(*given.notes, *mended.notes),
    )  # fmt: skip


def _has_triangles_alone(path: str | Path, mesh: Mesh) -> bool:
    """Whether a file holds panels as triangles for want of anything else."""
    suffix = Path(path).suffix.lower()
    return suffix == ".stl" or (suffix == ".3dm" and bool((np.diff(mesh.starts) == 3).all()))


def _check_facets(path: str | Path, mesh: PanelMesh) -> PanelMesh:
    """Say which panels are warped; refuse facets that no shell analysis can use."""
    notes = list(mesh.notes)
    warp = measure_warp(mesh.vertices, mesh.panels)
    bent = int((warp > WARPED).sum())
    if bent:
        notes.append(
            f"{count(bent, 'panel')} warped, by up to {100 * warp.max():.2g} % of the diagonal: "
            "cut into flat facets"
        )
    angle = measure_largest_angle(mesh.vertices, mesh.facets)
    worst = int(angle.argmax())
    words = (
        f"a facet of panel {mesh.facet_panel[worst]} near "
        f"{say_place(mesh.vertices[mesh.facets[worst]].mean(axis=0))} has an angle of "
        f"{math.degrees(angle[worst]):.0f} deg"
    )
    if angle[worst] > TOO_OBTUSE:
        raise InputError(
            f"{path}: {words}: at most {math.degrees(TOO_OBTUSE):.0f} deg are allowed, buckling "
            "factors would be far off"
        )
    if angle[worst] > OBTUSE:
        notes.append(f"{words}: buckling factors may be off")
    return replace(mesh, notes=tuple(notes))


__all__ = ["FACTORS", "PANEL_FORMATS", "read_panels"]
