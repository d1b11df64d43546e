"""What claims compare of one analysed state, and the files that hold it."""

from dataclasses import dataclass

from foldshell.files.whole import Json
from foldshell.records.analysis import AnalysisRecord, ShellState, Verdict
from foldshell.records.entry import COUNT, entry, same
from foldshell.records.quality import QualityMeasures


def _state(name: str):
    return same(ShellState, name, left_out=False)


def _geometry(name: str):
    return same(QualityMeasures, name, left_out=True)


@dataclass(frozen=True, kw_only=True)
class Geometry:
    """What the folding alone says of a design; what nobody asked for is None."""

    depth: float | None = entry(
        "mean distance of ridges from the middle of the zig-zags beside them", "m", left_out=True
    )
    edge_strain_rms: float | None = _geometry("edge_strain_rms")
    flat_foldability_max_rad: float | None = entry(
        "largest defect of Kawasaki's sum at a vertex", "rad", left_out=True
    )


@dataclass(frozen=True, kw_only=True)
class Measures(Geometry):
    """Numbers of an analysed state; None where the analysis gave no answer."""

    state: Verdict = same(AnalysisRecord, "verdict")
    reason: str = same(AnalysisRecord, "reason")
    iterations: int = entry("analyses of the loop", COUNT)
    volume: float = same(ShellState, "volume_m3", key="volume", words="volume")
    volume_per_area: float = entry("volume over the area of the sheet", "m", shown="mm")
    volume_change: float | None = entry("relative change of volume of the last iteration", "-")
    displacement: float | None = entry("largest downward displacement", "m", shown="mm")
    buckling_factor: float | None = entry("least factor of the strength combinations", "-")
    utilization_mean: float | None = _state("utilization_mean")
    utilization_max: float | None = _state("utilization_max")
    utilization_panel_mean_max: float | None = _state("utilization_panel_mean_max")
    panels_above_one: int | None = _state("panels_above_one")
    panels_at_bound: int | None = _state("panels_at_bound")
    panel_area: float = entry("mean area of a panel", "m2")
    utilization_variation: float | None = entry(
        "standard deviation of the panels' mean utilization over its mean, by area", "-"
    )
    above_one: int | None = entry("panels above 1 by the measure of the loop", COUNT)
    above_one_at_free_edge: int | None = entry("those of them along a free edge", COUNT)
    displacement_edge: float | None = entry("the same on panels along free edges", "m", shown="mm")
    displacement_inner: float | None = entry("the same on all other panels", "m", shown="mm")
    utilization_strip_max: float | None = entry(
        "largest utilization of a facet or strip as a mean, where the loop sizes by it", "-",
        left_out=True,
    )  # fmt: skip
    utilization_strip_mean: float | None = entry(
        "area mean over the panels of the largest of their strips, likewise", "-", left_out=True
    )
    utilization_strip_variation: float | None = entry(
        "its standard deviation over its mean, by area, likewise", "-", left_out=True
    )
    utilization_reinforced_max: float | None = entry(
        "largest share of what steel and concrete allow, where the loop sizes by it", "-",
        left_out=True,
    )  # fmt: skip
    utilization_reinforced_mean: float | None = entry(
        "area mean over the panels of their largest share, likewise", "-", left_out=True
    )
    utilization_reinforced_variation: float | None = entry(
        "its standard deviation over its mean, by area, likewise", "-", left_out=True
    )
    steel_kg_m2: float | None = entry(
        "reinforcement by area of the sheet, likewise", "kg/m2", left_out=True
    )
    strength_factor: float | None = entry(
        "load factor at which the mean of a panel reaches the strength", "-", left_out=True
    )


@dataclass(frozen=True, kw_only=True)
class VariantRecord:
    """The contents of sensitivity/<variant>/<design>.json: a loop under another setting."""

    design: str = entry("name of the design")
    variant: str = entry("name of the variant")
    changes: dict[str, Json] = entry("settings that it changes, by group")
    measures: Measures = entry("its last state")


@dataclass(frozen=True, kw_only=True)
class FlatSheet:
    """A flat sheet with the volume of material of a folded one."""

    flat: str = entry("name of the flat design")
    state: str = entry("state of its analysis")
    thickness_m: float = entry("its one thickness", "m")
    volume_m3: float = entry("its volume, that of the folded design", "m3")
    area_m2: float = entry("its area", "m2")
    sides_m: tuple[float, float] = entry("its sides along x and y", "m")
    displacement_first_order_m: float = entry("largest downward displacement of first order", "m")
    measures: Measures = entry("its analysed state")


@dataclass(frozen=True, kw_only=True)
class FlatEqualRecord(FlatSheet):
    """The contents of flat_equal.json."""

    errors: dict[str, tuple[float | None, float | None]] = entry(
        "relative mesh error and cross-check difference by quantity", "-"
    )


@dataclass(frozen=True, kw_only=True)
class SensitivityRow:
    """One row of sensitivity.csv: a design run under one variant of the settings."""

    design: str = entry("name of the design")
    variant: str = entry("name of the variant")
    volume_over_base: float | None = entry("volume over that of the variant `base`", "-")
    state: Verdict = same(Measures, "state")
    iterations: int = same(Measures, "iterations")
    volume: float = same(Measures, "volume")
    volume_per_area: float = same(Measures, "volume_per_area")
    displacement: float | None = same(Measures, "displacement")
    displacement_edge: float | None = same(Measures, "displacement_edge")
    displacement_inner: float | None = same(Measures, "displacement_inner")
    utilization_mean: float | None = same(Measures, "utilization_mean")
    utilization_variation: float | None = same(Measures, "utilization_variation")
    utilization_panel_mean_max: float | None = same(Measures, "utilization_panel_mean_max")
    utilization_max: float | None = same(Measures, "utilization_max")
    buckling_factor: float | None = same(Measures, "buckling_factor")
    above_one: int | None = same(Measures, "above_one")
    above_one_at_free_edge: int | None = same(Measures, "above_one_at_free_edge")
    panels_at_bound: int | None = same(Measures, "panels_at_bound")
