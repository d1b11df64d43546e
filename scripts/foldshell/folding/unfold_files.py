"""The flat state of a folded sheet as a FOLD file and a drawing."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.folding.cut_files import read_exact_cut
from foldshell.pattern.drawings import Drawing, draw_pattern
from foldshell.pattern.fold_format import read_fold, write_fold
from foldshell.pattern.folded_panels import KINDS, list_panels
from foldshell.pattern.panel_drawings import draw_panels
from foldshell.pattern.panel_fold_format import write_panel_fold
from foldshell.pattern.panel_mesh import PanelMesh
from foldshell.pattern.unfold import describe_true_sheet, name_flat_state
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
    if (count := len(folded.vertices)) != (due := len(sheet.flat)):
        raise InputError(f"{folded_path}: vertices: {count}: must be {due} as in {pattern_path}")
    parts = np.linspace(0.0, 1.0, frames + 1)[:-1]
    true = describe_true_sheet(sheet, folded.flat, folded.vertices, parts)
    title = f"{design}, {name_flat_state(sheet.grid, folded, fold_mode)}"
    write_fold(fold_path, true, title)
    return draw_pattern(true.flat, true.grid, scale, title)


def unfold_panels(
    folded: FoldedArrays, fold_path: str | Path, design: str, fold_mode: str, scale: float
) -> Drawing:
    """Write the FOLD file of panels that are no grid, of a cut sheet its pieces; return the
    drawing."""
    exact = read_exact_cut(folded)
    mesh = _take_panels(folded) if exact is None else exact
    made = "unfolded" if fold_mode in ("exact", "rigid") else "the given pattern"
    title = f"{design}, {made}" + (", cut to its outline" if exact else "")
    write_panel_fold(fold_path, mesh, title)
    if exact is not None:  # lines inside a panel are no creases that anyone scores
        scored = mesh.assignments != "F"
        mesh = replace(mesh, edges=mesh.edges[scored], assignments=mesh.assignments[scored])
    return draw_panels(mesh, scale, title)


def _take_panels(folded: FoldedArrays) -> PanelMesh:
    letters = np.array(KINDS)[folded.edge_kind]
    angles = np.full(len(letters), np.nan)
    panels = list_panels(folded)
    return PanelMesh(
        panels, folded.edges, letters, angles, flat=folded.flat, folded=folded.vertices
    )
