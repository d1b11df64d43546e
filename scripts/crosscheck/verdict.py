"""Run this code on its meshes and compare, or say why there is nothing to compare."""

from collections.abc import Mapping, Sequence
from typing import Any

from crosscheck.comparison import SECOND_ORDER, Code, build_independent, compare
from crosscheck.errors import MechanismError
from crosscheck.model import Model
from crosscheck.stability import analyse_mesh


def compare_codes(
    model: Model,
    primary: Code,
    meshes: Sequence[int],
    tolerance: Mapping[str, float],
    stability: bool,
    shear_factor: float,
) -> dict[str, Any]:
    """The comparison; failed, with the reason, where only this code finds a mechanism."""
    buckling = stability and "buckling_factor" in primary.names
    second = stability and any(SECOND_ORDER in name for name in primary.values)
    try:
        runs = [analyse_mesh(model, m, shear_factor, buckling, second) for m in meshes]
    except MechanismError as error:
        return leave_out(False, str(error))
    return compare(primary, build_independent(meshes, runs), tolerance)


def leave_out(passed: bool | None, reason: str) -> dict[str, Any]:
    """A comparison without quantities, and why."""
    meshes = {"primary_subdivisions": [], "independent_subdivisions": []}
    return {"pass": passed, "reason": reason, "quantities": {}, "not_compared": [], **meshes}
