"""A claim as it leaves the study: verdict, findings by part, what it rests on."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from foldshell.claims.finding import (
    Finding,
    count_verdicts,
    judge_claim,
    judge_part,
)
from foldshell.records.claims import ClaimNumbers, ClaimRecord, PartRecord, Uncertainty

Judge = Callable[[Sequence[Finding]], str]
STATEMENTS = {
    "C1": "Folding the Miura is auxetic: its in-plane Poisson's ratio is negative",
    "C2": "The folded sheet twists or bends into a saddle most easily; arch and dome cost "
    "distortion",
    "C3": "Quadrilaterals alone are over-constrained and need one governing force; the "
    "triangulated mesh folds whatever the strengths",
    "C4": "Lower curvature gives better utilization and more deflection",
    "C5": "Greater curvature needs more material, unlike a smooth shell of similar shape",
    "C6": "The paraboloid takes the most volume per area under every support, the hypar the least",
    "C7": "Strip edges supported: more even utilization, more volume and more deflection than "
    "zig-zag edges supported; the zig-zag axis is the stronger",
    "C8": "Fewer zig-zags: deeper section, less deflection",
    "C9": "More strips: smaller panels, better spread of utilization",
    "C10": "Utilization is low overall because buckling comes first",
    "C11": "On two opposite edges many designs do not reach utilization 1 within the iterations, "
    "for a few elements at the free edges",
    "C12": "Deflection is greatest along unsupported edges",
    "C13": "Folds stiffen: the folded sheet against the unfolded flat sheet of equal material",
    "C14": "Rigid foldability, flat foldability and developability are respected",
}


@dataclass(frozen=True)
class Claim:
    """Findings of one claim. `judges` names parts that are not judged by `judge_part`; `open` are
    parts that are reported beside the claim and do not enter its verdict; `method` says what its
    uncertainty is made of."""

    key: str
    findings: Sequence[Finding]
    judges: Mapping[str, Judge] = field(default_factory=dict)
    open: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    numbers: ClaimNumbers = field(default_factory=ClaimNumbers)
    method: str | None = None

    @property
    def parts(self) -> dict[str, list[Finding]]:
        """Findings by part, in order."""
        found: dict[str, list[Finding]] = {}
        for finding in self.findings:
            found.setdefault(finding.part, []).append(finding)
        return found

    def judge(self) -> tuple[str, dict[str, str]]:
        """Return the verdict of the claim and of each part."""
        parts = {
            part: self.judges.get(part, judge_part)(findings)
            for part, findings in self.parts.items()
        }
        return judge_claim(v for part, v in parts.items() if part not in self.open), parts


def describe_claim(claim: Claim) -> ClaimRecord:
    """Return the entry of claims.json, without what settings change."""
    verdict, verdicts = claim.judge()
    findings = tuple(finding for part in claim.parts.values() for finding in part)
    parts = tuple(
        PartRecord(
            part=part,
            verdict=verdicts[part],
            asserted=part not in claim.open,
            **count_verdicts(found),
        )
        for part, found in claim.parts.items()
    )
    return ClaimRecord(
        id=claim.key,
        claim=STATEMENTS[claim.key],
        verdict=verdict,
        numbers=replace(claim.numbers, parts=parts, findings=findings),
        designs=tuple(sorted({name for f in claim.findings for name in f.designs})),
        uncertainty=describe_uncertainty(claim),
        notes=tuple(claim.notes),
    )


def describe_uncertainty(claim: Claim) -> Uncertainty:
    """Return the largest relative uncertainty of each quantity, and what it is made of."""
    largest: dict[str, float] = {}
    for finding in claim.findings:
        known = [abs(value) for value in finding.values if value is not None]
        if finding.uncertainty and known and max(known):
            relative = finding.uncertainty / max(known)
            largest[finding.quantity] = max(largest.get(finding.quantity, 0.0), relative)
    volumes = VOLUMES if any(name.startswith("volume") for name in largest) else ""
    method = claim.method or (METHOD + volumes if largest else EXACT)
    return Uncertainty(largest_relative=largest, method=method)


METHOD = "mesh error and cross-check difference of both numbers, root of the sum of squares"
VOLUMES = (
    "; volumes with the larger of those of displacement and utilization and the change of volume "
    "that ends the loop, on the share of panels not at a bound"
)
EXACT = "counts, geometry and closed forms: no mesh error enters"
