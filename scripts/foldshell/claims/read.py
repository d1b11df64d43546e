"""Outcomes of designs from the files under results/<design>."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from foldshell.claims.design_result import DesignResult
from foldshell.claims.measures import Layout, measure_depth, measure_state
from foldshell.files.whole import read_arrays, read_json
from foldshell.pattern.angles import flat_foldability_residual
from foldshell.pattern.grid import build_grid
from foldshell.settings.crosscheck import Crosscheck
from foldshell.settings.stage import StageSettings

Errors = dict[str, tuple[float | None, float | None]]


def make_layout(row: Mapping[str, Any]) -> Layout:
    """Return counts of polylines and supports of a design."""
    return Layout(row["zigzag"], row["strip"], row["support"])


def read_fold(row: Mapping[str, Any], folder: str | Path) -> DesignResult:
    """Read what the folding alone says of a design."""
    folded = read_arrays(Path(folder, "folded/folded.npz"))
    quality = read_json(Path(folder, "folded/quality.json"))
    values = {"edge_strain_rms": quality["edge_strain_rms"]}
    if row["pattern"] == "miura":
        size = row["zigzag"], row["strip"]
        residual = flat_foldability_residual(folded["vertices"], build_grid(*size))
        quality["flat_foldability_max_rad"] = float(np.abs(residual).max())
        values["depth"] = measure_depth(folded["vertices"], *size)
    return DesignResult(row, values, quality=quality)


def read_design_result(
    row: Mapping[str, Any], folder: str | Path, settings: StageSettings
) -> tuple[DesignResult, DesignResult]:
    """Read the final state of a design, and its state at the start, of one thickness."""
    folder = Path(folder)
    fold = read_fold(row, folder)
    mesh = read_arrays(folder / "shell/mesh.npz")
    states = []
    for path in (folder / "sizing/final", folder / "sizing/00/analysis"):
        report, fields = read_json(path.with_suffix(".json")), read_arrays(path.with_suffix(".npz"))
        measures = measure_state(
            mesh,
            make_layout(row),
            report,
            fields,
            settings.combinations,
            settings.sizing.measure,
        )
        states.append(replace(fold, values={**fold.values, **measures}))
        if path.name == "final" and "utilization_panel_mean" in fields and "depth" in fold.values:
            planarity = read_arrays(folder / "folded/folded.npz")["planarity"]
            panels = np.stack([planarity, fields["utilization_panel_mean"]])
            states[0] = replace(states[0], panels=panels)
    errors = read_errors(folder, settings.crosscheck)
    return replace(states[0], errors=errors), replace(states[1], errors=errors)


def read_variant(design_result: DesignResult, report: Mapping[str, Any]) -> DesignResult:
    """Return the result under another setting, with the relative errors of the design."""
    return replace(design_result, values={**design_result.values, **report["measures"]})


def read_errors(folder: Path, chosen: Crosscheck) -> Errors:
    """Read relative mesh error and cross-check difference of the compared combinations."""
    study = read_json(folder / "mesh_convergence.json")
    comparison = read_json(folder / "crosscheck/comparison.json").get("quantities") or {}
    strength, deflection = chosen.strength, chosen.deflection

    def pick(combination: str, quantity: str) -> tuple[float | None, float | None]:
        """Return relative mesh error and cross-check difference of one quantity."""
        names = f"{combination} Th.II {quantity}", f"{combination} {quantity}"
        found = next((comparison[name] for name in names if name in comparison), {})
        own = (study.get("errors") or {}).get(combination, {})
        error = own.get(quantity)
        if error is None and found:
            error = _relative(found["primary_meshes"][0], found["primary"])
        return error, found.get("relative_difference")

    return {
        "displacement": pick(deflection, "displacement_down_max_m"),
        "utilization": pick(strength, "utilization_panel_mean_max"),
        "buckling": pick(strength, "buckling_factor"),
    }


def _relative(value: float, limit: float) -> float | None:
    return abs(value - limit) / abs(limit) if limit else None
