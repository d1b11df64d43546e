"""The flat state of a folded sheet as a FOLD file and a drawing."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.folding.cut_files import read_exact_cut
from foldshell.folding.exact_panels import CLOSURE
from foldshell.folding.net import make_net
from foldshell.folding.panel_path import follow_net
from foldshell.pattern.drawings import Drawing, draw_pattern
from foldshell.pattern.fold_format import read_fold, write_fold
from foldshell.pattern.folded_panels import KINDS, list_panels
from foldshell.pattern.panel_drawings import draw_panels
from foldshell.pattern.panel_fold_format import write_panel_fold
from foldshell.pattern.panel_mesh import PanelMesh
from foldshell.pattern.sheet import Frame
from foldshell.pattern.unfold import check_same_vertices, describe_true_sheet, name_flat_state
from foldshell.pattern.unfold_panels import unfold_net
from foldshell.records.sheet_arrays import FoldedArrays


def unfold_grid(
    pattern_path: str | Path,
    folded_path: str | Path,
    fold_path: str | Path,
    folded: FoldedArrays,
    design: str,
    fold_mode: str,
    frames: int,
    scale: float,
) -> Drawing:
    """Write the FOLD file of a sheet of zig-zags and strips; return its drawing."""
    sheet = read_fold(pattern_path)
    check_same_vertices(sheet, folded, folded_path, pattern_path)
    parts = np.linspace(0.0, 1.0, frames + 1)[:-1]
    true = describe_true_sheet(sheet, folded.flat, folded.vertices, parts)
    title = f"{design}, {name_flat_state(sheet.grid, folded, fold_mode)}"
    write_fold(fold_path, true, title)
    return draw_pattern(true.flat, true.grid, scale, title)


def unfold_panels(
    folded: FoldedArrays,
    fold_path: str | Path,
    design: str,
    fold_mode: str,
    scale: float,
    frames: int = 0,
) -> Drawing:
    """Write the FOLD file of panels that are no grid, of a cut sheet its pieces; return the
    drawing.

    Of a true sheet that is whole the file has `frames` states of its way from flat to its shape.
    Raises `InputError` for a sheet that was folded already and cannot be unfolded.
    """
    exact = read_exact_cut(folded)
    mesh = _take_panels(folded) if exact is None else exact
    made = "unfolded" if fold_mode in ("exact", "rigid") else "the given pattern"
    title = f"{design}, {made}" + (", cut to its outline" if exact else "")
    true = exact is None and fold_mode in ("exact", "rigid")
    write_panel_fold(fold_path, mesh, title, _list_way(mesh, frames, fold_mode) if true else ())
    if exact is not None:  # lines inside a panel are no creases that anyone scores
        scored = mesh.assignments != "F"
        mesh = replace(mesh, edges=mesh.edges[scored], assignments=mesh.assignments[scored])
    return draw_panels(mesh, scale, title)


def _take_panels(folded: FoldedArrays) -> PanelMesh:
    letters = np.array(KINDS)[folded.edge_kind]
    angles = np.full(len(letters), np.nan)
    panels, flat = list_panels(folded), folded.flat
    if flat is None:
        found = unfold_net(folded.vertices, panels, folded.vertices)
        if not found.closure <= CLOSURE * max(float(np.ptp(folded.vertices, axis=0).max()), 1.0):
            raise InputError(
                f"its panels part by {found.closure:.2g} m when they are laid flat one by one: the "
                "sheet cannot be unfolded"
            )
        flat = found.vertices
    return PanelMesh(panels, folded.edges, letters, angles, flat=flat, folded=folded.vertices)


def _list_way(mesh: PanelMesh, frames: int, fold_mode: str) -> tuple[Frame, ...]:
    parts = np.linspace(0.0, 1.0, frames + 1)[:-1]
    if not len(parts):
        return ()
    way = follow_net(make_net(mesh), mesh.flat, mesh.folded, parts, fold_mode == "rigid")
    pairs = zip(parts, way.states, strict=True)
    return tuple(Frame(f"path {part:.3f}", state) for part, state in pairs)
