"""The page of the claims on shells that are made to stand."""

from collections import Counter
from collections.abc import Sequence

from foldshell.claims.words import format_value, make_table, verdict_label, write_section
from foldshell.records.reinforced_claims import ReinforcedClaim, ReinforcedRecord

HEAD = """# Claims on shells that stand

The designs of the study sized anew as reinforced concrete by {file}, until the checks of it hold
and the buckling factor is what is due, and the statements C4 to C13 asked again. Beside each stands
what it came to on the designs as the paper's criteria sized them, by its measure and by strips.
docs/study.md explains the method, docs/concrete.md the checks.
"""
WORDS = {"never held": "did not hold before"}
"""What becomes of a claim in other words than in its record."""


def write_reinforced_claims(
    claims: Sequence[ReinforcedClaim], states: Sequence[ReinforcedRecord], file: str
) -> str:
    """Return the page: an overview, what stands, a section a claim."""
    rows = [
        [
            one.id,
            one.claim,
            verdict_label(one.paper.verdict),
            verdict_label(one.by_strips.verdict) if one.by_strips else "-",
            verdict_label(one.verdict),
            WORDS.get(one.survives, one.survives),
        ]
        for one in claims
    ]
    header = ["id", "claim", "paper's measure", "by strips", "reinforced", "it"]
    parts = [HEAD.format(file=f"`{file}`"), make_table(header, rows)]
    parts += [write_changes(claims), write_states(states)]
    return "\n".join([*parts, *(write_section(one) for one in claims)])


def write_changes(claims: Sequence[ReinforcedClaim]) -> str:
    """Return the table of parts whose verdict is another one when the shell stands."""
    rows = []
    for one in claims:
        own = {part.part: part.verdict for part in one.numbers.parts}
        rows += [
            [one.id, part, verdict_label(before), verdict_label(own[part])]
            for part, before in one.paper.parts.items()
            if part in own and own[part] != before
        ]
    if not rows:
        return "No part has another verdict than on the designs of the paper's criteria.\n"
    words = "Parts with another verdict than on the designs of the paper's criteria:\n\n"
    return words + make_table(["id", "part", "paper's measure", "reinforced"], rows)


def write_states(states: Sequence[ReinforcedRecord]) -> str:
    """Return what the designs came to: state, volume, steel, what governs, engineering verdict."""
    count = Counter(one.engineering for one in states)
    said = ", ".join(f"{number} {verdict_label(name)}" for name, number in sorted(count.items()))
    rows = [
        [
            one.design,
            verdict_label(one.measures.state),
            str(one.measures.iterations),
            format_value(one.measures.volume),
            format_value(one.measures.steel_kg_m2),
            format_value(one.measures.utilization_reinforced_mean),
            format_value(one.measures.displacement, 1e3),
            format_value(one.measures.buckling_factor),
            _most(one),
            verdict_label(one.engineering),
        ]
        for one in states
    ]
    header = ["design", "state", "iterations", "volume [m3]", "steel [kg/m2]", "utilization",
              "displacement [mm]", "buckling factor", "governs most panels",
              "engineering"]  # fmt: skip
    failing = [f"- {one.design}: {one.engineering_reason}\n" for one in states
               if one.engineering == "fails"]  # fmt: skip
    why = "Why those fail:\n\n" + "".join(failing) if failing else ""
    return f"## What stands\n\nEngineering verdict: {said}.\n\n{make_table(header, rows)}\n{why}"


def _most(state: ReinforcedRecord) -> str:
    shares = state.governing_share
    if not shares:
        return "-"
    name = max(shares, key=shares.__getitem__)
    return f"{name}, {100 * shares[name]:.0f} %"
