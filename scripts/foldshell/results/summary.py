"""One row a design from its result files; every design has a row, whatever became of it."""

from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path
from typing import Any, TypeVar

from foldshell.files.errors import InputError
from foldshell.files.whole import DIGITS, hash_data
from foldshell.records.analysis import AnalysisRecord
from foldshell.records.comparison import ComparisonRecord, read_comparison
from foldshell.records.design_row import make_design_row
from foldshell.records.engineering import EngineeringRecord
from foldshell.records.files import read_record
from foldshell.records.mesh_convergence import MeshConvergenceRecord
from foldshell.records.quality import QualityRecord
from foldshell.records.reinforcement import ReinforcementRecord
from foldshell.records.summary import SummaryRow
from foldshell.results.history import collect_edited_panels
from foldshell.settings.design import Row
from foldshell.sizing.delivery import choose_delivered, describe_delivered

Record = TypeVar("Record")
_ITERATIONS_MAX = 100
_COPIED = (
    "volume_m3",
    "utilization_max",
    "utilization_p99",
    "utilization_mean",
    "utilization_panel_mean_max",
    "governing_combination",
    "displacement_vertical_max_m",
    "edge_beam_volume_m3",
    "edge_beam_utilization_max",
    "mesh_subdivisions",
    "settings_hash",
)
_OF_FOLDING = ("edge_strain_max", "planarity_max")
"""What elastic folding costs, beside the verdict: how much it stretched and warped panels."""


def hash_study(rows: Iterable[SummaryRow]) -> str:
    """Return 12 hexadecimal digits of the SHA-256 of the hashes of all designs of a summary."""
    return hash_data({row.design: row.settings_hash or "" for row in rows})[:DIGITS]


def make_summary_row(design: Row, folder: str | Path) -> SummaryRow:
    """Return the row of one design from the files under `folder` (results/<design>).

    `design` holds its columns of designs.tsv. `state` is the verdict of the sizing, that of the
    folding where it went wrong (not_reached, crumpled), or `failed` where files are missing or
    damaged; `reason` says why. Seconds and dates never enter.
    """
    folder = Path(folder)
    problems: list[str] = []
    quality = _read(folder / "folded/quality.json", QualityRecord, folder, problems)
    analyses = _read_analyses(folder, problems)
    final = _read_optional(folder / "sizing/final.json", AnalysisRecord)
    delivered = _choose_state(analyses, final)
    state, reason = _judge(quality, delivered, problems)
    study = _read_optional(folder / "mesh_convergence.json", MeshConvergenceRecord)
    return SummaryRow(
        **asdict(make_design_row(design)),
        state=state,
        reason=reason,
        **_describe_state(delivered),
        iterations=len(analyses) or None,
        edited_panels=len(collect_edited_panels(analyses)) or None,
        mesh_error=study and study.mesh_error,
        buckling_mesh_error=study and study.buckling_mesh_error,
        **{key: quality and getattr(quality, key) for key in _OF_FOLDING},
        **_describe_engineering(folder / "checks/engineering.json", delivered),
        crosscheck=_find_outcome(folder / "crosscheck/comparison.json"),
    )


def _choose_state(
    analyses: list[AnalysisRecord], final: AnalysisRecord | None
) -> AnalysisRecord | None:
    """Return the state that is delivered, by final.json where that is of these iterations."""
    if not analyses:
        return None
    state = analyses[choose_delivered(analyses)]
    same = final is not None and final.delivered_iteration == state.iteration
    read_same = same and final.workbook_sha256 == state.workbook_sha256
    return final if read_same else describe_delivered(analyses, state)


def _describe_state(state: AnalysisRecord | None) -> dict[str, float | str | None]:
    """Return the columns that are those of the delivered analysis, or made of them."""
    if state is None:
        return {}
    return {
        **{key: getattr(state, key) for key in _COPIED},
        "volume_per_area_m": state.volume_m3 / state.area_m2 if state.area_m2 else None,
        "buckling_factor_min": state.least_factor,
        "model_warnings": state.warning,
    }


def _describe_engineering(path: Path, last: AnalysisRecord | None) -> dict[str, Any]:
    """Return the columns of the engineering verdict, none where there is none."""
    record = _read_optional(path, EngineeringRecord)
    if record is None or last is None:
        return {}
    sway, rankine = record.checks.get("displacement_horizontal"), record.measures.get("rankine")
    own = record.measures.get(record.loop_criterion)
    return {
        "engineering": record.verdict,
        "engineering_reason": record.reason,
        "displacement_horizontal_max_m": sway and sway.value,
        **(_describe_steel(record.reinforcement, last.area_m2) if record.reinforcement else {}),
        "utilization_strip_max": own and own.utilization_strip_max,
        "rankine_panel_mean_max": rankine and rankine.utilization_panel_mean_max,
        "rankine_strip_max": rankine and rankine.utilization_strip_max,
    }


def _describe_steel(steel: ReinforcementRecord, area: float) -> dict[str, float | str | None]:
    """Return the columns of reinforcement, what it emits and what it costs, by area m2."""
    most = max(steel.governing_share, key=steel.governing_share.get)
    return {
        "reinforcement": steel.kind,
        "steel_kg_m2": steel.steel_kg_m2,
        "steel_kg_m3": steel.steel_kg_m3,
        "steel_governing": f"{most} in {100 * steel.governing_share[most]:.0f} % of the panels",
        "steel_over_share": max(steel.over_one_share.values()),
        "co2_kg_m2": steel.co2_kg / area,
        "co2_low_kg_m2": steel.co2_low_kg / area,
        "co2_high_kg_m2": steel.co2_high_kg / area,
        "cost_m2": steel.cost and steel.cost / area,
    }


def _find_outcome(path: Path) -> str | None:
    """Return pass or fail, `not possible` for a mechanism, None before the comparison."""
    try:
        comparison: ComparisonRecord = read_comparison(path)
    except InputError:
        return None
    return comparison.outcome


def _read(path: Path, kind: type[Record], folder: Path, problems: list[str]) -> Record | None:
    """Read a record that is due; note what is wrong with it and go on."""
    name = path.relative_to(folder)
    try:
        return read_record(path, kind)
    except InputError:
        problems.append(f"{name} is {'damaged' if path.exists() else 'missing'}")
    return None


def _read_optional(path: Path, kind: type[Record]) -> Record | None:
    try:
        return read_record(path, kind)
    except InputError:
        return None


def _read_analyses(folder: Path, problems: list[str]) -> list[AnalysisRecord]:
    """Follow the iterations 00, 01, ... until a verdict ends them, so that leftovers stay out."""
    analyses: list[AnalysisRecord] = []
    for number in range(_ITERATIONS_MAX):
        path = folder / f"sizing/{number:02d}/analysis.json"
        analysis = _read(path, AnalysisRecord, folder, problems)
        if analysis is None:
            break
        analyses.append(analysis)
        if not analysis.goes_on:
            break
    return analyses


def _judge(
    quality: QualityRecord | None, state: AnalysisRecord | None, problems: list[str]
) -> tuple[str, str | None]:
    """Return state and reason: folding first, then missing files, then the sizing's verdict."""
    if quality and quality.state != "ok":
        return quality.state, quality.reason or "folding failed"
    if problems:
        return "failed", "; ".join(problems)
    return state.verdict, state.reason or None
