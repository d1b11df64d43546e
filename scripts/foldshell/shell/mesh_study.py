"""Mesh error of the headline numbers: first-order analyses of one state on several meshes."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from foldshell.shell.analysis import AnalysisOptions, analyse_shell, build_model
from foldshell.shell.material import Material
from foldshell.shell.mesh_files import mesh_folded_sheet, mesh_from_arrays
from foldshell.shell.results import (
    area_percentile,
    compute_utilization,
    largest_downward,
    panel_utilization,
    support_reactions,
    translations,
)

ORDER = 2.0
"""Rate at which displacement, work and percentile are taken to converge from n to 2n: that of
the six folded sheets in tests/verification, where fold vertices hold the rate down."""

QUANTITIES = (
    "displacement_down_max_m",
    "displacement_max_m",
    "work_knm",
    "utilization_p99",
    "utilization_panel_mean_max",
)


def extrapolate(coarse: float, fine: float, ratio: float, order: float = ORDER) -> float:
    """Return the Richardson limit fine + (fine - coarse) / (ratio^order - 1)."""
    return fine + (fine - coarse) / (ratio**order - 1)


def study_mesh(
    folded: Mapping[str, np.ndarray],
    support: str,
    panel_thickness: np.ndarray,
    subdivisions: Sequence[int],
    material: Material,
    loads: Any,
    combinations: Mapping[str, Mapping[str, float]],
    solver: str = "cholmod",
) -> dict[str, Any]:
    """Return {quantity: [value a mesh]} of every combination, first order.

    Parameters
    ----------
    folded : arrays of folded.npz
    panel_thickness : (P,) m
    subdivisions : meshes, coarse to fine
    """
    found: dict[str, Any] = {name: {} for name in combinations}
    for count in subdivisions:
        values = _analyse(
            folded, support, panel_thickness, count, material, loads, combinations, solver
        )
        for name, quantities in values.items():
            for quantity, value in quantities.items():
                found[name].setdefault(quantity, []).append(value)
    return {"subdivisions": list(subdivisions), "combinations": found}


def estimate_errors(study: Mapping[str, Any], subdivisions: int) -> dict[str, dict[str, float]]:
    """Return the relative error of each quantity on the mesh with the given subdivisions.

    The limit is extrapolated from the last two meshes. {combination: {quantity: error}}.
    """
    meshes = study["subdivisions"]
    position, ratio = meshes.index(subdivisions), meshes[-1] / meshes[-2]
    return {
        name: {
            quantity: _relative(
                values[quantity][position],
                extrapolate(values[quantity][-2], values[quantity][-1], ratio),
            )
            for quantity in QUANTITIES
        }
        for name, values in study["combinations"].items()
    }


def _relative(value: float, limit: float) -> float:
    return abs(value - limit) / abs(limit) if limit else 0.0


def _analyse(folded, support, panel_thickness, count, material, loads, combinations, solver):
    """Analyse one mesh to first order; return {combination: {quantity: value}}."""
    arrays = mesh_folded_sheet(dict(folded), support, count)
    mesh = mesh_from_arrays(arrays)
    model = build_model(mesh, arrays["supported_nodes"], material.poissons_ratio)
    thickness = panel_thickness[mesh.panel]
    options = AnalysisOptions(second_order=False, solver=solver)
    result = analyse_shell(model, thickness, material, loads, combinations, options)
    used = compute_utilization(model, result.displacement, thickness, material).combination
    reactions = support_reactions(model, result, thickness, material).sum(axis=0)
    load = translations(model, result.loads).sum(axis=0)
    moved = translations(model, result.displacement)
    work = (result.displacement * result.loads).sum(axis=0)
    return {
        name: {
            "displacement_down_max_m": largest_downward(
                model, result.displacement[:, [column]], [name]
            )[0],
            "displacement_max_m": float(np.linalg.norm(moved[:, :, column], axis=1).max()),
            "work_knm": float(work[column]),
            "utilization_p99": area_percentile(model, used[column]),
            "utilization_panel_mean_max": float(
                panel_utilization(model, used[column].mean(axis=2), "panel_mean").max()
            ),
            "reaction_sum_kn": reactions[:, column].tolist(),
            "load_sum_kn": load[:, column].tolist(),
        }
        for column, name in enumerate(result.names)
    }
