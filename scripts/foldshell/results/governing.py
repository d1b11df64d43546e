"""Which combinations govern the final state of a design, for mesh error and cross-check."""

from collections.abc import Mapping, Sequence

from foldshell.files.errors import InputError
from foldshell.loads.cases import SETTLEMENT, TEMPERATURE, make_load_cases
from foldshell.records.analysis import AnalysisRecord
from foldshell.settings.crosscheck import GOVERNING, Crosscheck
from foldshell.settings.loads import Combinations, Loads


def choose_combinations(
    chosen: Crosscheck,
    combinations: Combinations,
    report: AnalysisRecord,
    loads: Loads | None = None,
) -> dict[str, list[str]]:
    """Return the names of the combinations that are compared, {"strength": [..], ..}.

    `chosen` names them, or asks for those that govern a criterion of final.json, `report`. Those
    with temperature or settlement in `loads` are left out. Raises `InputError` for one that cannot
    be compared.
    """
    if loads is not None:
        combinations = compare_without_strains(combinations, loads)
    for kind in ("strength", "deflection"):
        known = [GOVERNING, *getattr(combinations, kind)]
        wrong = [name for name in getattr(chosen, kind) if name not in known]
        if wrong:
            raise InputError(
                f"crosscheck.{kind}: {wrong[0]!r}: the independent code cannot compare it: one of "
                f"{', '.join(known)} is allowed"
            )
    strength, deflection = list(chosen.strength), list(chosen.deflection)
    if strength == [GOVERNING]:
        strength = list_governing_strength(report, list(combinations.strength))
    if deflection == [GOVERNING]:
        deflection = [find_governing_deflection(report, list(combinations.deflection))]
    return {"strength": strength, "deflection": deflection}


def list_compared(
    chosen: Crosscheck, combinations: Combinations, report: AnalysisRecord, loads: Loads
) -> dict[str, Mapping[str, float]]:
    """Return the factors of those combinations by name, each once."""
    groups = choose_combinations(chosen, combinations, report, loads)
    return {name: combinations.all[name] for names in groups.values() for name in names}


def compare_without_strains(combinations: Combinations, loads: Loads) -> Combinations:
    """Return the combinations that the independent code can compare: it knows no temperature and
    no settlement. Raises `InputError` where a kind of combination has none."""
    cases = make_load_cases(loads, 0.0)
    left = {one.case for one in cases if one.kind in (TEMPERATURE, SETTLEMENT)}
    kept = {
        kind: {name: row for name, row in getattr(combinations, kind).items() if not left & {*row}}
        for kind in ("strength", "deflection")
    }
    for kind, found in kept.items():
        if not found:
            raise InputError(
                f"combinations.{kind}: each has a case of temperature or settlement "
                f"({', '.join(sorted(left))}): one without is needed, for the cross-check"
            )
    return combinations.changed(**kept)


def list_governing_strength(report: AnalysisRecord, names: Sequence[str]) -> list[str]:
    """Return the strength combinations of the most utilized panel and of the least buckling factor.

    The first of `names` where the state has neither, as that of a mechanism.
    """
    known = {name: report.buckling_factor.get(name) for name in names}
    factors = {name: factor for name, factor in known.items() if factor is not None}
    found = [report.governing_combination, min(factors, key=factors.__getitem__, default=None)]
    return list(dict.fromkeys(name for name in found if name in names)) or list(names[:1])


def find_governing_deflection(report: AnalysisRecord, names: Sequence[str]) -> str:
    """Return the deflection combination of the largest displacement, the first where none is."""
    found = report.displacement_combination
    return found if found in names else names[0]


def find_limits(report: AnalysisRecord) -> dict[str, float]:
    """Return what the criteria allow of displacement (m) and of the largest panel mean.

    Under the names of `MeshQuantities`; what is not asked for is left out.
    """
    criteria = {
        "displacement_down_max_m": report.criteria.displacement_vertical_m,
        "utilization_panel_mean_max": report.criteria.utilization_panel_mean,
    }
    return {name: one.limit for name, one in criteria.items() if one is not None}
