"""Two codes side by side: limits, differences, tolerances, mesh errors."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from crosscheck.extrapolation import compute_mesh_error
from crosscheck.reading import Place
from crosscheck.records import MULTIFRONTAL, Comparison, Limit, Quantity, SupportReaction
from crosscheck.values import KINDS, NOT_SETTLED, SUPPORTS, Code

TOLERANCES = {
    "displacement": 0.04,
    "work": 0.04,
    "utilization_p99": 0.08,
    "utilization_panel_mean": 0.08,
    "buckling_factor": 0.08,
    "reaction": 1e-6,
    "reaction_balance": 1e-6,
    "support_reaction": 0.04,
}
"""Relative. Displacement and work: two limits of 1 to 2.5 % each; utilization and buckling factor
follow derivatives and modes, which settle later; the sum of reactions is statics, where only
rounding may differ; that of one support follows stiffness as displacement does."""


def compare(
    primary: Code,
    independent: Code,
    tolerances: Mapping[str, float],
    solver: str = MULTIFRONTAL,
    thrusts: Mapping[str, np.ndarray] | None = None,
) -> Comparison:
    """Quantity by quantity: both limits, relative difference, tolerance, pass; and mesh errors.

    Compared is what both codes give; what only one gives is listed as `not_compared`. What this
    code has not settled on some mesh, and the other gives, is listed as `not_settled`: there is
    no number to compare, and the comparison fails. `thrusts` are the unit vectors (3,) of
    `find_thrusts`: the reactions of these supports are compared.
    """
    allowed = TOLERANCES | read_tolerances(tolerances)
    quantities: dict[str, Quantity] = {}
    reactions: dict[str, SupportReaction] = {}
    missing = [name for name in primary.values if name not in independent.values]
    not_settled: list[str] = []
    for combination, values in independent.values.items():
        given = primary.values.get(combination, {})
        missing += [f"{combination} {name}" for name in values if name not in given]
        shared = [name for name in values if name in given and name in KINDS]
        lost = [name for name in shared if NOT_SETTLED in values[name]]
        not_settled += [f"{combination} {name}" for name in lost]
        for name in (name for name in shared if name not in lost):
            found = _compare_scalar(primary, independent, combination, name, allowed)
            quantities[f"{combination} {name}"] = found
        if "reaction_sum_kn" in values and "reaction_sum_kn" in given:
            quantities |= _compare_reactions(given, values, combination, allowed)
        if SUPPORTS in values and SUPPORTS in given:
            codes, held = (primary, independent), allowed["support_reaction"]
            reactions |= _compare_supports(codes, combination, thrusts or {}, held)
    entries = [*quantities.values(), *reactions.values()]
    return Comparison(
        passed=bool(quantities) and all(one.passed for one in entries) and not not_settled,
        quantities=quantities,
        reactions=reactions,
        not_compared=missing,
        not_settled=not_settled,
        primary_subdivisions=list(primary.subdivisions),
        independent_subdivisions=list(independent.subdivisions),
        solver=solver,
    )


def read_tolerances(tolerances: Mapping[str, float]) -> dict[str, float]:
    """The tolerances given; raises CrosscheckError for an unknown name or a value not above 0."""
    place = Place("crosscheck", "tolerance", dict(tolerances))
    for name in place.names():
        if name not in TOLERANCES:
            place.refuse(name, "one of " + ", ".join(TOLERANCES))
    return {name: place.key(name).number(above=0.0) for name in place.names()}


def _compare_scalar(
    primary: Code, independent: Code, combination: str, name: str, allowed: Mapping[str, float]
) -> Limit:
    kind, unit = KINDS[name]
    codes = {"primary": primary, "independent": independent}
    limits = {label: code.limit(combination, name) for label, code in codes.items()}
    first, second = (value for value, _ in limits.values())
    judged = _judge(first, second, max(abs(first), abs(second)), allowed[kind], unit)
    more: dict[str, Any] = {}
    for label, code in codes.items():
        meshes = [float(value) for value in code.values[combination][name]]
        aim = code.extrapolate(combination, name)[0]
        more[f"{label}_meshes"] = meshes
        more[f"{label}_order"] = limits[label][1]
        more[f"{label}_mesh_error"] = compute_mesh_error(meshes[-1], aim)
    return Limit(**vars(judged), **more)


def _compare_reactions(
    given: Mapping[str, Any], own: Mapping[str, Any], combination: str, allowed: Mapping[str, float]
) -> dict[str, Quantity]:
    """Finest mesh: each component against the other code's, and each code's own balance."""
    first, second = (np.array(values["reaction_sum_kn"][-1], float) for values in (given, own))
    scale = max(np.linalg.norm(first), np.linalg.norm(second))
    entries = {
        f"{combination} reaction_{axis}_kn": _judge(
            first[k], second[k], scale, allowed["reaction"], "kN"
        )
        for k, axis in enumerate("xyz")
    }
    defect = [
        np.linalg.norm(np.add(values["reaction_sum_kn"], values["load_sum_kn"]), axis=1).max()
        / np.linalg.norm(values["load_sum_kn"], axis=1).max()
        for values in (given, own)
    ]
    balance = _judge(defect[0], defect[1], 1.0, allowed["reaction_balance"], "-")
    kept = bool(max(defect) <= balance.tolerance)
    balance = replace(balance, relative_difference=float(max(defect)), passed=kept)
    return entries | {f"{combination} reaction_imbalance": balance}


def _compare_supports(
    codes: tuple[Code, Code], combination: str, thrusts: Mapping[str, np.ndarray], tolerance: float
) -> dict[str, SupportReaction]:
    """The limits of both codes for each support, against the largest resultant of all."""
    limits = [
        {name: code.extrapolate_reaction(combination, name) for name in thrusts} for code in codes
    ]
    scale = max((np.linalg.norm(force) for found in limits for force in found.values()), default=0)
    result = {}
    for name, thrust in thrusts.items():
        first, second = (found[name] for found in limits)
        difference = float(np.linalg.norm(first - second) / scale) if scale > 0 else 0.0
        result[f"{combination} {name}"] = SupportReaction(
            primary_kn=first.tolist(),
            independent_kn=second.tolist(),
            primary_thrust_kn=float(first @ thrust),
            independent_thrust_kn=float(second @ thrust),
            relative_difference=difference,
            tolerance=float(tolerance),
            passed=bool(difference <= tolerance),
        )
    return result


def _judge(
    primary: float, independent: float, scale: float, tolerance: float, unit: str
) -> Quantity:
    difference = abs(primary - independent) / scale if scale > 0 else 0.0
    return Quantity(
        primary=float(primary),
        independent=float(independent),
        relative_difference=float(difference),
        tolerance=float(tolerance),
        passed=bool(difference <= tolerance),
        unit=unit,
    )
