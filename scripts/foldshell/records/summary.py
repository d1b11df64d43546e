"""summary.csv: one row per design of a study."""

from dataclasses import dataclass

from foldshell.records.analysis import ShellState
from foldshell.records.design_row import DesignRow
from foldshell.records.entry import COUNT, entry, same
from foldshell.records.mesh_convergence import MeshConvergenceRecord
from foldshell.records.quality import QualityMeasures


def _design(name: str):
    return same(DesignRow, name)


def _state(name: str):
    return same(ShellState, name, left_out=False, empty=True)


def _quality(name: str):
    return same(QualityMeasures, name, empty=True)


@dataclass(frozen=True, kw_only=True)
class SummaryRow:
    """One design; a cell is empty where the design has no such number."""

    design: str = _design("design")
    tags: str = _design("tags")
    pattern: str = _design("pattern")
    surface: str = _design("surface")
    span_m: float = _design("span_m")
    height_m: float = _design("height_m")
    zigzag: int = _design("zigzag")
    strip: int = _design("strip")
    support: str = _design("support")
    fold_mode: str = _design("fold_mode")
    state: str = entry(
        "verdict of the sizing loop, that of folding where it went wrong (not_reached, crumpled), "
        "failed where files are missing or damaged",
        words="verdict",
    )
    iterations: int | None = entry("analyses of the loop", COUNT, default=None)
    volume_m3: float | None = _state("volume_m3")
    volume_per_area_m: float | None = entry(
        "volume over the area of the sheet", "m3/m2", "volume / area", shown="mm", default=None
    )
    utilization_max: float | None = _state("utilization_max")
    utilization_p99: float | None = _state("utilization_p99")
    utilization_mean: float | None = _state("utilization_mean")
    displacement_vertical_max_m: float | None = _state("displacement_vertical_max_m")
    buckling_factor_min: float | None = entry(
        "least buckling factor of all combinations", "-", "buckling factor", default=None
    )
    mesh_subdivisions: int | None = _state("mesh_subdivisions")
    mesh_error: float | None = same(MeshConvergenceRecord, "mesh_error", empty=True)
    crosscheck: str | None = entry(
        "pass, fail, or not possible for a mechanism", words="cross-check", default=None
    )
    settings_hash: str | None = entry(
        "hash of all that decides the final state of the design", default=None
    )
    reason: str | None = entry("why the state is so", default=None)
    buckling_mesh_error: float | None = same(
        MeshConvergenceRecord, "buckling_mesh_error", empty=True
    )
    edge_beam_depth_m: float | None = _design("edge_beam_depth_m")
    edge_beam_thickness_m: float | None = _design("edge_beam_thickness_m")
    edge_beam_volume_m3: float | None = _state("edge_beam_volume_m3")
    edge_beam_utilization_max: float | None = _state("edge_beam_utilization_max")
    edge_strain_max: float | None = _quality("edge_strain_max")
    planarity_max: float | None = _quality("planarity_max")
    utilization_panel_mean_max: float | None = _state("utilization_panel_mean_max")
    governing_combination: str | None = _state("governing_combination")
    model_warnings: str | None = entry(
        "what theory or mesh does not hold of the final state; empty for nothing",
        words="model warnings", default=None,
    )  # fmt: skip
    edited_panels: int | None = entry(
        "panels whose thickness a person changed in some iteration; empty for none",
        COUNT, "panels changed by a person", default=None,
    )  # fmt: skip
    sector_angle_deg: float | None = _design("sector_angle_deg")
    rest_fold_angle_deg: float | None = _design("rest_fold_angle_deg")
    strip_grading: float | None = _design("strip_grading")
    span_x_m: float | None = _design("span_x_m")
    span_y_m: float | None = _design("span_y_m")
    outline: str | None = _design("outline")
    openings: str | None = _design("openings")
    opening_angle_deg: float | None = _design("opening_angle_deg")
    take_up: float | None = _design("take_up")
    folded: str | None = _design("folded")
    file_unit: str | None = _design("file_unit")
    utilization_strip_max: float | None = entry(
        "largest utilization of a facet or strip as a mean, by criterion and combinations of the "
        "loop", "-", "utilization, largest strip mean", default=None,
    )  # fmt: skip
    rankine_panel_mean_max: float | None = entry(
        "the same as utilization_panel_mean_max by the criterion of Rankine: tension counts",
        "-", "Rankine, largest panel mean", default=None,
    )  # fmt: skip
    rankine_strip_max: float | None = entry(
        "the same as utilization_strip_max by the criterion of Rankine",
        "-", "Rankine, largest strip", default=None,
    )  # fmt: skip
    displacement_horizontal_max_m: float | None = entry(
        "largest horizontal displacement under the characteristic combinations of the engineering "
        "verdict", "m", "horizontal displacement", shown="mm", default=None,
    )  # fmt: skip
    engineering: str | None = entry(
        "engineering verdict: passes, fails or not_applicable", default=None
    )
    engineering_reason: str | None = entry("why it is so", default=None)
    steel_kg_m2: float | None = entry(
        "reinforcement by area of the sheet; empty without a design of it", "kg/m2",
        "reinforcement", default=None,
    )  # fmt: skip
    loads: str | None = _design("loads")
    settings: str | None = _design("settings")
    reinforcement: str | None = entry(
        "kind of reinforcement: bars, central_mesh or textile; empty without a design of it",
        words="kind of reinforcement", default=None,
    )  # fmt: skip
    steel_kg_m3: float | None = entry(
        "reinforcement by volume of concrete", "kg/m3", "reinforcement by volume", default=None
    )
    steel_governing: str | None = entry(
        "check of reinforcement that is used most in most panels, with their share",
        words="governs reinforcement", default=None,
    )  # fmt: skip
    steel_over_share: float | None = entry(
        "share of the panels that pass a check of reinforcement, of the check with most", "-",
        "panels over a check of reinforcement", default=None,
    )  # fmt: skip
    co2_kg_m2: float | None = entry(
        "greenhouse gases of making concrete, reinforcement and folds, by area of the sheet",
        "kg/m2", "CO2e", default=None,
    )  # fmt: skip
    co2_low_kg_m2: float | None = entry(
        "the same at the lower end of the factors", "kg/m2", "CO2e, lower end", default=None
    )
    co2_high_kg_m2: float | None = entry(
        "the same at the upper end of the factors", "kg/m2", "CO2e, upper end", default=None
    )
    cost_m2: float | None = entry(
        "cost by area of the sheet, in the currency of the prices; empty without prices", "1/m2",
        "cost", default=None,
    )  # fmt: skip
