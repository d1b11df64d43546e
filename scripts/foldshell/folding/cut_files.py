"""Files of a sheet that is cut by an outline: folded.npz, folded.vtu, quality.json."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from foldshell.files.meshes.triangles import split_polygons
from foldshell.files.whole import atomic_path
from foldshell.folding.cut_panels import CutPanels, cut_panels
from foldshell.folding.files import describe_quality
from foldshell.folding.fold import FoldResult
from foldshell.folding.panel_files import FoldedPanels, describe_panels, mesh_arrays
from foldshell.folding.panel_quality import measure_facet_strain
from foldshell.pattern.folded_panels import KINDS, number_kinds
from foldshell.pattern.outline import Outline
from foldshell.pattern.panel_graph import Ragged
from foldshell.pattern.panel_mesh import PanelMesh
from foldshell.pattern.sheet import Sheet
from foldshell.pattern.sheet_panels import make_sheet_panels
from foldshell.records.arrays import write_typed_arrays
from foldshell.records.files import write_record
from foldshell.records.quality import QualityRecord
from foldshell.records.sheet_arrays import FoldedArrays


def cut_folded_sheet(sheet: Sheet, result: FoldResult, outline: Outline) -> CutPanels:
    """Cut a folded sheet of zig-zags and strips. Raises `InputError`, see `cut_panels`."""
    mesh = make_sheet_panels(sheet, result.shape.vertices, result.shape.flat)
    panel = np.repeat(np.arange(sheet.grid.panels), 2)
    return cut_panels(mesh, sheet.grid.facets, panel, outline)


def cut_folded_panels(result: FoldedPanels, outline: Outline) -> CutPanels:
    """Cut a folded sheet of any panels. Raises `InputError`, see `cut_panels`."""
    mesh = replace(result.mesh, folded=result.mesh.vertices)
    return cut_panels(mesh, result.net.facets, result.net.facet_panel, outline)


def cut_arrays(cut: CutPanels, outline: Outline) -> FoldedArrays:
    """Return the contents of folded.npz: the panels that are analysed, and the exact pieces."""
    exact = cut.exact
    return replace(
        mesh_arrays(cut.shell, cut.facets, cut.facet_panel),
        outline=outline.outer,
        cut_vertices=exact.vertices,
        cut_flat=exact.flat,
        cut_starts=exact.panels.starts,
        cut_corners=exact.panels.corners,
        cut_panel=cut.piece_panel,
        cut_edges=exact.edges,
        cut_edge_kind=number_kinds(exact.assignments),
    )


def read_exact_cut(folded: FoldedArrays) -> PanelMesh | None:
    """Return the exact pieces of folded.npz, None of a sheet that is not cut."""
    if folded.cut_vertices is None:
        return None
    letters = np.array(KINDS)[folded.cut_edge_kind]
    return PanelMesh(
        Ragged(folded.cut_starts, folded.cut_corners),
        folded.cut_edges,
        letters,
        np.full(len(letters), np.nan),
        flat=folded.cut_flat,
        folded=folded.cut_vertices,
        labels={"panel": folded.cut_panel},
    )


def describe_cut(result: FoldResult | FoldedPanels, cut: CutPanels) -> QualityRecord:
    """Return the record of quality.json: that of the whole sheet, and what was cut of it."""
    whole = isinstance(result, FoldedPanels)
    record = describe_panels(result) if whole else describe_quality(result)
    notes = (*(record.notes or ()), *cut.shell.notes)
    return replace(
        record,
        outline_overlap=cut.exact_share,
        outline_overlap_shell=cut.shell_share,
        outline_covered=cut.covered,
        notes=tuple(dict.fromkeys(notes)) or None,
    )


def write_cut(
    folded: str | Path,
    vtu: str | Path,
    quality: str | Path,
    result: FoldResult | FoldedPanels,
    cut: CutPanels,
    outline: Outline,
) -> None:
    """Write folded.npz, folded.vtu of the exact pieces, and quality.json."""
    write_typed_arrays(folded, cut_arrays(cut, outline))
    _write_vtu(vtu, cut)
    write_record(quality, describe_cut(result, cut))


def _write_vtu(path: str | Path, cut: CutPanels) -> None:
    import meshio  # only here: the stages that follow read folded.npz

    exact = cut.exact
    facets, piece = split_polygons(exact.vertices, exact.panels.starts, exact.panels.corners)
    cells = {"panel": [cut.piece_panel[piece]], "piece": [piece]}
    cells["panel_of_whole"] = [exact.labels["parent"][piece]]
    strain = measure_facet_strain(exact, facets)
    if strain is not None:
        cells["strain"] = [strain]
    grid = meshio.Mesh(exact.vertices, [("triangle", facets)], cell_data=cells)
    with atomic_path(path) as temporary:
        meshio.write(temporary, grid, file_format="vtu")
