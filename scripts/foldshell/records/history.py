"""history.csv: one row per iteration of a sizing loop."""

from dataclasses import dataclass

from foldshell.records.analysis import AnalysisRecord, ShellState, Verdict
from foldshell.records.entry import COUNT, entry, same


@dataclass(frozen=True, kw_only=True)
class HistoryRow:
    """One iteration; the columns of the edge beam stand where some iteration has one."""

    iteration: int = same(ShellState, "iteration")
    verdict: Verdict = same(AnalysisRecord, "verdict")
    edited: str | None = entry(
        "`edited` where a person had changed the workbook that was read", default=None
    )
    edited_panels: int | None = entry(
        "panels whose thickness that person had changed", COUNT, default=None
    )
    volume_m3: float = same(ShellState, "volume_m3")
    volume_change_m3: float | None = entry(
        "volume less that of the iteration before", "m3", default=None
    )
    utilization_max: float | None = same(ShellState, "utilization_max", left_out=False)
    utilization_p99: float | None = same(ShellState, "utilization_p99", left_out=False)
    utilization_panel_mean_max: float | None = same(
        ShellState, "utilization_panel_mean_max", left_out=False
    )
    utilization_strip_max: float | None = same(ShellState, "utilization_strip_max")
    utilization_reinforced_max: float | None = same(ShellState, "utilization_reinforced_max")
    panels_above_one: int | None = same(ShellState, "panels_above_one", left_out=False)
    panels_at_bound: int | None = same(ShellState, "panels_at_bound", left_out=False)
    displacement_vertical_max_m: float | None = same(
        ShellState, "displacement_vertical_max_m", left_out=False
    )
    displacement_limit_m: float | None = entry("largest displacement allowed", "m", default=None)
    buckling_factor_min: float | None = entry(
        "least buckling factor of all combinations", "-", "buckling factor", default=None
    )
    thickness_min_m: float | None = entry("least thickness of a panel", "m", default=None)
    thickness_mean_m: float | None = entry("mean thickness of the panels", "m", default=None)
    thickness_max_m: float | None = entry("largest thickness of a panel", "m", default=None)
    second_order_iterations: int = same(ShellState, "second_order_iterations")
    reaction_imbalance: float | None = same(ShellState, "reaction_imbalance", left_out=False)
    reason: str = same(AnalysisRecord, "reason")
    edge_beam_utilization_max: float | None = same(ShellState, "edge_beam_utilization_max")
    edge_beam_utilization_panel_mean_max: float | None = same(
        ShellState, "edge_beam_utilization_panel_mean_max"
    )
