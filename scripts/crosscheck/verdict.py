"""Run this code on its meshes and compare, or say why there is nothing to compare."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from crosscheck.comparison import SECOND_ORDER, Code, build_independent, compare
from crosscheck.discretisation import plan_facets
from crosscheck.errors import MechanismError
from crosscheck.model import Model
from crosscheck.records import MULTIFRONTAL, Comparison, FirstComparison
from crosscheck.stability import analyse_mesh


def compare_codes(
    model: Model,
    primary: Code,
    meshes: Sequence[int],
    tolerance: Mapping[str, float],
    stability: bool,
    shear_factor: float,
    solver: str = MULTIFRONTAL,
) -> Comparison:
    """The comparison; failed, with the reason, where only this code finds a mechanism.

    Codes that differ are compared once more after the coarsest of these meshes has made way for a
    finer one: buckling modes of slender panels are still far from their limit on the meshes that
    suffice elsewhere, while what differs for another reason differs on every mesh. The second
    comparison stands; what the first one found is kept under `first`.
    """
    buckling = stability and "buckling_factor" in primary.names
    second = stability and any(SECOND_ORDER in name for name in primary.values)
    try:
        plan = plan_facets(model.vertices, model.facets)
        how = (shear_factor, buckling, second, plan, solver)
        runs = [analyse_mesh(model, m, *how) for m in meshes]
        result = compare(primary, build_independent(meshes, runs), tolerance, solver)
        if result.passed:
            return result
        meshes = [*meshes[1:], meshes[-1] + 1]
        runs = [*runs[1:], analyse_mesh(model, meshes[-1], *how)]
        again = compare(primary, build_independent(meshes, runs), tolerance, solver)
        return replace(again, first=_keep(result))
    except MechanismError as error:
        return leave_out(False, str(error), solver)


def _keep(result: Comparison) -> FirstComparison:
    """What is kept of a comparison that a second one replaces."""
    found = (result.independent_subdivisions, result.quantities, result.not_settled)
    return FirstComparison(*found)


def leave_out(passed: bool | None, reason: str, solver: str = MULTIFRONTAL) -> Comparison:
    """A comparison without quantities, and why."""
    return Comparison(
        passed=passed,
        quantities={},
        not_compared=[],
        not_settled=[],
        primary_subdivisions=[],
        independent_subdivisions=[],
        solver=solver,
        reason=reason,
    )
