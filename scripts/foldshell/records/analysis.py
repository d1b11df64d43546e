"""analysis.json and final.json: one analysis of the sizing loop, and the verdict on it."""

from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, Self

from foldshell.records.entry import COUNT, Entry, elapsed, entries, entry, same
from foldshell.records.files import read_record, write_record

Verdict = Literal["continue", "converged", "not_converged", "at_minimum_thickness", "unstable"]
State = Literal["ok", "not_converged", "unstable", "mechanism"]


@dataclass(frozen=True, kw_only=True)
class Criterion:
    """One criterion of the stop rule."""

    value: float | None = entry("what was found; null before there is anything to compare")
    limit: float = entry("what it is held against")
    met: bool = entry("whether it holds")


@dataclass(frozen=True, kw_only=True)
class Criteria:
    """The criteria of the stop rule; those that are not asked for are left out.

    The upper limit of utilization is named after the measure that it holds for.
    """

    utilization_panel_mean: Criterion | None = entry(
        "largest mean utilization of a panel, at most its limit", "-",
        "utilization, largest panel mean", left_out=True,
    )  # fmt: skip
    utilization_element_max: Criterion | None = entry(
        "largest utilization of a result cell, at most its limit", "-",
        "utilization, largest of all points", left_out=True,
    )  # fmt: skip
    utilization_strip: Criterion | None = entry(
        "largest utilization of the mean forces of a facet or a strip, at most its limit", "-",
        "utilization, largest strip mean", left_out=True,
    )  # fmt: skip
    utilization_reinforced: Criterion | None = entry(
        "largest share of what steel and concrete of a panel allow, at most its limit", "-",
        "reinforced concrete, largest share of what is allowed", left_out=True,
    )  # fmt: skip
    utilization_min: Criterion | None = entry(
        "the same largest value, at least its lower limit: the shell is used", "-",
        "the same, at least", left_out=True,
    )  # fmt: skip
    displacement_vertical_m: Criterion | None = entry(
        "largest downward displacement, below its limit", "m",
        "vertical displacement, down", left_out=True,
    )  # fmt: skip
    volume_change_m3: Criterion | None = entry(
        "change of volume from the analysis before, below its limit", "m3", left_out=True
    )
    volume_change_relative: Criterion | None = entry(
        "the same over the volume before, below its limit", "-", left_out=True
    )
    edge_beam_utilization: Criterion | None = entry(
        "largest utilization of the edge beam by the same measure, at most its limit",
        "-", left_out=True,
    )  # fmt: skip
    buckling_factor: Criterion | None = entry(
        "least buckling factor of all combinations, at least its limit; null where nothing is "
        "compressed, or where it was not asked for", "-", left_out=True,
    )  # fmt: skip

    def items(self) -> list[tuple[Entry, Criterion]]:
        """Return those that are asked for, each with what is said of it."""
        pairs = [(about, getattr(self, about.attribute)) for about in entries(Criteria).values()]
        return [(about, item) for about, item in pairs if item is not None]

    def select(self, names: Collection[str]) -> Self:
        """Return the named ones alone."""
        return type(self)(**{about.key: item for about, item in self.items() if about.key in names})

    @property
    def open_names(self) -> list[str]:
        """Names of those that are not met."""
        return [about.key for about, item in self.items() if not item.met]


DECIDES = {
    "panel_mean": "utilization_panel_mean_max",
    "element_max": "utilization_max",
    "strip": "utilization_strip_max",
    "reinforced": "utilization_reinforced_max",
}
"""What the loop holds against the limit of utilization, by its measure."""
NO_LIMIT = "no limit, for information"


@dataclass(frozen=True, kw_only=True)
class ShellState:
    """What an analysis finds of a shell; what it gave no answer to is left out."""

    iteration: int = entry("number of the analysis in its loop, from 0", COUNT)
    state: State = entry(
        "ok, not_converged (second order did not settle), unstable (buckles below its loads) or "
        "mechanism"
    )
    volume_m3: float = entry("volume of material, edge beam included", "m3")
    area_m2: float = entry("area of the sized panels", "m2", "area of the sheet")
    buckling_factor: dict[str, float | None] = entry(
        "factor of each combination at which the shell buckles, elastic and perfect; null for "
        "none; where the loop goes on, those far above the least one are rough",
        "-", "buckling factors",
    )  # fmt: skip
    second_order_iterations: int = entry("iterations of second order (Th.II)", COUNT)
    second_order_residual: float | None = entry(
        "largest relative residual of second order; null where it was not asked for", "-"
    )
    dofs: int = entry("unknowns of the shell model", COUNT, "unknowns")
    mesh_subdivisions: int = entry(
        "result cells along the edge of a facet", COUNT, "cells along a facet edge"
    )
    element_order: int = entry("polynomial order of the displacement in an element", COUNT)
    utilization_max: float | None = entry(
        "largest utilization of a result cell; no limit, for information",
        "-", "utilization, largest of all points", left_out=True,
    )  # fmt: skip
    utilization_p99: float | None = entry(
        "utilization that 99 % of the area does not exceed; no limit, for information",
        "-", "utilization, 99 % of the area", left_out=True,
    )  # fmt: skip
    utilization_mean: float | None = entry(
        "mean utilization over the area; no limit, for information",
        "-", "utilization, mean", left_out=True,
    )  # fmt: skip
    utilization_panel_mean_max: float | None = entry(
        "largest mean utilization of a panel: what the paper's measure holds against its limit",
        "-", "utilization, largest panel mean", left_out=True,
    )  # fmt: skip
    utilization_strip_max: float | None = entry(
        "largest utilization of the mean forces of a facet or of a strip beside a fold or border, "
        "where the loop sizes by it",
        "-", "utilization, largest strip mean", left_out=True,
    )  # fmt: skip
    utilization_reinforced_max: float | None = entry(
        "largest share of what steel and concrete allow (strut, ratio of steel, shear, fit), where "
        "the loop sizes by it",
        "-", "reinforced concrete, largest share", left_out=True,
    )  # fmt: skip
    governing_combination: str | None = entry(
        "strength combination under which the most utilized panel, by the measure of the loop, is "
        "used most",
        words="governing combination", left_out=True,
    )  # fmt: skip
    displacement_vertical_max_m: float | None = entry(
        "largest downward displacement over the deflection combinations",
        "m", "vertical displacement, down", shown="mm", left_out=True,
    )  # fmt: skip
    displacement_combination: str | None = entry(
        "combination of the largest downward displacement", left_out=True
    )
    displacement_place_m: tuple[float, float, float] | None = entry(
        "where it is: x, y, z", "m", left_out=True
    )
    reaction_sum_kn: dict[str, tuple[float, float, float]] | None = entry(
        "sum of the reactions of each combination: x, y, z", "kN", left_out=True
    )
    reaction_imbalance: float | None = entry(
        "largest difference of reactions from loads, relative",
        "-", "reactions against loads", form="scientific", left_out=True,
    )  # fmt: skip
    panels_at_bound: int | None = entry(
        "panels at the least or largest thickness",
        COUNT, "panels at the least or largest thickness", left_out=True,
    )  # fmt: skip
    panels_above_one: int | None = entry(
        "panels whose utilization, by the measure of the loop, is above its limit",
        COUNT, "panels above 1", left_out=True,
    )  # fmt: skip
    edge_beam_volume_m3: float | None = entry("volume of the edge beam", "m3", left_out=True)
    edge_beam_utilization_max: float | None = entry(
        "largest utilization of a result cell of the edge beam", "-", left_out=True
    )
    edge_beam_utilization_panel_mean_max: float | None = entry(
        "largest mean utilization of a panel of the edge beam", "-", left_out=True
    )
    edge_beam_utilization_strip_max: float | None = entry(
        "largest utilization of a strip of the edge beam", "-", left_out=True
    )

    @property
    def least_factor(self) -> float | None:
        """Least buckling factor of all combinations, None where none was found."""
        known = [factor for factor in self.buckling_factor.values() if factor is not None]
        return min(known, default=None)

    @property
    def least_factor_combination(self) -> str | None:
        """Combination of the least buckling factor, the first of equals; None without one."""
        known = {name: f for name, f in self.buckling_factor.items() if f is not None}
        return min(known, key=known.get, default=None)


@dataclass(frozen=True, kw_only=True)
class LastIteration:
    """Where a loop ended that hands on an earlier state."""

    iteration: int = same(ShellState, "iteration")
    verdict: Verdict = entry("how the loop ended")
    reason: str = entry("why, in words")
    volume_m3: float = same(ShellState, "volume_m3")
    criteria: Criteria = entry("its criteria")


@dataclass(frozen=True, kw_only=True)
class AnalysisRecord(ShellState):
    """The contents of analysis.json; final.json is that of the iteration that is delivered: the
    last one, or the lightest that met every limit where the loop did not converge."""

    verdict: Verdict = entry("continue, or how the loop ended")
    reason: str = entry("why, in words")
    criteria: Criteria = entry("each criterion of the stop rule; none where there are no numbers")
    stationary_iterations: int = entry("iterations in a row with a small change of volume", COUNT)
    seconds: float | None = elapsed()
    edited: bool = entry("whether a person had changed the workbook that was read", default=False)
    edited_panels: tuple[int, ...] | None = entry(
        "panels whose thickness that person had changed", left_out=True
    )
    buckling_factor_bound: float | None = entry(
        "what no buckling factor is below: the least one that a search with random vectors found, "
        "less the cube of the thinning since; null for none", "-", left_out=True,
    )  # fmt: skip
    counted_from: int = entry(
        "iteration from which iterations_max counts: 0, or that of the last edit", COUNT, default=0
    )
    settings_hash: str | None = entry(
        "hash of all that decides the design up to here: settings, surface, edits", left_out=True
    )
    workbook_sha256: str | None = entry("SHA-256 of the workbook that was read", left_out=True)
    model_warnings: tuple[str, ...] | None = entry(
        "what theory or mesh does not hold, a sentence each; stands in the last analysis of a loop",
        words="model warnings", left_out=True,
    )  # fmt: skip
    delivered_iteration: int | None = entry(
        "iteration whose state this is; stands in final.json",
        COUNT, "delivered iteration", left_out=True,
    )  # fmt: skip
    last: LastIteration | None = entry(
        "the last iteration, where an earlier one is delivered; stands in final.json", left_out=True
    )

    def describe_limit(self, key: str) -> str:
        """Return the limit that a utilization is held against, or that it is for information;
        nothing for other keys."""
        if not key.startswith("utilization"):
            return ""
        held = next((name for name, decides in DECIDES.items() if decides == key), "")
        item = getattr(self.criteria, f"utilization_{held}", None)
        return NO_LIMIT if item is None else f"limit {item.limit:g}"

    @property
    def warning(self) -> str | None:
        """What theory or mesh does not hold, as one line; None for nothing."""
        return "; ".join(self.model_warnings or ()) or None

    @property
    def goes_on(self) -> bool:
        """Whether the loop asks for another iteration."""
        return self.verdict == "continue"


def read_analysis(path: str | Path) -> AnalysisRecord:
    """Read analysis.json or final.json; raises `InputError` for a damaged file."""
    return read_record(path, AnalysisRecord)


def write_analysis(path: str | Path, record: AnalysisRecord) -> None:
    """Write analysis.json or final.json."""
    write_record(path, record)
