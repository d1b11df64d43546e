"""The claims on shells that are made to stand: sized as reinforced concrete, beside the paper's."""

from collections.abc import Mapping, Sequence
from dataclasses import fields, replace

from foldshell.claims.design_result import Comparer, DesignResult
from foldshell.claims.finding import HOLDS, UNTOLD
from foldshell.claims.sensitive import judge_by_strips
from foldshell.claims.sized import judge_sized
from foldshell.claims.statement import Claim, describe_claim
from foldshell.records.claims import JudgedParts
from foldshell.records.measures import FlatEqualRecord
from foldshell.records.reinforced_claims import ReinforcedClaim, Survival

REACHED = 1 / 0.9
"""A buckling factor below this times the one that is due counts as what governs."""
METHOD = (
    "change on twice the subdivisions, and the cross-check difference of the state that the "
    "paper's criteria sized, root of the sum of squares; volumes with the larger of those of "
    "displacement and mean utilization and the change of volume that ends the loop, on the share "
    "of panels not at a bound"
)
MEASURED = (
    "Utilization is the largest share of what steel and concrete of a panel allow: struts, ratio "
    "of steel, shear, room for bars. Thin panels are used by the room that bars take, whatever "
    "their stress, which evens utilization out."
)
BUCKLING = (
    "Buckling factors stand over the factor that is due, {due:g}; the load factor of strength is "
    "taken as 1 over the largest share."
)
NOTES = {
    "C7": "The stronger axis is asked at one thickness of all panels: no sizing enters.",
    "C8": "Depth is that of the folded sheet: no sizing enters; it does in the displacement.",
    "C9": "The size of panels is that of the folded sheet: no sizing enters.",
    "C11": MEASURED,
    "C12": "Displacements: sizing enters by the thicknesses alone, no strength does.",
    "C13": "Displacements of both sheets at the volume that reinforcement asks for; the flat "
    "sheet is elastic and is not asked whether it could be reinforced.",
}


def judge_reinforced(
    paper: Sequence[DesignResult],
    reinforced: Sequence[DesignResult],
    equal: Sequence[DesignResult],
    flats: Mapping[str, tuple[FlatEqualRecord, FlatEqualRecord]],
    comparer: Comparer,
    factor_due: float,
) -> list[ReinforcedClaim]:
    """Return the entries of claims_reinforced.json.

    Parameters
    ----------
    paper, reinforced : the same designs, sized by the paper's criteria and as reinforced concrete
    equal : states of one thickness for all panels
    flats : flat sheets with the volume of either, by folded design
    factor_due : buckling factor that the loop of the second keeps
    """
    standing = [replace_factor(one, factor_due) for one in reinforced]
    own = replace(comparer, buckling_factor_min=REACHED)
    before = judge_sized(paper, equal, {name: one for name, (one, _) in flats.items()}, comparer)
    after = judge_sized(standing, equal, {name: one for name, (_, one) in flats.items()}, own)
    return [
        _describe(first, add_steel(second, standing, own), paper, comparer, factor_due)
        for first, second in zip(before, after, strict=True)
    ]


def replace_factor(design_result: DesignResult, due: float) -> DesignResult:
    """Return a result whose buckling factor stands over the one that is due."""
    factor = design_result.values.buckling_factor
    own = None if factor is None else factor / due
    return replace(design_result, values=replace(design_result.values, buckling_factor=own))


def add_steel(claim: Claim, design_results: Sequence[DesignResult], comparer: Comparer) -> Claim:
    """Return a claim with, beside each of its findings on volume by area, the same on steel."""
    named = {one.name: one for one in design_results}
    found = [
        comparer.compare(f"{one.part} (steel)", *(named[n] for n in one.designs), "steel_kg_m2")
        for one in claim.findings
        if one.quantity == "volume_per_area" and all(_has_steel(named[n]) for n in one.designs)
    ]
    aside = tuple(dict.fromkeys(one.part for one in found))
    return replace(claim, findings=[*claim.findings, *found], open=(*claim.open, *aside))


def _has_steel(design_result: DesignResult) -> bool:
    return design_result.measure("steel_kg_m2") is not None


def _describe(
    before: Claim, after: Claim, paper: Sequence[DesignResult], comparer: Comparer, due: float
) -> ReinforcedClaim:
    """Return one entry; `before` is the claim on `paper`, `after` on what stands."""
    notes = [NOTES[after.key]] if after.key in NOTES else [MEASURED]
    notes += [BUCKLING.format(due=due)] if after.key == "C10" else []
    entry = describe_claim(replace(after, notes=(*after.notes, *notes), method=METHOD))
    verdict, parts = before.judge()
    own = {part.part: part.verdict for part in entry.numbers.parts}
    return ReinforcedClaim(
        **{one.name: getattr(entry, one.name) for one in fields(entry)},
        paper=JudgedParts(verdict=verdict, parts=parts),
        by_strips=judge_by_strips(before.key, paper, comparer),
        survives=compare_verdicts(verdict, entry.verdict),
        parts_survive={
            part: compare_verdicts(parts[part], found)
            for part, found in own.items()
            if part in parts
        },
    )


def compare_verdicts(before: str, after: str) -> Survival:
    """Return what becomes of a verdict: what held survives or falls, what did not may come to."""
    if UNTOLD in (before, after):
        return "cannot be told"
    if before == HOLDS:
        return "survives" if after == HOLDS else "falls"
    return "comes to hold" if after == HOLDS else "never held"
