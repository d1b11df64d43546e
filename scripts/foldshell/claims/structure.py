"""Claims on curvature, supports and density: C4 to C9."""

from collections.abc import Mapping, Sequence
from itertools import combinations

from foldshell.claims.design_result import (
    Comparer,
    DesignResult,
    group_by_others,
    pair_neighbours,
    select,
    select_folded,
)
from foldshell.claims.finding import Finding
from foldshell.claims.statement import Claim


def _compare_pairs(
    pairs: Sequence[tuple[DesignResult, DesignResult]],
    comparer: Comparer,
    parts: Mapping[str, tuple[str, int]],
) -> list[Finding]:
    """Compare all pairs; `parts` has a quantity and which of a pair, 0 or 1, is to exceed."""
    return [
        comparer.compare(part, pair[greater], pair[1 - greater], quantity)
        for part, (quantity, greater) in parts.items()
        for pair in pairs
    ]


def judge_curvature(design_results: Sequence[DesignResult], comparer: Comparer) -> Claim:
    """C4: of two heights over one span, the lower is better used and deflects more."""
    parts = {"better utilization": ("utilization_mean", 0), "more deflection": ("displacement", 0)}
    pairs = pair_neighbours(select_folded(design_results), "height_m")
    note = "Table 1 varies the height of the paraboloid and the arch only, not of the hypar."
    return Claim("C4", _compare_pairs(pairs, comparer, parts), notes=(note,))


def judge_material(design_results: Sequence[DesignResult], comparer: Comparer) -> Claim:
    """C5: volume per area rises with the height of folded sheets, not with that of smooth ones."""
    parts = {"folded: more material": ("volume_per_area", 1)}
    pairs = pair_neighbours(select_folded(design_results), "height_m")
    findings = _compare_pairs(pairs, comparer, parts)
    smooth = select(design_results, pattern="smooth")
    findings += [
        comparer.compare("smooth: no more", lower, higher, "volume_per_area", strict=False)
        for lower, higher in pair_neighbours(smooth, "height_m")
    ]
    note = (
        "Smooth shells are meshed on the surface itself, 3 x 3 quads a panel; where they stand at "
        "the least thickness of the settings their volume per area is that, whatever the height."
    )
    return Claim("C5", findings, notes=(note,) if smooth else ())


def judge_surfaces(design_results: Sequence[DesignResult], comparer: Comparer) -> Claim:
    """C6: volume per area of paraboloid, arch and hypar with all else equal."""
    names = ("paraboloid", "arch", "hypar")
    groups = group_by_others(select_folded(design_results), "surface")
    groups = [group for group in groups if set(names) <= set(group)]
    findings = [
        comparer.compare(f"{more} above {less}", group[more], group[less], "volume_per_area")
        for more, less in combinations(names, 2)
        for group in groups
    ]
    return Claim("C6", findings)


SUPPORT_PARTS = {
    "more even utilization": ("utilization_variation", 1),
    "more volume": ("volume_per_area", 0),
    "more deflection": ("displacement", 0),
}
"""Parts of C7 on pairs of strip edges and zig-zag edges."""
STRONGER_AXIS = {"stronger zig-zag axis: more deflection at equal thickness": ("displacement", 0)}


NAMES = (
    "Which polylines the paper calls zig-zags is a reading; with the two names exchanged holds and "
    "fails change places here. The reading taken is the one in which fewer zig-zags make the "
    "section deeper (C8): the ridges run along the zig-zags, so that a sheet on its strip edges "
    "spans along its ridges."
)


def judge_supports(
    design_results: Sequence[DesignResult], comparer: Comparer, equal: Sequence[DesignResult] = ()
) -> Claim:
    """C7: strip edges supported against zig-zag edges supported, with all else equal.

    `equal` are the same designs at one thickness, which shows the stronger axis itself.
    """
    findings = _compare_pairs(_pair_supports(design_results), comparer, SUPPORT_PARTS)
    findings += _compare_pairs(_pair_supports(equal), comparer, STRONGER_AXIS)
    return Claim("C7", findings, notes=(NAMES,))


def _pair_supports(
    design_results: Sequence[DesignResult],
) -> list[tuple[DesignResult, DesignResult]]:
    """Return (on strip edges, on zig-zag edges) with all else equal."""
    return [
        (group["strip"], group["zigzag"])
        for group in group_by_others(select_folded(design_results), "support")
        if {"strip", "zigzag"} <= set(group)
    ]


def judge_zigzags(
    design_results: Sequence[DesignResult], comparer: Comparer, equal: Sequence[DesignResult] = ()
) -> Claim:
    """C8: of two counts of zig-zags, the lower gives the deeper section and deflects less."""
    parts = {"deeper section": ("depth", 0), "less deflection": ("displacement", 1)}
    aside = {"less deflection at equal thickness": ("displacement", 1)}
    findings = _compare_pairs(
        pair_neighbours(select_folded(design_results), "zigzag"), comparer, parts
    )
    findings += _compare_pairs(pair_neighbours(select_folded(equal), "zigzag"), comparer, aside)
    return Claim("C8", findings, open=tuple(aside))


def judge_strips(design_results: Sequence[DesignResult], comparer: Comparer) -> Claim:
    """C9: of two counts of strips, the higher gives smaller panels, more evenly utilized."""
    aside = {"higher mean utilization": ("utilization_mean", 1)}
    parts = {
        "smaller panels": ("panel_area", 0),
        "more even utilization": ("utilization_variation", 0),
    } | aside
    pairs = pair_neighbours(select_folded(design_results), "strip")
    return Claim("C9", _compare_pairs(pairs, comparer, parts), open=tuple(aside))
