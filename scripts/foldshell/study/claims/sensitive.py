"""How far verdicts depend on settings that the paper leaves open."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from foldshell.study.claims import limits, structure
from foldshell.study.claims.finding import UNTOLD
from foldshell.study.claims.outcome import Comparer, Outcome
from foldshell.study.claims.statement import Claim

BASE = "base"
Judgement = Callable[[Sequence[Outcome], Comparer], Claim]
SENSITIVE: dict[str, Judgement] = {
    "C4": structure.judge_curvature,
    "C5": structure.judge_material,
    "C6": structure.judge_surfaces,
    "C7": structure.judge_supports,
    "C8": structure.judge_zigzags,
    "C9": structure.judge_strips,
    "C10": limits.judge_buckling,
    "C11": lambda outcomes, comparer: limits.judge_free_edges(outcomes),
    "C12": limits.judge_deflected_edges,
}
"""Claims that settings of the loop enter."""


def judge_variants(
    key: str, variants: Mapping[str, Sequence[Outcome]], comparer: Comparer
) -> dict[str, Any] | None:
    """Return the verdicts of a claim under every variant, on the designs that were run.

    None where the claim knows no setting of the loop, or none of its designs was run.
    """
    if key not in SENSITIVE:
        return None
    claims = {name: SENSITIVE[key](outcomes, comparer) for name, outcomes in variants.items()}
    if BASE not in claims or not claims[BASE].findings:
        return None
    verdicts = {}
    for name, claim in claims.items():
        verdict, parts = claim.judge()
        verdicts[name] = {"verdict": verdict, "parts": parts}
    base = verdicts[BASE]["verdict"]
    return {
        "designs": sorted({name for f in claims[BASE].findings for name in f.designs}),
        "verdicts": verdicts,
        "changed_by": [name for name, found in verdicts.items() if found["verdict"] != base],
    }


def judge_equal_thickness(
    key: str, equal: Sequence[Outcome], comparer: Comparer
) -> dict[str, Any] | None:
    """Return the verdicts of a claim on the start states, all panels of one thickness.

    Neither start nor least thickness, stop rule nor measure enters; volumes say nothing there.
    """
    if key not in ("C4", "C7", "C8", "C9"):
        return None
    claim = SENSITIVE[key](equal, comparer)
    kept = [f for f in claim.findings if not f.quantity.startswith("volume")]
    verdict, parts = replace(claim, findings=kept).judge()
    return {"verdict": verdict, "parts": parts}


def describe_dependence(
    claim: Claim, runs: Mapping[str, Any] | None, equal: Mapping[str, Any] | None
) -> str:
    """Say in words how far a verdict depends on the settings."""
    words = []
    if claim.key in ("C1", "C2", "C3", "C14"):
        return "No setting of the sizing loop enters."
    if runs is None:
        words.append("The runs with other settings hold no pair of this claim.")
    else:
        base = runs["verdicts"][BASE]["verdict"]
        words.append(f"On the {len(runs['designs'])} designs run with other settings: {_say(base)}")
        others = [name for name in runs["verdicts"] if name != BASE]
        same = [name for name in others if name not in runs["changed_by"]]
        if same:
            words[-1] += f", and the same with {', '.join(same)}"
        changed = [f"{_say(runs['verdicts'][n]['verdict'])} with {n}" for n in runs["changed_by"]]
        words[-1] += f"; {'; '.join(changed)}." if changed else "."
    if equal is not None and equal["verdict"] != UNTOLD:
        parts = ", ".join(f"{part}: {_say(v)}" for part, v in equal["parts"].items())
        words.append(f"At one thickness for all panels, before any sizing: {parts}.")
    return " ".join(words)


def _say(verdict: str) -> str:
    return verdict.replace("_", " ")
