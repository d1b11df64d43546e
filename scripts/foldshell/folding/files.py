"""Files of a folded sheet: folded.npz, folded.vtu, quality.json."""

from dataclasses import asdict
from pathlib import Path

import numpy as np

from foldshell.files.whole import atomic_path
from foldshell.folding.fold import FoldResult
from foldshell.folding.quality import measure_planarity, measure_strain
from foldshell.pattern.sheet import Sheet
from foldshell.records.arrays import write_typed_arrays
from foldshell.records.files import write_record
from foldshell.records.quality import QualityRecord
from foldshell.records.sheet_arrays import FoldedArrays


def describe_quality(result: FoldResult) -> QualityRecord:
    """Build the record of quality.json: state, measures, effort, residuals of the mode."""
    return QualityRecord(
        state=result.state,
        reason=result.reason,
        **asdict(result.quality),
        **result.shape.residuals,
        iterations=result.shape.iterations,
        seconds=round(result.seconds, 4),
    )


def write_quality(path: str | Path, result: FoldResult) -> None:
    """Write quality.json."""
    write_record(path, describe_quality(result))


def folded_arrays(sheet: Sheet, result: FoldResult) -> FoldedArrays:
    """Return the contents of folded.npz."""
    grid, shape = sheet.grid, result.shape
    return FoldedArrays(
        vertices=shape.vertices,
        quads=grid.quads,
        facets=grid.facets,
        zigzag=grid.zigzag_index,
        strip=grid.strip_index,
        flat=shape.flat,
        planarity=measure_planarity(shape.vertices, grid.quads),
        strain=measure_strain(shape.vertices, shape.flat, grid.facets),
        surface=shape.surface,
    )


def write_folded(path: str | Path, sheet: Sheet, result: FoldResult) -> None:
    """Write folded.npz."""
    write_typed_arrays(path, folded_arrays(sheet, result))


def write_folded_vtu(path: str | Path, sheet: Sheet, result: FoldResult) -> None:
    """Write folded.vtu: facets with panel, indices, planarity and strain; distance at vertices.

    `distance` [m] is signed along the target's normal; `attracted` is 1 where it was to be 0.
    """
    import meshio  # only here: the stages that follow read folded.npz

    grid, shape = sheet.grid, result.shape
    panel = np.repeat(np.arange(grid.panels), 2)
    attracted = np.zeros(len(shape.vertices), dtype=int)
    attracted[result.attracted] = 1
    mesh = meshio.Mesh(
        shape.vertices,
        [("triangle", grid.facets)],
        point_data={
            "distance": result.distances,
            "attracted": attracted,
            "zigzag": grid.zigzag_index,
            "strip": grid.strip_index,
        },
        cell_data={
            "panel": [panel],
            "panel_zigzag": [grid.zigzag_index[grid.quads[panel, 0]]],
            "panel_strip": [grid.strip_index[grid.quads[panel, 0]]],
            "planarity": [measure_planarity(shape.vertices, grid.quads)[panel]],
            "strain": [measure_strain(shape.vertices, shape.flat, grid.facets)],
        },
    )
    with atomic_path(path) as temporary:
        meshio.write(temporary, mesh, file_format="vtu")
