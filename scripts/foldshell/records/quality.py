"""quality.json: what folding a sheet onto its target came to."""

from dataclasses import dataclass
from typing import Literal

from foldshell.records.entry import COUNT, elapsed, entry


@dataclass(frozen=True, kw_only=True)
class QualityMeasures:
    """Measures of a folded sheet; ratios are non-dimensional.

    Those against a target, or against the flat sheet, are null where there is none.
    """

    rms_over_span: float | None = entry(
        "rms distance of the attracted vertices to the target, over the span",
        "-", "rms distance to the target / span",
    )  # fmt: skip
    max_over_span: float | None = entry(
        "largest distance of an attracted vertex to the target, over the span",
        "-", "largest distance to the target / span",
    )  # fmt: skip
    edge_strain_max: float | None = entry(
        "largest strain of an edge, folded against flat",
        "-",
        "largest strain of an edge",
        shown="%",
    )
    edge_strain_rms: float | None = entry(
        "rms strain of all edges", "-", "rms strain of the edges", shown="%"
    )
    angle_defect_max_rad: float = entry(
        "largest difference of a vertex's angle sum from a full turn",
        "rad", "largest defect of a vertex's angle sum",
    )  # fmt: skip
    planarity_max: float = entry(
        "largest distance between a panel's diagonals, over their mean length",
        "-", "planarity, largest", shown="%",
    )  # fmt: skip
    planarity_mean: float = entry(
        "mean over panels of the distance between diagonals, over their mean length",
        "-", "planarity, mean",
    )  # fmt: skip
    neutral_fold_mean_deg: float = entry(
        "mean fold along the diagonals of panels", "deg", "mean fold across panels"
    )
    neutral_fold_max_deg: float = entry(
        "largest fold along the diagonal of a panel", "deg", "largest fold across a panel"
    )
    flipped_folds: int = entry("creases folded against their assignment", COUNT, "flipped folds")
    self_intersections: int = entry(
        "pairs of facets that cut each other", COUNT, "self-intersections"
    )
    plan_coverage: float | None = entry(
        "share of the square plan that lies under the sheet",
        "-", "share of the plan that is covered",
    )  # fmt: skip
    panels_not_convex: int = entry("panels with a corner that turns inward", COUNT)
    edge_ratio_max: float = entry("largest ratio of the longest to the shortest side of a panel",
                                  "-")  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class QualityRecord(QualityMeasures):
    """The contents of quality.json: measures of the sheet, effort, and what its mode adds."""

    state: Literal["ok", "not_reached", "crumpled"] = entry(
        "ok, not_reached (target or tolerance missed) or crumpled (folds turned over, facets cut "
        "each other, too little of the plan covered)"
    )
    reason: str = entry("why the folding ended so")
    cost: float | None = entry("value of the minimised function, elastic mode", "-", left_out=True)
    constraint_residual: float | None = entry(
        "largest residual of the constraints, modes with hard constraints", "-", left_out=True
    )
    start_sector_angle_deg: float | None = entry(
        "sector angle of the pattern that the search began with", "deg", left_out=True
    )
    unfold_closure_m: float | None = entry(
        "gap where the sheet closes when its facets are laid flat one by one",
        "m", "closure when unfolded", left_out=True,
    )  # fmt: skip
    path_intersections: int | None = entry(
        "pairs of facets that cut each other on the way of folding, rigid mode",
        COUNT, left_out=True,
    )  # fmt: skip
    refold_closure_m: float | None = entry(
        "largest distance of a vertex from its place when the flat pattern is folded again",
        "m", "closure when folded again", left_out=True,
    )  # fmt: skip
    beyond_border_m: float | None = entry(
        "largest distance of an attracted vertex from the surface of a mesh file where it lies "
        "beyond its border, and the surface is taken to go on along its tangent",
        "m", "reach beyond the surface's border", left_out=True,
    )  # fmt: skip
    outline_overlap: float | None = entry(
        "intersection over union, in plan, of the cut sheet with what the outline leaves of the "
        "whole one",
        "-", "overlap of the cut sheet with its outline", left_out=True,
    )  # fmt: skip
    outline_overlap_shell: float | None = entry(
        "the same of the shell mesh, whose short sides are collapsed",
        "-", "overlap of the shell mesh with the outline", left_out=True,
    )  # fmt: skip
    outline_covered: float | None = entry(
        "share of the outline's area that the sheet covers in plan",
        "-", "share of the outline that the sheet covers", left_out=True,
    )  # fmt: skip
    notes: tuple[str, ...] | None = entry(
        "what of the file of the sheet was mended or is to be known", left_out=True
    )
    iterations: int = entry("iterations of the solver", COUNT)
    seconds: float | None = elapsed()
