"""Outcomes of designs from the files under results/<design>."""

from collections.abc import Mapping
from dataclasses import fields, replace
from pathlib import Path

import numpy as np

from foldshell.claims.design_result import DesignResult
from foldshell.claims.measures import (
    Layout,
    measure_depth,
    measure_panel_areas,
    measure_state,
    summarise_local,
)
from foldshell.pattern.angles import flat_foldability_residual
from foldshell.pattern.grid import build_grid
from foldshell.records.arrays import read_checked_arrays, read_typed_arrays
from foldshell.records.comparison import read_comparison
from foldshell.records.design_row import DesignRow
from foldshell.records.engineering import EngineeringRecord
from foldshell.records.files import read_record
from foldshell.records.iteration import read_iteration
from foldshell.records.measures import Geometry, VariantRecord
from foldshell.records.mesh_convergence import MeshConvergenceRecord
from foldshell.records.quality import QualityRecord
from foldshell.records.sheet_arrays import FoldedArrays, MeshArrays
from foldshell.settings.stage import StageSettings

Errors = dict[str, tuple[float | None, float | None]]


def make_layout(row: DesignRow) -> Layout:
    """Return counts of polylines and supports of a design."""
    return Layout(row.zigzag, row.strip, row.support)


def read_fold(row: DesignRow, folder: str | Path) -> DesignResult:
    """Read what the folding alone says of a design; raises `InputError` for a damaged file."""
    folded = read_typed_arrays(Path(folder, "folded/folded.npz"), FoldedArrays)
    quality = read_record(Path(folder, "folded/quality.json"), QualityRecord)
    values = Geometry(edge_strain_rms=quality.edge_strain_rms)
    if row.pattern == "miura":
        size = row.zigzag, row.strip
        residual = flat_foldability_residual(folded.vertices, build_grid(*size))
        values = replace(
            values,
            depth=measure_depth(folded.vertices, *size),
            flat_foldability_max_rad=float(np.abs(residual).max()),
        )
    return DesignResult(row, values, quality=quality)


def read_design_result(
    row: DesignRow, folder: str | Path, settings: StageSettings
) -> tuple[DesignResult, DesignResult]:
    """Read the final state of a design, and its state at the start, of one thickness."""
    folder = Path(folder)
    fold = read_fold(row, folder)
    mesh = read_checked_arrays(folder / "shell/mesh.npz", MeshArrays)
    last, first = (
        read_iteration(folder / f"sizing/{name}.json") for name in ("final", "00/analysis")
    )
    how = settings.combinations, settings.sizing.measure
    errors = read_errors(folder)
    measured = [measure_state(mesh, make_layout(row), *state, *how) for state in (last, first)]
    final, start = (
        replace(fold, values=replace(measures, **vars(fold.values)), errors=errors)
        for measures in measured
    )
    used = last[1].utilization_panel_mean
    if used is not None and fold.values.depth is not None:
        planarity = read_typed_arrays(folder / "folded/folded.npz", FoldedArrays).planarity
        final = replace(final, panels=np.stack([planarity, used]))
    strips = read_strips(folder / "checks/engineering.json", mesh, make_layout(row))
    return replace(final, warning=last[0].warning, strips=strips), start


def read_strips(
    path: Path, mesh: Mapping[str, np.ndarray], layout: Layout
) -> dict[str, float] | None:
    """Return the utilization of a final state by strips, None where the checks found none.

    `mesh` are the arrays of mesh.npz.
    """
    used = read_record(path, EngineeringRecord).panels.get("utilization_strip")
    area = measure_panel_areas(mesh, layout)
    if not used or len(used) != len(area):
        return None
    return summarise_local(np.array(used), area, "strip")


def read_variant(design_result: DesignResult, path: str | Path) -> DesignResult:
    """Return the result under another setting, with the geometry and errors of the design."""
    measures = read_record(path, VariantRecord).measures
    geometry = {one.name: getattr(design_result.values, one.name) for one in fields(Geometry)}
    return replace(design_result, values=replace(measures, **geometry))


def read_errors(folder: Path) -> Errors:
    """Read relative mesh error and cross-check difference of the combinations that govern.

    They are those of the comparison that govern displacement, utilization and buckling; without a
    comparison the largest mesh error stands.
    """
    errors = read_record(folder / "mesh_convergence.json", MeshConvergenceRecord).errors
    comparison = read_comparison(folder / "crosscheck/comparison.json")

    def pick(criterion: str, quantity: str) -> tuple[float | None, float | None]:
        """Return relative mesh error and cross-check difference of one quantity."""
        combination = (comparison.governing or {}).get(criterion)
        names = f"{combination} Th.II {quantity}", f"{combination} {quantity}"
        compared = comparison.quantities
        found = next((compared[name] for name in names if name in compared), None)
        own = [one for name, one in errors.items() if combination in (None, name)]
        error = max((one[quantity] for one in own if quantity in one), default=None)
        if error is None and found:
            error = _relative(found.primary_meshes[0], found.primary)
        return error, found and found.relative_difference

    return {
        "displacement": pick("displacement", "displacement_down_max_m"),
        "utilization": pick("utilization", "utilization_panel_mean_max"),
        "buckling": pick("buckling", "buckling_factor"),
    }


def _relative(value: float, limit: float) -> float | None:
    return abs(value - limit) / abs(limit) if limit else None
