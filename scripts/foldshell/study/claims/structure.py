"""Claims on curvature, supports and density: C4 to C9."""

from collections.abc import Sequence

from foldshell.study.claims.finding import Finding
from foldshell.study.claims.outcome import (
    Comparer,
    Outcome,
    choose,
    choose_folded,
    group_by_others,
    pair_neighbours,
)
from foldshell.study.claims.statement import Claim


def judge_curvature(outcomes: Sequence[Outcome], comparer: Comparer) -> Claim:
    """C4: of two heights over one span, the lower is better used and deflects more."""
    findings = []
    for lower, higher in pair_neighbours(choose_folded(outcomes), "height_m"):
        findings += [
            comparer.compare("better utilization", lower, higher, "utilization_mean"),
            comparer.compare("more deflection", lower, higher, "displacement"),
        ]
    note = "Table 1 varies the height of the paraboloid and the arch only, not of the hypar."
    return Claim("C4", _in_parts(findings), notes=(note,))


def judge_material(outcomes: Sequence[Outcome], comparer: Comparer) -> Claim:
    """C5: volume per area rises with the height of folded sheets, not with that of smooth ones."""
    findings = [
        comparer.compare("folded: more material", higher, lower, "volume_per_area")
        for lower, higher in pair_neighbours(choose_folded(outcomes), "height_m")
    ]
    smooth = choose(outcomes, pattern="smooth")
    findings += [
        comparer.compare("smooth: no more", lower, higher, "volume_per_area", strict=False)
        for lower, higher in pair_neighbours(smooth, "height_m")
    ]
    return Claim("C5", findings)


def judge_surfaces(outcomes: Sequence[Outcome], comparer: Comparer) -> Claim:
    """C6: volume per area of paraboloid, arch and hypar with all else equal."""
    findings = []
    for group in group_by_others(choose_folded(outcomes), "surface"):
        if not {"paraboloid", "arch", "hypar"} <= set(group):
            continue
        dome, arch, saddle = (group[name] for name in ("paraboloid", "arch", "hypar"))
        findings += [
            comparer.compare("paraboloid above arch", dome, arch, "volume_per_area"),
            comparer.compare("paraboloid above hypar", dome, saddle, "volume_per_area"),
            comparer.compare("arch above hypar", arch, saddle, "volume_per_area"),
        ]
    return Claim("C6", _in_parts(findings))


SUPPORT_PARTS = {
    "more even utilization": ("utilization_variation", "zigzag", "strip"),
    "more volume": ("volume_per_area", "strip", "zigzag"),
    "more deflection": ("displacement", "strip", "zigzag"),
}
"""Parts of C7: the quantity, the support with the greater value, the one with the lesser."""


NAMES = (
    "Which polylines the paper calls zig-zags is a reading; with the two names exchanged holds and "
    "fails change places here. The reading taken is the one in which fewer zig-zags make the "
    "section deeper (C8): the ridges run along the zig-zags, so that a sheet on its strip edges "
    "spans along its ridges."
)


def judge_supports(
    outcomes: Sequence[Outcome], comparer: Comparer, equal: Sequence[Outcome] = ()
) -> Claim:
    """C7: strip edges supported against zig-zag edges supported, with all else equal.

    `equal` are the same designs at one thickness, which shows the stronger axis itself.
    """
    groups = group_by_others(choose_folded(outcomes), "support")
    groups = [group for group in groups if {"strip", "zigzag"} <= set(group)]
    findings = [
        comparer.compare(part, group[greater], group[lesser], quantity)
        for part, (quantity, greater, lesser) in SUPPORT_PARTS.items()
        for group in groups
    ]
    part = "stronger zig-zag axis: more deflection at equal thickness"
    findings += [
        comparer.compare(part, group["strip"], group["zigzag"], "displacement")
        for group in group_by_others(choose_folded(equal), "support")
        if {"strip", "zigzag"} <= set(group)
    ]
    return Claim("C7", findings, notes=(NAMES,))


def judge_zigzags(
    outcomes: Sequence[Outcome], comparer: Comparer, equal: Sequence[Outcome] = ()
) -> Claim:
    """C8: of two counts of zig-zags, the lower gives the deeper section and deflects less."""
    pairs = pair_neighbours(choose_folded(outcomes), "zigzag")
    findings = [comparer.compare("deeper section", few, many, "depth") for few, many in pairs]
    findings += [
        comparer.compare("less deflection", many, few, "displacement") for few, many in pairs
    ]
    findings += [
        comparer.compare("less deflection at equal thickness", many, few, "displacement")
        for few, many in pair_neighbours(choose_folded(equal), "zigzag")
    ]
    return Claim("C8", findings, open=("less deflection at equal thickness",))


def judge_strips(outcomes: Sequence[Outcome], comparer: Comparer) -> Claim:
    """C9: of two counts of strips, the higher gives smaller panels, more evenly utilized."""
    findings = []
    for few, many in pair_neighbours(choose_folded(outcomes), "strip"):
        findings += [
            comparer.compare("smaller panels", few, many, "panel_area"),
            comparer.compare("more even utilization", few, many, "utilization_variation"),
            comparer.compare("higher mean utilization", many, few, "utilization_mean"),
        ]
    return Claim("C9", _in_parts(findings), open=("higher mean utilization",))


def _in_parts(findings: Sequence[Finding]) -> list[Finding]:
    """Return the findings sorted by part, parts in order of first appearance."""
    order = list(dict.fromkeys(finding.part for finding in findings))
    return sorted(findings, key=lambda finding: order.index(finding.part))
