"""Steel, moments and shear of both codes side by side."""

from collections.abc import Mapping, Sequence

from crosscheck.panel_steel import Laid
from crosscheck.records import Limit, ReinforcementComparison

TOLERANCE = 0.10
"""Of kg/m2 and of the largest steel: peaks beside folds, each code's own points, levers, strips."""
UNITS = {
    "steel_kg_m2": "kg/m2",
    "steel_max_kn_m": "kN/m",
    "moment_max_knm_m": "kNm/m",
    "shear_max_kn_m": "kN/m",
}
DECIDING = ("steel_kg_m2", "steel_max_kn_m")
"""Moments and shear are told beside: shear at the ends of folds settles in neither code."""
WORDS = {"steel_kg_m2": "mass of steel", "steel_max_kn_m": "largest steel of a panel"}


def compare_reinforcement(
    laid: Laid, given: Mapping[str, Sequence[float]], runs: Sequence[Mapping[str, float]]
) -> ReinforcementComparison:
    """What both codes find on their finest meshes; passed where steel is within `TOLERANCE`.

    `given` are the primary code's values and `runs` this code's, from coarse to fine, in `UNITS`.
    """
    found = {name: _judge(given[name], [run[name] for run in runs], unit)
             for name, unit in UNITS.items()}  # fmt: skip
    missed = [name for name in DECIDING if not found[name].passed]
    return ReinforcementComparison(
        combinations=list(laid.combinations),
        passed=not missed,
        quantities=found,
        reason="; ".join(_explain(name, found[name]) for name in missed) or None,
    )


def _judge(primary: Sequence[float], independent: Sequence[float], unit: str) -> Limit:
    first, second = float(primary[-1]), float(independent[-1])
    scale = max(abs(first), abs(second))
    difference = abs(first - second) / scale if scale > 0 else 0.0
    return Limit(
        primary=first,
        independent=second,
        relative_difference=difference,
        tolerance=TOLERANCE,
        passed=difference <= TOLERANCE,
        unit=unit,
        primary_meshes=[float(one) for one in primary],
        primary_order=None,
        primary_mesh_error=_move(primary),
        independent_meshes=[float(one) for one in independent],
        independent_order=None,
        independent_mesh_error=_move(independent),
    )


def _move(values: Sequence[float]) -> float:
    """Relative change between the two finest meshes."""
    if len(values) < 2 or not values[-1]:
        return 0.0
    return float(abs(values[-1] - values[-2]) / abs(values[-1]))


def _explain(name: str, found: Limit) -> str:
    """Why a difference may be as large as it is: what the meshes of each code move."""
    return (
        f"{WORDS[name]} differs by {100 * found.relative_difference:.3g} %: between its two meshes "
        f"it moves by {100 * found.primary_mesh_error:.3g} % in the primary code and by "
        f"{100 * found.independent_mesh_error:.3g} % in the independent one"
    )
