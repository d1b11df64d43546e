"""One row a design from its result files; every design has a row, whatever became of it."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from foldshell.files.edits import DIGITS
from foldshell.files.whole import hash_data, read_json
from foldshell.results.history import find_least_factor

SUMMARY_KEYS = (
    "design",
    "tags",
    "pattern",
    "surface",
    "span_m",
    "height_m",
    "zigzag",
    "strip",
    "support",
    "fold_mode",
    "state",
    "iterations",
    "volume_m3",
    "volume_per_area_m",
    "utilization_max",
    "utilization_p99",
    "utilization_mean",
    "displacement_vertical_max_m",
    "buckling_factor_min",
    "mesh_subdivisions",
    "mesh_error",
    "crosscheck",
    "settings_hash",
    "reason",
    "buckling_mesh_error",
    "edge_beam_depth_m",
    "edge_beam_thickness_m",
    "edge_beam_volume_m3",
    "edge_beam_utilization_max",
    "edge_strain_max",
    "planarity_max",
)
_EDGE_BEAM_SIZES = ("edge_beam_depth_m", "edge_beam_thickness_m")
_ITERATIONS_MAX = 100
_COPIED = ("volume_m3", "utilization_max", "utilization_p99", "utilization_mean")
_OF_FOLDING = ("edge_strain_max", "planarity_max")
"""What elastic folding costs, beside the verdict: how much it stretched and warped panels."""
_COPIED += ("edge_beam_volume_m3", "edge_beam_utilization_max")


def hash_study(rows: Iterable[Mapping[str, Any]]) -> str:
    """Return 12 hexadecimal digits of the SHA-256 of the hashes of all designs of a summary."""
    return hash_data({row["design"]: row.get("settings_hash") or "" for row in rows})[:DIGITS]


def make_summary_row(design: Mapping[str, Any], folder: str | Path) -> dict[str, Any]:
    """Return the row of one design from the files under `folder` (results/<design>).

    `design` holds the columns of designs.tsv. The state is the verdict of
    the last analysis (converged, not_converged, at_minimum_thickness, unstable), or that of the
    folding where it went wrong (not_reached, crumpled), or `failed` where files are missing or
    damaged; `reason` says why. Seconds and dates never enter.
    """
    folder = Path(folder)
    problems: list[str] = []
    quality = _read(folder / "folded/quality.json", folder, problems)
    analyses = _read_analyses(folder, problems)
    last = analyses[-1] if analyses else {}
    row: dict[str, Any] = {key: design.get(key) for key in SUMMARY_KEYS}
    row |= {key: design.get(key) or None for key in _EDGE_BEAM_SIZES}
    row |= {key: last.get(key) for key in _COPIED}
    row["displacement_vertical_max_m"] = last.get("displacement_vertical_max_m")
    row["iterations"] = len(analyses) or None
    row["volume_per_area_m"] = _divide(last.get("volume_m3"), last.get("area_m2"))
    row["buckling_factor_min"] = find_least_factor(last)
    row |= {key: quality.get(key) for key in _OF_FOLDING}
    row["state"], row["reason"] = _judge(quality, last, problems)
    study = _read_optional(folder / "mesh_convergence.json")
    row |= {key: study.get(key) for key in ("mesh_error", "buckling_mesh_error")}
    row["crosscheck"] = _say_crosscheck(_read_optional(folder / "crosscheck/comparison.json"))
    row |= {key: last.get(key) for key in ("mesh_subdivisions", "settings_hash")}
    return row


def _say_crosscheck(comparison: Mapping[str, Any]) -> str | None:
    """Return pass or fail, `not possible` for a mechanism, None before the comparison."""
    passed = comparison.get("pass")
    if passed is not None:
        return "pass" if passed else "fail"
    return "not possible" if "reason" in comparison else None


def _read(path: Path, folder: Path, problems: list[str]) -> dict[str, Any]:
    """Read a JSON file that is due; note what is wrong with it and go on."""
    name = path.relative_to(folder)
    try:
        data = read_json(path)
    except FileNotFoundError:
        problems.append(f"{name} is missing")
        return {}
    except (OSError, ValueError):
        problems.append(f"{name} is damaged")
        return {}
    if not isinstance(data, dict):
        problems.append(f"{name} is damaged")
        return {}
    return data


def _read_optional(path: Path) -> dict[str, Any]:
    try:
        data = read_json(path)
    except (OSError, ValueError):
        return {}
    return data if isinstance(data, dict) else {}


def _read_analyses(folder: Path, problems: list[str]) -> list[dict[str, Any]]:
    """Follow the iterations 00, 01, ... until a verdict ends them, so that leftovers stay out."""
    analyses: list[dict[str, Any]] = []
    for number in range(_ITERATIONS_MAX):
        analysis = _read(folder / f"sizing/{number:02d}/analysis.json", folder, problems)
        if not analysis:
            break
        analyses.append(analysis)
        if analysis.get("verdict") != "continue":
            break
    return analyses


def _judge(
    quality: Mapping[str, Any], last: Mapping[str, Any], problems: list[str]
) -> tuple[str, str | None]:
    """Return state and reason: folding first, then missing files, then the sizing's verdict."""
    folding = quality.get("state")
    if folding not in (None, "ok"):
        return str(folding), str(quality.get("reason") or "folding failed")
    if problems:
        return "failed", "; ".join(problems)
    return str(last.get("verdict")), last.get("reason") or None


def _divide(value: float | None, by: float | None) -> float | None:
    return value / by if value is not None and by else None
