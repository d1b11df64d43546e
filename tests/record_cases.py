"""Records with all their fields, for tests that care for a few of them."""

from dataclasses import replace

from foldshell.records.analysis import AnalysisRecord, Criteria, Criterion
from foldshell.records.classes import ClassesRecord, ThicknessClass
from foldshell.records.comparison import ComparedQuantity, ComparisonRecord
from foldshell.records.engineering import (
    CombinationFactors,
    EngineeringCheck,
    EngineeringRecord,
    Measures,
)
from foldshell.records.mesh_convergence import MeshConvergenceRecord, MeshStudy, ReferenceMesh
from foldshell.records.quality import QualityRecord
from foldshell.records.reinforcement import BarsRecord, ReinforcementRecord
from foldshell.records.summary import SummaryRow

STATE = {
    "iteration": 0, "state": "ok", "volume_m3": 100.0, "area_m2": 1000.0,
    "buckling_factor": {"S1": 12.0, "S2": 10.5, "D1": None}, "second_order_iterations": 8,
    "second_order_residual": 1e-7, "dofs": 1234, "mesh_subdivisions": 4, "element_order": 5,
}  # fmt: skip
ANALYSIS = STATE | {
    "verdict": "continue", "reason": "a reason", "criteria": Criteria(),
    "stationary_iterations": 0,
}  # fmt: skip
USED = {
    "utilization_max": 1.2, "utilization_p99": 0.9, "utilization_mean": 0.5,
    "utilization_panel_mean_max": 1.1, "governing_combination": "S2",
    "displacement_vertical_max_m": 0.02, "displacement_combination": "D1",
    "displacement_place_m": (0.0, 0.0, 5.0), "reaction_sum_kn": {"S1": (0.0, 0.0, 9.0)},
    "reaction_imbalance": 1e-13, "panels_at_bound": 2, "panels_above_one": 3,
}  # fmt: skip


def make_analysis(**changes) -> AnalysisRecord:
    """Return an analysis that goes on; those with `USED` in `changes` have numbers."""
    return AnalysisRecord(**ANALYSIS | changes)


def make_criterion(met=True, value=0.5, limit=1.0) -> Criterion:
    """Return one criterion."""
    return Criterion(value=value, limit=limit, met=met)


def make_classes(groups=(), **changes) -> ClassesRecord:
    """Return classes.json with classes of (thickness m, panels, area m2)."""
    classes = tuple(
        ThicknessClass(number=k, thickness_m=thickness, panels=panels, area_m2=area)
        for k, (thickness, panels, area) in enumerate(groups, start=1)
    )
    rest = {
        "verdict": "holds", "reason": "all criteria are met", "criteria": Criteria(), "count": 4,
        "rounds": 0, "classes": classes, "ungrouped_volume_m3": 90.0,
        "added_volume_relative": 0.12,
    }  # fmt: skip
    return ClassesRecord(**STATE | rest | changes)


def make_quality(**changes) -> QualityRecord:
    """Return quality.json of a sheet that reached its target."""
    numbers = dict.fromkeys(
        ("rms_over_span", "max_over_span", "edge_strain_max", "edge_strain_rms",
         "angle_defect_max_rad", "planarity_max", "planarity_mean", "neutral_fold_mean_deg",
         "neutral_fold_max_deg", "plan_coverage", "edge_ratio_max"), 0.01,
    )  # fmt: skip
    counts = dict.fromkeys(("flipped_folds", "self_intersections", "panels_not_convex"), 0)
    rest = {"state": "ok", "reason": "", "iterations": 7}
    return QualityRecord(**numbers | counts | rest | changes)


def make_convergence(errors=None, reason=None, **changes) -> MeshConvergenceRecord:
    """Return mesh_convergence.json with errors by combination and quantity."""
    study = MeshStudy(
        subdivisions=(4, 12), reference=ReferenceMesh(order=7), combinations={}, reason=reason
    )
    values = {"mesh_error": 0.03, "buckling_mesh_error": 0.01, "subdivisions": 4}
    return MeshConvergenceRecord(**values | changes, errors=errors or {}, study=study)


def make_check(value=0.5, limit=1.0, met=True, **changes) -> EngineeringCheck:
    """Return one engineering check."""
    rest = {
        "words": "strength on strips", "unit": "", "at_least": False,
        "governing_combination": "ULS1", "panel": 3, "mesh_error": 0.02, "within_mesh_error": False,
    }  # fmt: skip
    return EngineeringCheck(value=value, limit=limit, met=met, **rest | changes)


def make_engineering(checks=None, measures=None, **changes) -> EngineeringRecord:
    """Return engineering.json; `measures` are (panel mean, strip) by criterion."""
    made = {
        name: Measures(
            utilization_panel_mean_max=mean,
            utilization_strip_max=strip,
            panels_above_one=0,
            area_share_above_one=0.0,
        )
        for name, (mean, strip) in (measures or {"von_mises": (0.8, 1.4)}).items()
    }
    rest = {
        "verdict": "passes", "reason": "all checks are met", "material_kind": "concrete",
        "buckling_terms": {"required": 6.0}, "loop_criterion": "von_mises",
        "combinations": CombinationFactors(
            strength={"ULS1": {"SW": 1.35}}, characteristic={"SLS1": {"SW": 1.0}},
            quasi_permanent={"QP1": {"SW": 1.0}},
        ),
        "buckling_factor": {"ULS1": 12.0}, "loads": {"SW": (0.0, 0.0, -9.0)},
        "reactions": {"zigzag first": {"ULS1": (1.0, 0.0, 9.0)}}, "analyses": 2,
        "panels": {"panel": (0, 1)},
    }  # fmt: skip
    return EngineeringRecord(
        checks=checks or {"strength": make_check()}, measures=made, **rest | changes
    )


def make_steel(**changes) -> ReinforcementRecord:
    """Return the key `reinforcement` of engineering.json, of a sheet of 1100 m2."""
    shares = dict.fromkeys(("ratio", "shear", "crack", "punching"), 0.0)
    bars = BarsRecord(
        thickness_m=0.06, panels=30, layer="bottom", direction="x", diameter_mm=6.0,
        spacing_mm=100.0, area_cm2_m=2.83, mass_kg=880.0, use=0.93,
    )  # fmt: skip
    values = {
        "kind": "bars", "steel_kg_m2": 15.5, "steel_kg_m3": 197.0, "steel_needed_kg_m2": 9.5,
        "steel_kg": 17050.0, "steel_bars_kg": 1770.0, "concrete_m3": 86.5, "creases_m": 512.0,
        "two_layers_share": 0.25, "governing_share": {"strut": 0.375, "fit": 0.625} | shares,
        "over_one_share": {"strut": 0.035, "fit": 0.015} | shares,
        "co2_kg": 41800.0, "co2_low_kg": 28600.0, "co2_high_kg": 59400.0,
        "cost": 67100.0, "cost_low": 60000.0, "cost_high": 74000.0,
        "bars": (bars, replace(bars, direction="y", mass_kg=890.0)),
    }  # fmt: skip
    return ReinforcementRecord(**values | changes)


def make_quantity(passed=False, **changes) -> ComparedQuantity:
    """Return one compared quantity."""
    values = {
        "primary": 0.1, "independent": 0.11, "relative_difference": 0.09, "tolerance": 0.05,
        "unit": "kNm",
    }  # fmt: skip
    return ComparedQuantity(passed=passed, **values | changes)


def make_comparison(passed=False, quantities=None, **changes) -> ComparisonRecord:
    """Return comparison.json."""
    values = {
        "design": "case", "not_compared": (), "not_settled": (), "primary_subdivisions": (4.0,),
        "independent_subdivisions": (1, 2), "solver": "multifrontal",
    }  # fmt: skip
    return ComparisonRecord(passed=passed, quantities=quantities or {}, **values | changes)


def make_summary(**changes) -> SummaryRow:
    """Return the row of a design of which nothing is known but its columns."""
    values = {
        "design": "a", "tags": "one", "pattern": "miura", "surface": "paraboloid", "span_m": 28.0,
        "height_m": 10.0, "zigzag": 15, "strip": 16, "support": "all", "fold_mode": "paper",
        "state": "converged", "mesh_subdivisions": 4, "settings_hash": "0" * 12,
    }  # fmt: skip
    return SummaryRow(**values | changes)
