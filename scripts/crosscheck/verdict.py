"""Run this code on its meshes and compare, or say why there is nothing to compare."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from crosscheck.comparison import compare
from crosscheck.criteria import find_governing, share_shear
from crosscheck.discretisation import plan_facets
from crosscheck.errors import CrosscheckError, MechanismError
from crosscheck.model import Model
from crosscheck.reactions import find_thrusts
from crosscheck.records import MULTIFRONTAL, Comparison, FirstComparison
from crosscheck.reinforcement import compare_reinforcement
from crosscheck.shear import TRUE_SHEAR_FACTOR
from crosscheck.stability import REINFORCED, Method, analyse_mesh
from crosscheck.values import SECOND_ORDER, Code, build_independent


def compare_codes(
    model: Model,
    primary: Code,
    meshes: Sequence[int],
    tolerance: Mapping[str, float],
    method: Method,
    given: Mapping[str, Sequence[float]] | None = None,
) -> Comparison:
    """The comparison; failed, with the reason, where only this code finds a mechanism.

    Codes that differ are compared once more after the coarsest of these meshes has made way for a
    finer one: buckling modes of slender panels are still far from their limit on the meshes that
    suffice elsewhere, while what differs for another reason differs on every mesh. The second
    comparison stands; what the first one found is kept under `first`. `given` are the other code's
    values of the reinforcement that `method` says is laid; what comes of them fails no comparison.
    """
    buckling = method.buckling and "buckling_factor" in primary.names
    second = method.second_order and any(SECOND_ORDER in name for name in primary.values)
    shear = method.shear and method.shear_factor != TRUE_SHEAR_FACTOR
    method = replace(method, buckling=buckling, second_order=second, shear=shear)
    steel = []
    try:
        plan, thrusts = plan_facets(model.vertices, model.facets), find_thrusts(model)
        runs = [analyse_mesh(model, m, method, plan) for m in meshes]
        steel = [run.pop(REINFORCED, {}) for run in runs]
        how = (tolerance, method.solver, thrusts)
        result = compare(primary, build_independent(meshes, runs), *how)
        if not result.passed:
            kept = _keep(result)
            meshes = [*meshes[1:], meshes[-1] + 1]
            runs = [*runs[1:], analyse_mesh(model, meshes[-1], method, plan)]
            steel = [*steel[1:], runs[-1].pop(REINFORCED, {})]
            again = compare(primary, build_independent(meshes, runs), *how)
            result = replace(again, first=kept)
    except MechanismError as error:
        return leave_out(False, str(error), method.solver)
    governing = find_governing(primary, model.compared)
    shares = share_shear(model, primary, governing, meshes, runs)
    result = replace(result, governing=governing, shear=shares)
    if method.laid is None:
        return result
    return replace(result, reinforcement=compare_reinforcement(method.laid, given, steel))


def check_meshes(subdivisions: Sequence[int]) -> list[int]:
    """The meshes as whole numbers; raises CrosscheckError where they do not increase from 1."""
    meshes = [int(m) for m in subdivisions]
    if not meshes or any(m < 1 for m in meshes) or meshes != sorted(set(meshes)):
        raise CrosscheckError(f"crosscheck.subdivisions: {meshes}: allowed are increasing, from 1")
    return meshes


def _keep(result: Comparison) -> FirstComparison:
    """What is kept of a comparison that a second one replaces."""
    return FirstComparison(
        result.independent_subdivisions, result.quantities, result.reactions, result.not_settled
    )


def leave_out(passed: bool | None, reason: str, solver: str = MULTIFRONTAL) -> Comparison:
    """A comparison without quantities, and why."""
    return Comparison(
        passed=passed,
        quantities={},
        reactions={},
        not_compared=[],
        not_settled=[],
        primary_subdivisions=[],
        independent_subdivisions=[],
        solver=solver,
        reason=reason,
    )
