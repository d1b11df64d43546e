"""How far verdicts depend on settings that the paper leaves open."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from foldshell.claims import limits, structure
from foldshell.claims.design_result import Comparer, DesignResult
from foldshell.claims.finding import UNTOLD
from foldshell.claims.statement import Claim
from foldshell.claims.words import verdict_label
from foldshell.records.claims import JudgedParts, JudgedVariants

BASE = "base"
Judgement = Callable[[Sequence[DesignResult], Comparer], Claim]
SENSITIVE: dict[str, Judgement] = {
    "C4": structure.judge_curvature,
    "C5": structure.judge_material,
    "C6": structure.judge_surfaces,
    "C7": structure.judge_supports,
    "C8": structure.judge_zigzags,
    "C9": structure.judge_strips,
    "C10": limits.judge_buckling,
    "C11": lambda design_results, comparer: limits.judge_free_edges(design_results),
    "C12": limits.judge_deflected_edges,
}
"""Claims that settings of the loop enter."""


def judge_variants(
    key: str, variants: Mapping[str, Sequence[DesignResult]], comparer: Comparer
) -> JudgedVariants | None:
    """Return the verdicts of a claim under every variant, on the designs that were run.

    None where the claim knows no setting of the loop, or none of its designs was run.
    """
    if key not in SENSITIVE:
        return None
    claims = {
        name: SENSITIVE[key](design_results, comparer) for name, design_results in variants.items()
    }
    if BASE not in claims or not claims[BASE].findings:
        return None
    verdicts = {}
    for name, claim in claims.items():
        verdict, parts = claim.judge()
        verdicts[name] = JudgedParts(verdict=verdict, parts=parts)
    changes = {name: _find_changes(verdicts[BASE], found) for name, found in verdicts.items()}
    return JudgedVariants(
        designs=tuple(sorted({name for f in claims[BASE].findings for name in f.designs})),
        verdicts=verdicts,
        changes={name: found for name, found in changes.items() if found},
    )


def _find_changes(base: JudgedParts, found: JudgedParts) -> dict[str, str]:
    """Return the verdicts, of the claim and of its parts, that differ from those of the base."""
    claim = {"the claim": found.verdict} if found.verdict != base.verdict else {}
    parts = {
        part: verdict for part, verdict in found.parts.items() if base.parts.get(part) != verdict
    }
    return claim | parts


def judge_equal_thickness(
    key: str, equal: Sequence[DesignResult], comparer: Comparer
) -> JudgedParts | None:
    """Return the verdicts of a claim on the start states, all panels of one thickness.

    Neither start nor least thickness, stop rule nor measure enters; volumes say nothing there.
    """
    if key not in ("C4", "C7", "C8", "C9"):
        return None
    claim = SENSITIVE[key](equal, comparer)
    kept = [f for f in claim.findings if not f.quantity.startswith("volume")]
    verdict, parts = replace(claim, findings=kept).judge()
    return JudgedParts(verdict=verdict, parts=parts)


def judge_by_strips(
    key: str, design_results: Sequence[DesignResult], comparer: Comparer
) -> JudgedParts | None:
    """Return the verdicts of a claim on the same final states, utilization being that of strips.

    None where the claim knows no utilization, or where no state has it by strips.
    """
    known = [one.by_strips for one in design_results if one.strips]
    if key not in SENSITIVE or not known:
        return None
    verdict, parts = SENSITIVE[key](known, comparer).judge()
    return JudgedParts(verdict=verdict, parts=parts) if parts else None


def _compare_measures(claim: Claim, strips: JudgedParts) -> str:
    """Say what judging by strips changes."""
    verdict, parts = claim.judge()
    base = JudgedParts(verdict=verdict, parts=parts)
    changes = _find_changes(base, strips)
    if not changes:
        return "By strips instead of panel means, on the same final states: the same verdicts."
    shown = ", ".join(f"{part}: {verdict_label(found)}" for part, found in changes.items())
    return f"By strips instead of panel means, on the same final states: {shown}."


def describe_dependence(
    claim: Claim,
    runs: JudgedVariants | None,
    equal: JudgedParts | None,
    variants: Mapping[str, Sequence[DesignResult]],
    strips: JudgedParts | None = None,
) -> str:
    """Say in words how far a verdict depends on the settings."""
    words = []
    if claim.key in ("C1", "C2", "C3", "C14"):
        return "No setting of the sizing loop enters."
    if runs is None:
        words.append(f"No run with other settings answers this claim{_spread(variants)}.")
    else:
        base, changes = runs.verdicts[BASE].verdict, runs.changes
        count = len(runs.designs)
        words.append(f"On the {count} designs run with other settings: {verdict_label(base)}")
        same = [name for name in runs.verdicts if name != BASE and name not in changes]
        if same:
            words[-1] += f", with the same verdicts of all parts for {', '.join(same)}"
        changed = [
            f"with {name} " + ", ".join(f"{part}: {verdict_label(v)}" for part, v in found.items())
            for name, found in changes.items()
        ]
        words[-1] += f"; {'; '.join(changed)}." if changed else "."
    if equal is not None and equal.verdict != UNTOLD:
        parts = ", ".join(f"{part}: {verdict_label(v)}" for part, v in equal.parts.items())
        words.append(f"At one thickness for all panels, before any sizing: {parts}.")
    if strips is not None:
        words.append(_compare_measures(claim, strips))
    return " ".join(words)


def _spread(variants: Mapping[str, Sequence[DesignResult]]) -> str:
    """Return how much volumes change between those runs, for a reader to weigh differences by."""
    base = {one.name: one.values.volume for one in variants.get(BASE, ())}
    changes = {
        name: max((abs(o.values.volume / base[o.name] - 1) for o in members), default=0.0)
        for name, members in variants.items()
        if base and name != BASE
    }
    shown = ", ".join(f"{100 * value:.3g} % with {name}" for name, value in changes.items())
    return f"; volumes of the designs run change by up to {shown}" if shown else ""
