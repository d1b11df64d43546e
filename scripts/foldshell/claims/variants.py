"""A design under one changed setting: its loop anew, or the state that it delivered."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from foldshell.claims.measures import Layout, measure_state
from foldshell.claims.sensitivity import DELIVERED, SHEAR, change_settings
from foldshell.records.arrays import read_checked_arrays
from foldshell.records.comparison import ShearShare, read_comparison
from foldshell.records.iteration import read_iteration
from foldshell.records.measures import Measures
from foldshell.records.sheet_arrays import MeshArrays
from foldshell.settings.stage import StageSettings
from foldshell.sizing.case import open_case
from foldshell.sizing.delivery import analyse_delivered
from foldshell.sizing.loop import run_loop
from foldshell.workbook.panels import make_panel_grid, mirror_panels

SHEARED = {
    "displacement_down_max_m": ("displacement", "displacement_edge", "displacement_inner"),
    "utilization_panel_mean_max": ("utilization_panel_mean_max",),
}
"""Measures by the quantity whose share of shear deformation they take."""


def measure_variant(
    mesh_path: str | Path,
    variant: str,
    settings: StageSettings,
    span: float,
    layout: Layout,
    delivered: Sequence[str | Path],
) -> Measures:
    """Return what claims compare of the state that is delivered under a variant; span m.

    `delivered` are final.json, final.npz and comparison.json, for variants that do not size anew.
    Raises `InputError` for settings that do not go together and files that are damaged.
    """
    changed = change_settings(settings, variant)
    if variant == SHEAR:
        final, arrays = read_iteration(*delivered[:2])
    elif variant in DELIVERED:
        case = open_case(mesh_path, changed)
        final, arrays = analyse_delivered(case, span, *read_iteration(*delivered[:2]))
    else:
        limits = mirror_panels(
            make_panel_grid(layout.zigzag_count, layout.strip_count), changed.sizing.symmetry
        )
        result = run_loop(open_case(mesh_path, changed), span, changed.sizing, limits)
        final, arrays = result.final, result.arrays
    mesh = read_checked_arrays(mesh_path, MeshArrays)
    state = layout, final, arrays, changed.combinations, changed.sizing.measure
    measures = measure_state(mesh, *state)
    return (
        add_shear(measures, read_comparison(delivered[2]).shear) if variant == SHEAR else measures
    )


def add_shear(measures: Measures, shear: Mapping[str, ShearShare] | None) -> Measures:
    """Return the measures with the values that shear deformation gives, as far as it is known; a
    state that it takes past a limit is not converged."""
    found: dict[str, float | str] = {}
    if shear and any(one.turns for one in shear.values()):
        found["state"] = "not_converged"
    for key, names in SHEARED.items():
        if shear and key in shear:
            values = {name: getattr(measures, name) for name in names}
            factor = 1 + shear[key].share
            found |= {name: factor * value for name, value in values.items() if value is not None}
    return replace(measures, **found)
