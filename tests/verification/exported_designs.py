"""Designs of 28 m that exports are tried on: nine elastic ones, two exact, one of them with an edge
beam. Thickness is graded from panel to panel, so that every fold joins two thicknesses."""

import functools
from pathlib import Path
from tempfile import mkdtemp

import numpy as np

from export_cases import stage_settings
from foldshell.exchange.read_model import read_export_model
from foldshell.files.whole import read_arrays, write_arrays
from foldshell.folding.files import folded_arrays
from foldshell.folding.fold import fold_sheet
from foldshell.folding.targets import make_target, measure_turning
from foldshell.pattern.design import design_sheet
from foldshell.pattern.fold_format import write_fold
from foldshell.records.analysis import write_analysis
from foldshell.records.arrays import list_arrays
from foldshell.settings.fold import Fold
from foldshell.shell.edge_beams import EdgeBeam
from foldshell.shell.mesh_files import mesh_folded_sheet, write_mesh
from record_cases import make_analysis

SURFACES, SUPPORTS = ("paraboloid", "hypar", "arch"), ("all", "zigzag", "strip")
ELASTIC = tuple(f"{surface}-{support}" for surface in SURFACES for support in SUPPORTS)
NAMES = (*ELASTIC, "exact-hypar-zigzag", "exact-beam-paraboloid-strip")
COMPARED = ("paraboloid-all", "hypar-zigzag", "arch-strip")
"""Those on which displacement and buckling factor of other programs are compared."""


@functools.cache
def fold_design(surface, mode):
    """Return pattern sheet and arrays of folded.npz of a 28/10 design with 15 x 16 lines."""
    target = make_target(surface, 28.0, 10.0)
    turning = measure_turning(target)
    sheet = design_sheet("miura", target.section_lengths(), 15, 16, 60.0, 9, turning)
    return sheet, list_arrays(folded_arrays(sheet, fold_sheet(sheet, target, mode, Fold())))


@functools.cache
def export_design(name):
    """Return the export model of a design and the folder of its files."""
    *kind, surface, support = name.split("-")
    mode, beam = ("exact" if kind else "elastic"), "beam" in kind
    folder = Path(mkdtemp())
    sheet, folded = fold_design(surface, mode)
    write_fold(folder / "crease_pattern.fold", sheet, name)
    write_arrays(folder / "folded.npz", folded)
    edge_beam = EdgeBeam(0.6, 0.2) if beam else None
    write_mesh(folder / "mesh.npz", mesh_folded_sheet(folded, support, 4, edge_beam=edge_beam))
    count = len(folded["quads"])
    number = np.arange(count) % 4
    final = {"thickness": (0.06 + 0.02 * number).round(3)}
    strips = len(read_arrays(folder / "mesh.npz").get("fixed_thickness", ()))
    for key in ("utilization_panel_mean", "utilization_element_max"):
        final[key] = np.full(count, 0.5)
        if strips:
            final[f"edge_beam_{key}"] = np.full(strips, 0.5)
    write_arrays(folder / "final.npz", final)
    write_arrays(
        folder / "classes.npz", {"panel_class": 1 + number, "thickness": final["thickness"]}
    )
    write_analysis(folder / "final.json", make_analysis(verdict="converged"))
    paths = {role: folder / f"{role}.npz" for role in ("mesh", "folded", "final", "classes")}
    row = {"design": name, "surface": surface, "span_m": 28.0, "height_m": 10.0,
           "support": support, "fold_mode": mode}  # fmt: skip
    return read_export_model(
        {**paths, "report": folder / "final.json"}, row, stage_settings()
    ), folder
