"""From mesh and settings to what every analysis of a design shares."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from foldshell.checks.concrete.model import build_concrete_model
from foldshell.checks.measures import NEED_STRIPS
from foldshell.checks.strips import find_strips
from foldshell.files.errors import InputError
from foldshell.files.whole import hash_data, hash_file
from foldshell.loads.cases import make_load_cases
from foldshell.records.arrays import read_checked_arrays
from foldshell.records.sheet_arrays import MeshArrays
from foldshell.settings.sizing import REINFORCED
from foldshell.settings.stage import StageSettings
from foldshell.shell.analysis import place_on_model
from foldshell.shell.held_supports import build_supported_model
from foldshell.shell.mesh_files import mesh_from_arrays
from foldshell.sizing.constraints import NEED_CONSTRAINTS, least_factor_due
from foldshell.sizing.iteration import AnalysisCase

_LAST: dict[tuple[str, str], AnalysisCase] = {}
"""The case that `open_case` built last, by the hashes of mesh and settings."""


def open_case(mesh_path: str | Path, settings: StageSettings) -> AnalysisCase:
    """Read a mesh and build what depends on it and on the settings of the stage `analyse`.

    The last case is remembered: a process that goes on with the same mesh and settings has it at
    once, told by the contents of the file and not by its name.

    Raises
    ------
    InputError
        for supports that leave a mechanism, and loads that meet no panel.
    """
    key = hash_file(mesh_path), hash_data(settings.to_plain())
    if key not in _LAST:
        try:
            case = make_case(read_checked_arrays(mesh_path, MeshArrays), settings)
        except ValueError as error:
            raise InputError(f"{mesh_path}: {error}") from None
        _LAST.clear()
        _LAST[key] = case
    return _LAST[key]


def make_case(arrays: Mapping[str, np.ndarray], settings: StageSettings) -> AnalysisCase:
    """Build the same from the arrays of mesh.npz; raises `ValueError` for such supports,
    and for loads on a zone without panels."""
    material, sizing = settings.material, settings.sizing
    model = build_supported_model(mesh_from_arrays(arrays), arrays, material.poissons_ratio)
    cases = make_load_cases(settings.loads, material.unit_weight)
    asked = sizing.rule in NEED_CONSTRAINTS
    factor_min = least_factor_due(sizing) if asked else None
    notes = arrays.get("support_warnings")
    strips = concrete = None
    if sizing.measure in NEED_STRIPS:
        strips = find_strips(model.operators, settings.checks.strip_width)
    if sizing.measure == REINFORCED:
        asked, width = settings.reinforcement, settings.checks.strip_width
        concrete = build_concrete_model(model.operators, model.sized_panels, asked, width)
    groups = settings.combinations, settings.analysis, sizing
    words = () if notes is None else tuple(map(str, notes.tolist()))
    placed = place_on_model(model, cases)
    local = strips, concrete
    return AnalysisCase(model, material, cases, *groups, factor_min, words, placed, *local)
