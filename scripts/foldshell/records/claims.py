"""claims.json: the claims of the paper, judged."""

from dataclasses import dataclass
from typing import Literal

from foldshell.records.entry import COUNT, entry
from foldshell.records.measures import FlatSheet

Judgement = Literal["holds", "fails", "mixed", "cannot_be_told"]


@dataclass(frozen=True)
class Finding:
    """One statement about one design or two: `part` says it in words.

    `values` are the two numbers compared, or a number and its limit; the statement is that the
    first is the greater. `uncertainty` has the unit of the values, None where it is not known.
    """

    part: str = entry("the statement in words")
    designs: tuple[str, ...] = entry("one design, or the two that are compared")
    quantity: str = entry("key of what is compared, or of both, comma-separated")
    unit: str = entry("unit of values and uncertainty")
    values: tuple[float | None, float | None] = entry(
        "both numbers, or a number and its limit, in `unit`; the first is to be the greater"
    )
    uncertainty: float | None = entry(
        "uncertainty of their difference in `unit`; null where it is not known"
    )
    verdict: Judgement = entry("whether it is so")


@dataclass(frozen=True, kw_only=True)
class PartRecord:
    """One part of a claim."""

    part: str = entry("the statement in words")
    verdict: Judgement = entry("verdict on the part")
    asserted: bool = entry("whether it enters the verdict of the claim")
    holds: int = entry("findings that hold", COUNT)
    fails: int = entry("findings that fail", COUNT)
    cannot_be_told: int = entry("findings that cannot be told", COUNT)


@dataclass(frozen=True, kw_only=True)
class Correlation:
    """How planarity and utilization of panels go together."""

    panels: int = entry("panels", COUNT)
    spearman: float | None = entry("rank correlation; null where one of both is constant", "-")
    pearson: float | None = entry("linear correlation; null where one of both is constant", "-")


@dataclass(frozen=True, kw_only=True)
class ClaimNumbers:
    """What a verdict rests on: parts with findings, or correlations."""

    parts: tuple[PartRecord, ...] | None = entry("parts of the claim", left_out=True)
    findings: tuple[Finding, ...] | None = entry("findings in the order of parts", left_out=True)
    held_by: dict[str, int] | None = entry(
        "designs at each limit, one perhaps at several", COUNT, left_out=True
    )
    flat: dict[str, FlatSheet] | None = entry(
        "the flat sheet of the same volume by folded design", left_out=True
    )
    pooled: Correlation | None = entry("over the panels of all designs", left_out=True)
    by_surface: dict[str, Correlation] | None = entry("over those of a surface", left_out=True)
    by_design: dict[str, Correlation] | None = entry("over those of a design", left_out=True)
    spearman_median: float | None = entry("median over designs", "-", left_out=True)
    spearman_range: tuple[float, float] | None = entry(
        "least and largest over designs", "-", left_out=True
    )
    designs_positive: int | None = entry(
        "designs with a positive rank correlation", COUNT, left_out=True
    )


@dataclass(frozen=True, kw_only=True)
class Uncertainty:
    """How sure the numbers of a claim are."""

    largest_relative: dict[str, float] = entry("largest relative uncertainty by quantity", "-")
    method: str = entry("what it is made of")


@dataclass(frozen=True, kw_only=True)
class JudgedParts:
    """Verdict of a claim and of its parts."""

    verdict: Judgement = entry("verdict of the claim")
    parts: dict[str, Judgement] = entry("verdict of each part")


@dataclass(frozen=True, kw_only=True)
class JudgedVariants:
    """A claim on the designs that were run with other settings."""

    designs: tuple[str, ...] = entry("these designs")
    verdicts: dict[str, JudgedParts] = entry("verdicts by variant")
    changes: dict[str, dict[str, Judgement]] = entry(
        "verdicts by variant that differ from those of the base"
    )


@dataclass(frozen=True, kw_only=True)
class Dependence:
    """How far a claim hangs on settings that the paper leaves open."""

    words: str = entry("the same in words")
    runs: JudgedVariants | None = entry("under other settings; null where none was run")
    equal_thickness: JudgedParts | None = entry(
        "at one thickness for all panels; null where the claim is not asked there"
    )
    by_strips: JudgedParts | None = entry(
        "on the same final states, with the utilization of strips; null where none enters",
        default=None,
    )


@dataclass(frozen=True, kw_only=True)
class ClaimRecord:
    """One entry of claims.json."""

    id: str = entry("C1 to C14, or a name for what the paper left open")
    claim: str = entry("the claim in words")
    verdict: Judgement = entry("verdict of the study")
    numbers: ClaimNumbers = entry("what the verdict rests on")
    designs: tuple[str, ...] = entry("designs that it rests on")
    uncertainty: Uncertainty = entry("how sure these numbers are")
    notes: tuple[str, ...] = entry("what a reader must know besides")
    sensitivity: Dependence | None = entry("how far it hangs on settings", left_out=True)
