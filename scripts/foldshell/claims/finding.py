"""Single findings with their uncertainty, and how a verdict is made of many."""

import math
from collections.abc import Iterable, Sequence

from foldshell.records.claims import Finding

HOLDS, FAILS, MIXED, UNTOLD = "holds", "fails", "mixed", "cannot_be_told"
ROUNDING = 1e-9
"""Relative difference up to which two numbers count as equal."""


def judge_difference(
    greater: float | None, lesser: float | None, uncertainty: float | None, strict: bool = True
) -> str:
    """Return whether greater > lesser by more than the uncertainty; >= where not `strict`.

    A difference within the uncertainty, or a number that is missing, cannot be told.
    """
    if greater is None or lesser is None or uncertainty is None:
        return UNTOLD
    rounding = ROUNDING * max(abs(greater), abs(lesser))
    if not strict and uncertainty <= rounding and abs(greater - lesser) <= rounding:
        return HOLDS
    if greater - lesser > uncertainty + rounding:
        return HOLDS
    return FAILS if lesser - greater > uncertainty + rounding else UNTOLD


def combine_errors(*errors: float | None) -> float | None:
    """Return the root of the sum of squares; None where one is not known."""
    return None if any(error is None for error in errors) else math.hypot(*errors)


def count_verdicts(findings: Iterable[Finding]) -> dict[str, int]:
    """Return how many findings hold, fail and cannot be told."""
    verdicts = [finding.verdict for finding in findings]
    return {name: verdicts.count(name) for name in (HOLDS, FAILS, UNTOLD)}


def judge_part(findings: Sequence[Finding]) -> str:
    """Return the verdict of one part: holds or fails where all findings that can be told do.

    Cannot be told where more than half cannot, unless the others contradict each other.
    """
    count = count_verdicts(findings)
    if count[HOLDS] and count[FAILS]:
        return MIXED
    if count[UNTOLD] >= max(1, count[HOLDS] + count[FAILS]) or not findings:
        return UNTOLD
    return HOLDS if count[HOLDS] else FAILS


def judge_many(findings: Sequence[Finding]) -> str:
    """Return the verdict of a part that says "many": holds for at least half of the findings."""
    count = count_verdicts(findings)
    if not count[HOLDS] + count[FAILS]:
        return UNTOLD
    if 2 * count[HOLDS] >= len(findings):
        return HOLDS
    return MIXED if count[HOLDS] else FAILS


def judge_claim(parts: Iterable[str]) -> str:
    """Return the verdict of a claim all of whose parts are asserted together.

    One part that fails beside one that holds makes it mixed; one that cannot be told leaves a
    claim open whose other parts hold, but does not save one whose other parts fail.
    """
    found = set(parts)
    if not found - {UNTOLD}:
        return UNTOLD
    told = found - {UNTOLD}
    if told == {FAILS}:
        return FAILS
    if told == {HOLDS}:
        return UNTOLD if UNTOLD in found else HOLDS
    return MIXED
