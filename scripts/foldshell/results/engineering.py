"""The engineering verdict on a final state: what engineering.json and engineering.npz hold."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from foldshell.checks.materials import CONCRETE, choose_strength_check
from foldshell.checks.stability import correct_factor, require_factor
from foldshell.checks.strips import largest_of_panels, utilization_of_strips
from foldshell.checks.verdict import Found, hold_against, judge_checks, unknown_check
from foldshell.records.engineering import EngineeringCheck
from foldshell.records.mesh_convergence import MeshConvergenceRecord
from foldshell.results.engineering_state import EngineeringState
from foldshell.results.reinforcement import Reinforced
from foldshell.settings.checks import Checks
from foldshell.shell.analysis import AnalysisResult
from foldshell.shell.results import translations
from foldshell.shell.stress import StressResultants

FLAT = 1e-3
"""A shell that rises by less than this part of its span has no height to limit sway by."""


@dataclass(frozen=True)
class Judged:
    """The verdict with its checks; `used` (P + B, c) utilization of panels by strips, empty where
    there is none."""

    verdict: str
    reason: str
    checks: Mapping[str, EngineeringCheck]
    used: np.ndarray


def judge_state(
    state: EngineeringState,
    checks: Checks,
    span: float,
    errors: MeshConvergenceRecord,
    warnings: Sequence[str],
    reinforced: Reinforced | None = None,
) -> Judged:
    """Hold a final state against every check of its material; span m.

    `errors` are those of the mesh, `warnings` what theory or mesh does not hold, `reinforced` what
    steel there is: with it the strength of plain concrete is for information.
    """
    material, none = state.case.material, np.empty((0, 0))
    check = choose_strength_check(material, checks.partial_factor)
    if state.resultants is None:
        return Judged("fails", f"mechanism: {state.short.reason}", {}, none)
    used = find_utilization(state, checks)
    found = {
        "strength": _check_strength(state, used, check.words, errors),
        **_check_stability(state, checks, errors),
        **_check_displacements(state, checks, span, errors),
        "model_warnings": hold_against(
            "model, bounds of theory and mesh that are passed", Found(float(len(warnings))), None
        ),
    }
    failures = {}
    if reinforced is not None:
        found["strength"] = replace(found["strength"], limit=None, met=None,
                                    within_mesh_error=False)  # fmt: skip
        found |= reinforced.checks
        failures["reinforced_fit"] = reinforced.fit
        if reinforced.refused:
            failures["reinforcement"] = f"reinforcement: {reinforced.refused}"
            found["reinforcement"] = unknown_check(failures["reinforcement"], 1.0)
    above = int((used.max(axis=1) > 1).sum())
    words = f"{check.failure} in {above} of {len(used)} panels"
    return Judged(*judge_checks(found, {"strength": words, **failures}), found, used)


def find_utilization(state: EngineeringState, checks: Checks) -> np.ndarray:
    """Return the largest of facets and strips of each panel, (P + B, c) of c strength
    combinations, without unit."""
    check = choose_strength_check(state.case.material, checks.partial_factor)
    count = state.strength_count
    force, moment = (one[..., :count] for one in (state.resultants.force, state.resultants.moment))
    found = StressResultants(force, moment, state.resultants.jump)
    used = utilization_of_strips(
        state.strips, found, state.thickness, check.material, check.criterion
    )
    return largest_of_panels(state.strips, used)


def _check_strength(state: EngineeringState, used: np.ndarray, words: str, errors) -> Any:
    panel, column = np.unravel_index(int(used.argmax()), used.shape)
    names = list(state.combinations.strength)
    found = Found(float(used[panel, column]), names[column], int(panel))
    error = _largest_error(errors, "utilization_p99")
    return hold_against(f"strength on strips, {words}", found, 1.0, mesh_error=error)


def _check_stability(state: EngineeringState, checks: Checks, errors) -> dict[str, Any]:
    """The least elastic factor, less what the mesh may take of it, against what is required."""
    required = require_factor(checks, state.case.material.kind)
    names, count = state.short.names, state.strength_count
    parts = {
        "stability": ("stability, buckling factor", slice(0, count), 1.0),
        "stability_characteristic": (
            "stability, characteristic combinations", slice(count, len(names)),
            checks.characteristic_load_factor,
        ),
    }  # fmt: skip
    found = {}
    for name, (words, columns, rise) in parts.items():
        limit = rise * required.value
        if state.short.buckling is None:
            found[name] = unknown_check(f"{words} without analysis.second_order", limit, "", True)
            continue
        factors = state.short.buckling.factors[columns]
        least = int(factors.argmin())
        found[name] = _hold_factor(state, words, columns.start + least, limit, errors)
    return found


def _hold_factor(state: EngineeringState, words: str, column: int, limit: float, errors) -> Any:
    factor = float(state.short.buckling.factors[column])
    name, error = state.short.names[column], errors.buckling_mesh_error
    if not np.isfinite(factor):
        return hold_against(words, Found(None, name), limit, at_least=True)
    value = correct_factor(factor, error)
    panel = _panel_of_mode(state, column)
    found = hold_against(words, Found(value, name, panel), limit, "", True, error)
    return found


def _panel_of_mode(state: EngineeringState, column: int) -> int:
    """Return the panel in which a buckling mode moves most."""
    model = state.case.model
    shape = np.zeros(model.mesh.dof_count)
    shape[model.pattern.free] = state.short.buckling.modes[:, column]
    moved = np.linalg.norm(shape[: 3 * len(model.mesh.nodes)].reshape(-1, 3), axis=1)
    return _panel_of_node(state, int(moved.argmax()))


def _panel_of_node(state: EngineeringState, node: int) -> int:
    mesh = state.case.model.mesh
    return int(mesh.panel[np.flatnonzero((mesh.elements == node).any(axis=1))[0]])


def _check_displacements(
    state: EngineeringState, checks: Checks, span: float, errors
) -> dict[str, Any]:
    first, limit = state.strength_count, span / checks.displacement_limit_span_over
    down = _largest_error(errors, "displacement_down_max_m")
    away = _largest_error(errors, "displacement_max_m")
    phi = "" if state.case.material.kind == "steel" else f", creep {checks.creep_coefficient:g}"
    found = {
        "displacement_vertical": hold_against(
            "vertical displacement, characteristic", _find_down(state, state.short, first), limit,
            "m", mesh_error=down,
        ),
        "displacement_long_term": _hold_sustained(
            state, state.long_term, f"vertical displacement, long-term{phi}", limit, down
        ),
    }  # fmt: skip
    if state.case.material.kind == CONCRETE and state.cracked is not None:
        share = f"cracked panels at {checks.cracked_stiffness:g} of that"
        words = f"vertical displacement, long-term, {share}"
        found["displacement_long_term_cracked"] = _hold_sustained(
            state, state.cracked, words, limit, down
        )
    height = _measure_height(state)
    if height > FLAT * span:
        found["displacement_horizontal"] = hold_against(
            "horizontal displacement, characteristic", _find_sway(state, first),
            height / checks.horizontal_limit_height_over, "m", mesh_error=away,
        )  # fmt: skip
    return found


def _hold_sustained(state, result: AnalysisResult, words: str, limit: float, error) -> Any:
    if result.state in ("unstable", "mechanism"):
        return unknown_check(f"{words}: {result.reason}", limit, "m")
    return hold_against(words, _find_down(state, result, 0), limit, "m", mesh_error=error)


def _find_down(state: EngineeringState, result: AnalysisResult, first: int) -> Found:
    """Return the largest downward displacement of the columns from `first` on."""
    down = -translations(state.case.model, result.displacement)[:, 2, first:]
    return _find_largest(state, down, result.names[first:])


def _find_sway(state: EngineeringState, first: int) -> Found:
    """Return the largest horizontal displacement of the columns from `first` on."""
    moved = translations(state.case.model, state.short.displacement)[:, :2, first:]
    return _find_largest(state, np.linalg.norm(moved, axis=1), state.short.names[first:])


def _find_largest(state: EngineeringState, values: np.ndarray, names: Sequence[str]) -> Found:
    node, column = np.unravel_index(int(values.argmax()), values.shape)
    return Found(float(values[node, column]), names[column], _panel_of_node(state, int(node)))


def _measure_height(state: EngineeringState) -> float:
    """Return how far the shell rises above its lowest support, m."""
    model = state.case.model
    height = model.mesh.nodes[:, 2]
    return float(height.max() - height[model.supported_nodes].min())


def _largest_error(errors: MeshConvergenceRecord, quantity: str) -> float | None:
    found = [one[quantity] for one in errors.errors.values() if quantity in one]
    return max(found, default=None)
