"""Claims on folding: C1, C2, C3 and C14."""

from collections.abc import Sequence
from itertools import product

from foldshell.claims.design_result import (
    Comparer,
    DesignResult,
    group_by_others,
    select,
    select_folded,
    state_fact,
)
from foldshell.claims.finding import FAILS, HOLDS, Finding, judge_difference
from foldshell.claims.statement import Claim
from foldshell.claims.words import verdict_label
from foldshell.records.kinematics import ForceRatioTrial, KinematicsRecord, SheetRecord

SOFT_SHAPES = {"twist", "saddle"}
ISOMETRIC = 1e-6
"""Residual of a bending mode, relative to the mode, up to which it costs no distortion."""

RESPECTED = {
    "rigid foldability": ("planarity_max", "edge_strain_max"),
    "developability": ("angle_defect_max_rad",),
    "flat foldability": ("flat_foldability_max_rad",),
}
RESPECTED_LIMIT = 1e-3
"""Largest planarity (-), strain (-) and defect of angles (rad) of a sheet that can be made: paper
and plate of a metre open by a millimetre."""


def judge_auxetic(kinematics: KinematicsRecord) -> Claim:
    """C1: in-plane ratio of finite folding steps; its uncertainty is the gap to the closed form."""
    part = "negative in-plane Poisson's ratio"
    findings = []
    for row in kinematics.ratios:
        gap = abs(row.in_plane - row.in_plane_exact)
        values = 0.0, row.in_plane
        name = f"Miura cell folded by {row.fold_angle_deg:.4g} deg"
        verdict = judge_difference(*values, gap)
        findings.append(Finding(part, (name,), "zero, in-plane ratio", "-", values, gap, verdict))
    method = "a finite step of folding against the closed form"
    return Claim("C1", findings, method=method)


def judge_soft_modes(
    kinematics: KinematicsRecord, design_results: Sequence[DesignResult], comparer: Comparer
) -> Claim:
    """C2: the two softest modes of each sheet, bending without distortion, strain of designs."""
    findings = []
    for sheet in kinematics.sheets:
        name = f"Miura sheet {sheet.zigzag}x{sheet.strip}"
        findings += _find_soft(name, sheet)
        for shape in ("dome", "arch"):
            values = sheet.isometry_residual[shape], sheet.isometry_residual["saddle"]
            part, verdict = f"{shape} costs distortion", judge_difference(*values, ISOMETRIC)
            names = "isometry residual, that of the saddle"
            findings.append(Finding(part, (name,), names, "-", values, ISOMETRIC, verdict))
    for group in group_by_others(select_folded(design_results), "surface"):
        for surface, shape in (("paraboloid", "dome"), ("arch", "arch")):
            if {surface, "hypar"} <= set(group):
                pair = group[surface], group["hypar"]
                part = f"{shape}: edges of designs strained more than the hypar's"
                findings.append(comparer.compare(part, *pair, "edge_strain_rms"))
    method = f"isometry residuals up to {ISOMETRIC:g} count as none; strains are geometry"
    return Claim("C2", findings, method=method)


def _find_soft(name: str, sheet: SheetRecord) -> list[Finding]:
    """Return whether the two softest modes are twist and saddle, for each panel stiffness."""
    found = []
    for ratio in dict.fromkeys(mode.panel_over_crease for mode in sheet.modes):
        modes = [mode for mode in sheet.modes if mode.panel_over_crease == ratio]
        first, third = modes[:2], modes[2].stiffness if len(modes) > 2 else None
        verdict = HOLDS if {mode.shape for mode in first} == SOFT_SHAPES else FAILS
        design = f"{name}, panels {ratio:g} times as stiff as creases"
        part = "twist and saddle are the softest"
        quantity = "stiffness over that of twist: third mode, second mode"
        values = third, first[-1].stiffness
        found.append(Finding(part, (design,), quantity, "-", values, 0.0, verdict))
    return found


CONSTRAINED = "quadrilaterals are over-constrained, triangles are not"
MEASURES = {
    "reached": "reach the target",
    "folded": "reach it without shear of panels",
}
"""What counts as folded: lying on the target without turned folds; and unsheared beside that."""
KINDS = {"quadrilaterals": "some strengths only", "triangles": "all strengths"}
READING = (
    "One governing force is needed where some pairs of strengths (attraction to the target, "
    "flatness of panels) reach the target and others do not; a panel is sheared where a diagonal "
    "strains by more than a tenth."
)


def judge_force_ratios(kinematics: KinematicsRecord) -> Claim:
    """C3: self-stresses of rigid quadrilaterals; which strengths fold them, and triangles.

    Both engines have to agree; a note gives the verdict of each by itself.
    """
    stresses = []
    for sheet in kinematics.sheets:
        counts = [one.self_stresses for one in (sheet.rigid_panels, sheet.bending_panels)]
        name = f"Miura sheet {sheet.zigzag}x{sheet.strip}"
        verdict = HOLDS if counts[0] > 0 and counts[1] == 0 else FAILS
        quantity = "self-stresses: quadrilaterals, triangles"
        values = tuple(counts)
        stresses.append(Finding(CONSTRAINED, (name,), quantity, "-", values, 0.0, verdict))
    aside = tuple(_name_part(kind, "folded") for kind in KINDS)
    engines: dict[str, list[ForceRatioTrial]] = {}
    for row in kinematics.force_ratios:
        engines.setdefault(verdict_label(row.engine), []).append(row)
    shares, notes = [], [READING]
    for engine, rows in engines.items():
        found = _find_force_ratios(engine, rows)
        shares += found
        alone, _ = Claim("C3", [*stresses, *found], open=aside).judge()
        most = max(row.iterations for row in rows)
        words = f"{verdict_label(alone)}, from {len(rows)} foldings of at most {most} iterations"
        notes.append(f"By {engine} alone: {words}.")
    return Claim("C3", [*stresses, *shares], open=aside, notes=tuple(notes))


def _name_part(kind: str, measure: str) -> str:
    return f"{kind} {MEASURES[measure]} at {KINDS[kind]}"


def _find_force_ratios(engine: str, rows: Sequence[ForceRatioTrial]) -> list[Finding]:
    """Return the share of the strengths by which an engine folds each mesh on each surface."""
    found = []
    surfaces = dict.fromkeys(row.surface for row in rows)
    for measure, kind, surface in product(MEASURES, KINDS, surfaces):
        folded = [
            getattr(row, measure) for row in rows if (row.panels, row.surface) == (kind, surface)
        ]
        share = sum(folded) / len(folded)
        true = share == 1 if kind == "triangles" else 0 < share < 1
        name = f"{kind}, {surface}, {engine}, {len(folded)} settings"
        part = _name_part(kind, measure)
        found.append(state_fact(part, name, "share of settings", share, 1.0, true))
    return found


def judge_foldability(design_results: Sequence[DesignResult]) -> Claim:
    """C14: planarity, strain, sum of angles and Kawasaki's sum of every folded design.

    The designs folded as in the paper decide; the other modes stand beside the verdict.
    """
    findings, aside = [], []
    for one in select(design_results, pattern="miura"):
        mode = one.row.fold_mode
        for name, quantities in RESPECTED.items():
            worst = max(quantities, key=one.measure)
            value = one.measure(worst)
            part = name if mode == "elastic" else f"{name}, mode {mode}"
            true = value <= RESPECTED_LIMIT
            findings.append(state_fact(part, one.name, worst, value, RESPECTED_LIMIT, true))
            if part != name and part not in aside:
                aside.append(part)
    return Claim("C14", findings, open=tuple(aside), notes=(MODES,))


MODES = (
    f"Respected means up to {RESPECTED_LIMIT:g} all over the sheet: planarity of panels and strain "
    "of edges, sum of angles, Kawasaki's sum. Designs folded as in the paper, by forces that trade "
    "strain against the target, decide; the modes exact and rigid show what the same targets allow."
)
