"""What governs a design's criteria, and whether shear deformation turns a verdict."""

from collections.abc import Mapping, Sequence

from crosscheck.extrapolation import extrapolate
from crosscheck.model import Model
from crosscheck.records import ShearShare
from crosscheck.stability import Values
from crosscheck.values import SECOND_ORDER, SHEARED, Code

SHEAR_ORDER = 1.4
"""Order in 1/m at which the share of shear deformation rises to its limit: the median of 0.8, 1.3,
1.4, 1.7 and 3 on five designs with m = 1 to 4. What keeps elements from locking is shear compliance
as well, and hides a part of the true one that vanishes with the mesh."""

EXTRAPOLATED = ("displacement_down_max_m",)
"""Shares of local peaks and means rise and fall from mesh to mesh: that of the finest stands."""


def find_governing(primary: Code, compared: Mapping[str, Sequence[str]]) -> dict[str, str]:
    """The compared combination with the largest displacement, largest panel mean, least factor.

    On the other code's mesh in use; to second order where it gives that. Displacement is that of
    deflection combinations, the two others of strength combinations.
    """
    criteria = {
        "displacement": ("deflection", "displacement_down_max_m", 1),
        "utilization": ("strength", "utilization_panel_mean_max", 1),
        "buckling": ("strength", "buckling_factor", -1),
    }
    result = {}
    for criterion, (kind, name, sign) in criteria.items():
        values = {one: _read_in_use(primary, one, name) for one in compared[kind]}
        known = {one: sign * value for one, value in values.items() if value is not None}
        if known:
            result[criterion] = max(known, key=known.__getitem__)
    return result


def _read_in_use(primary: Code, combination: str, name: str) -> float | None:
    """The value of the other code's coarsest mesh, to second order where it is given."""
    for label in (f"{combination} {SECOND_ORDER}", combination):
        if name in primary.values.get(label, {}):
            return primary.values[label][name][0]
    return None


def share_shear(
    model: Model,
    primary: Code,
    governing: Mapping[str, str],
    meshes: Sequence[int],
    runs: Sequence[Values],
) -> dict[str, ShearShare]:
    """What shear adds to each value that the model limits, and whether the verdict turns with it.

    Empty where this code's runs have no values with shear deformation.
    """
    criteria = {
        "displacement_down_max_m": "displacement",
        "utilization_panel_mean_max": "utilization",
    }
    result = {}
    for name, limit in model.limits.items():
        combination = governing.get(criteria[name])
        label = f"{combination} {SHEARED}"
        if combination is None or not all(label in run for run in runs):
            continue
        shares = [run[label][name] / run[combination][name] - 1 for run in runs]
        share = shares[-1]
        if name in EXTRAPOLATED:
            share = extrapolate(meshes, shares, SHEAR_ORDER)
        second = f"{combination} {SECOND_ORDER}"
        refined = primary.limit(second if second in primary.values else combination, name)[0]
        value = _read_in_use(primary, combination, name)
        result[name] = _judge_shear(combination, shares, share, (value, refined), limit)
    return result


def _judge_shear(
    combination: str, shares: list[float], share: float, values: tuple[float, float], limit: float
) -> ShearShare:
    with_shear, refined = (value * (1 + share) for value in values)
    kept = values[0] <= limit
    return ShearShare(
        combination=combination,
        share=share,
        share_meshes=shares,
        value=values[0],
        limit=limit,
        with_shear=with_shear,
        refined_with_shear=refined,
        turns=(with_shear <= limit) != kept,
        turns_refined=(refined <= limit) != kept,
    )
