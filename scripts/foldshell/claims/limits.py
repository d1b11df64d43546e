"""Claims on what limits a design: C10 to C13."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import fields, replace

from foldshell.claims.design_result import (
    Comparer,
    DesignResult,
    group_by_others,
    select,
    select_folded,
    state_fact,
)
from foldshell.claims.finding import HOLDS, Finding, judge_many
from foldshell.claims.statement import Claim
from foldshell.records.claims import ClaimNumbers
from foldshell.records.measures import FlatEqualRecord, FlatSheet


def judge_buckling(design_results: Sequence[DesignResult], comparer: Comparer) -> Claim:
    """C10: mean utilization is low, and loads reach the buckling factor before strength.

    Low is below the lower limit of Table 3; strength is reached at the load factor 1 / utilization
    of the most utilized panel.
    """
    designs = [_with_strength(one) for one in select_folded(design_results)]
    findings = []
    for one in designs:
        least = replace(
            one.values,
            utilization_mean=comparer.utilization_min,
            utilization_strip_mean=None,
            utilization_reinforced_mean=None,
        )
        limit = replace(one, values=least, errors=NO_ERRORS)
        found = comparer.compare(LOW, limit, one, "utilization_mean")
        names = "limit, utilization_mean"
        findings.append(replace(found, designs=(one.name,), quantity=names))
    part = "buckling before strength"
    findings += [
        comparer.compare_within(part, one, "strength_factor", "buckling_factor") for one in designs
    ]
    held = ClaimNumbers(held_by=count_bindings(designs, comparer))
    note = "The verdict is that of the reason given, buckling; low utilization stands beside it."
    return Claim("C10", findings, open=(LOW,), notes=(note,), numbers=held)


LOW = "utilization is low"
NO_ERRORS = {name: (0.0, 0.0) for name in ("displacement", "utilization", "buckling")}


def _with_strength(design_result: DesignResult) -> DesignResult:
    """Add the load factor at which the mean of a panel reaches the strength."""
    highest = design_result.measure("utilization_panel_mean_max")
    strength = 1 / highest if highest else None
    return replace(design_result, values=replace(design_result.values, strength_factor=strength))


def count_bindings(design_results: Sequence[DesignResult], comparer: Comparer) -> dict[str, int]:
    """Return how many designs stand at each limit, one design perhaps at several."""
    found: Counter[str] = Counter()
    for design_result in design_results:
        found.update(find_bindings(design_result, comparer))
    return dict(sorted(found.items()))


def find_bindings(design_result: DesignResult, comparer: Comparer) -> list[str]:
    """Return what keeps a design from being thinner: limits reached to 90 %, or least thickness."""
    values, names = design_result.values, []
    if values.displacement is None:
        return [values.state]
    if values.displacement > 0.9 * design_result.row.span_m / comparer.displacement_span_over:
        names.append("displacement")
    if design_result.measure("utilization_panel_mean_max") > 0.9:
        names.append("utilization of a panel")
    if values.panels_at_bound == design_result.panel_count:
        names.append("least thickness in every panel")
    factor = values.buckling_factor
    if factor is not None and factor < comparer.buckling_factor_min:
        names.append("buckling factor")
    return names or ["none of these"]


def judge_free_edges(design_results: Sequence[DesignResult]) -> Claim:
    """C11: designs on two edges whose loop ends with panels above 1, and where these stand."""
    designs = select(select_folded(design_results), support=("zigzag", "strip"))
    many, place = "many do not reach utilization 1", "panels above 1 stand at free edges"
    findings = []
    for one in designs:
        above = one.values.above_one
        over = above is None or above > 0
        findings.append(state_fact(many, one.name, "panels above 1", above, 0.0, over))
        if above:
            share = one.values.above_one_at_free_edge / above
            found = state_fact(place, one.name, "share of them", share, 0.5, share > 0.5)
            findings.append(found)
    peaks = sum((one.values.utilization_max or 0) > 1 for one in designs)
    note = (
        "Not to reach utilization 1 is read as to end with panels above it, by the measure that "
        f"the loop limits; single points exceed 1 in {peaks} of {len(designs)} designs."
    )
    judges = {many: judge_many, place: judge_many}
    return Claim("C11", findings, judges=judges, notes=(note,))


def judge_deflected_edges(design_results: Sequence[DesignResult], comparer: Comparer) -> Claim:
    """C12: largest downward displacement on the panels along free edges, and on all others."""
    designs = select(select_folded(design_results), support=("zigzag", "strip"))
    part = "more deflection along free edges"
    names = "displacement_edge", "displacement_inner"
    return Claim("C12", [comparer.compare_within(part, one, *names) for one in designs])


FOLDED = "less deflection when folded"
SIZED = "less material when folded, each sized by itself"
UNFOLDED = (
    "The flat sheet is the folded one unfolded, so its sides are longer than the span, and a plate "
    "deflects about with their fourth power. Its uncertainty is its mesh error of first order: no "
    "second code checks it. Where it is unstable its first-order displacement stands for it."
)
LARGE = (
    "The theory is that of small displacements: one beyond a tenth of the span only says that the "
    "sheet does not carry its loads as a plate."
)


def judge_folds(
    design_results: Sequence[DesignResult],
    flats: Mapping[str, FlatEqualRecord],
    comparer: Comparer,
) -> Claim:
    """C13: a sized folded sheet against the flat sheet with the same volume of material.

    `flats` has what the flat sheet does, by the name of the folded design; where it is unstable
    its first-order displacement is compared and the finding holds: it does not stand.
    """
    findings, numbers = [], {}
    for one in select_folded(design_results):
        flat = flats.get(one.name)
        if flat is None:
            continue
        other = DesignResult(replace(one.row, design=flat.flat), flat.measures, flat.errors)
        found = comparer.compare(FOLDED, other, one, "displacement")
        stands = flat.measures.displacement is not None
        findings.append(found if stands else _fallen(found, flat))
        numbers[one.name] = FlatSheet(**{k.name: getattr(flat, k.name) for k in fields(FlatSheet)})
    findings += [
        comparer.compare(SIZED, group["flat"], group["miura"], "volume")
        for group in group_by_others(design_results, "pattern")
        if {"flat", "miura"} <= set(group)
    ]
    notes = (UNFOLDED, LARGE, *_describe_ratio(findings))
    return Claim("C13", findings, open=(SIZED,), notes=notes, numbers=ClaimNumbers(flat=numbers))


def _describe_ratio(findings: Sequence[Finding]) -> list[str]:
    """Say how many times the displacement of the folded sheet the flat one has at least."""
    ratios = [f.values[0] / f.values[1] for f in findings if f.part == FOLDED and all(f.values)]
    return (
        [f"The flat sheet deflects at least {min(ratios):.3g} times as much as the folded one."]
        if ratios and min(ratios) > 10
        else []
    )


def _fallen(found: Finding, flat: FlatEqualRecord) -> Finding:
    values = flat.displacement_first_order_m, found.values[1]
    return replace(found, values=values, uncertainty=None, verdict=HOLDS)
