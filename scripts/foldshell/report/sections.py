"""The tables of a design's page: verdict, criteria, folding, classes, mesh error, cross-check."""

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from foldshell.files.whole import read_json
from foldshell.report.history_chart import Series, draw_history
from foldshell.report.markup import Cell, escape, format_number, make_table
from foldshell.results.design_view import count_analyses
from foldshell.workbook.styles import GOOD_VERDICTS

FOLDING = {
    "rms_over_span": "rms distance to the target / span [-]",
    "max_over_span": "largest distance to the target / span [-]",
    "edge_strain_max": "largest strain of an edge [-]",
    "edge_strain_rms": "rms strain of the edges [-]",
    "angle_defect_max_rad": "largest defect of a vertex's angle sum [rad]",
    "planarity_max": "planarity, largest [-]",
    "planarity_mean": "planarity, mean [-]",
    "neutral_fold_mean_deg": "mean fold across panels [°]",
    "flipped_folds": "flipped folds",
    "self_intersections": "self-intersections",
    "plan_coverage": "share of the plan that is covered [-]",
    "unfold_closure_m": "closure when unfolded [m]",
    "refold_closure_m": "closure when folded again [m]",
}
HEADLINES = {
    "volume_m3": "volume [m³]",
    "area_m2": "area of the sheet [m²]",
    "utilization_panel_mean_max": "utilization, largest panel mean [-]",
    "utilization_p99": "utilization, 99 % of the area [-]",
    "utilization_max": "utilization, largest of all points [-]",
    "utilization_mean": "utilization, mean [-]",
    "displacement_vertical_max_m": "vertical displacement, down [m]",
    "panels_above_one": "panels above 1",
    "panels_at_bound": "panels at the least or largest thickness",
    "reaction_imbalance": "reactions against loads [-]",
    "mesh_subdivisions": "cells along a facet edge",
    "dofs": "unknowns",
}
UNITS = {"m": "m", "m2": "m²", "m3": "m³", "knm": "kNm", "kn": "kN", "rad": "rad", "deg": "°"}


@dataclass(frozen=True)
class DesignFiles:
    """What the files of a design say; `history` are the rows of history.csv."""

    design: Mapping[str, Any]
    final: Mapping[str, Any]
    quality: Mapping[str, Any]
    classes: Mapping[str, Any]
    mesh_convergence: Mapping[str, Any]
    comparison: Mapping[str, Any]
    history: Sequence[Mapping[str, str]]


def read_files(design: Mapping[str, Any], paths: Mapping[str, str | Path]) -> DesignFiles:
    """Read final, quality, classes, mesh_convergence, comparison (JSON) and history (CSV)."""
    names = ("final", "quality", "classes", "mesh_convergence", "comparison")
    with Path(paths["history"]).open(encoding="utf-8", newline="") as stream:
        history = list(csv.DictReader(stream))
    return DesignFiles(design, *(read_json(paths[name]) for name in names), history)


def write_verdict(files: DesignFiles) -> str:
    """Return the box with verdict, count of analyses and reason."""
    verdict = str(files.final.get("verdict"))
    kind = "good" if verdict in GOOD_VERDICTS else "bad"
    reason = files.final.get("reason") or ""
    return (
        f'<div class="verdict {kind}"><b>{escape(verdict.replace("_", " "))}</b> after '
        f"{count_analyses(files.final)}<p>{escape(reason)}</p></div>"
    )


def describe_design(design: Mapping[str, Any]) -> str:
    """Return the row of designs.tsv as one sentence."""
    tags = ", ".join(str(design.get("tags") or "none").split(","))
    return escape(
        f"{design['pattern']} pattern, surface {design['surface']}, span {design['span_m']:g} m, "
        f"height {design['height_m']:g} m, {design['zigzag']} zig-zags × {design['strip']} strips, "
        f"{design['support']} edges supported, folded in mode {design['fold_mode']}; tags {tags}"
    )


def write_criteria(criteria: Mapping[str, Mapping[str, Any]]) -> str:
    """Return the criteria with value, limit and whether they are met."""
    if not criteria:
        return "<p>No criteria: the analysis gave no results.</p>"
    rows = [
        (name_quantity(name), item.get("value"), item.get("limit"), _judge(item.get("met")))
        for name, item in criteria.items()
    ]
    return make_table(("criterion", "value", "limit", "met"), rows)


def name_quantity(key: str, unit: bool = True) -> str:
    """Return the words of a key, its unit in brackets: displacement_m is "displacement [m]"."""
    stem, _, last = key.rpartition("_")
    if stem and last in UNITS:
        return stem.replace("_", " ") + (f" [{UNITS[last]}]" if unit else "")
    return key.replace("_", " ")


def _judge(met: Any) -> Cell:
    return Cell("–") if met is None else Cell("yes", "good") if met else Cell("no", "bad")


def write_pairs(labels: Mapping[str, str], values: Mapping[str, Any]) -> str:
    """Return the labelled values that there are."""
    rows = [(words, values[name]) for name, words in labels.items() if name in values]
    return make_table(("quantity", "value"), rows) if rows else "<p>No results.</p>"


def write_headlines(files: DesignFiles) -> str:
    """Return the numbers of the final state, and the buckling factors."""
    factors = files.final.get("buckling_factor") or {}
    words = ", ".join(f"{name} {format_number(value)}" for name, value in factors.items())
    table = write_pairs(HEADLINES, files.final)
    return table + (f'<p class="soft">Buckling factors: {escape(words)}</p>' if words else "")


def write_folding(quality: Mapping[str, Any]) -> str:
    """Return state, reason and measures of the folded sheet."""
    state = str(quality.get("state", "")).replace("_", " ")
    words = f"<p>{escape(state)}: {escape(quality.get('reason') or 'no reason given')}</p>"
    return words + write_pairs(FOLDING, quality)


def write_classes(classes: Mapping[str, Any]) -> str:
    """Return the thickness classes and the verdict on the grouped design."""
    if not classes.get("classes"):
        return f"<p>No classes: {escape(classes.get('reason') or 'none were asked for')}</p>"
    rows = [
        (item["class"], 1e3 * item["thickness_m"], item["panels"], item["area_m2"])
        for item in classes["classes"]
    ]
    added = classes.get("added_volume_relative")
    share = "" if added is None else f", volume {100 * added:+.1f} %"
    verdict = str(classes.get("verdict")).replace("_", " ")
    words = f"{verdict}{share}: {classes.get('reason') or ''}"
    table = make_table(("class", "thickness [mm]", "panels", "area [m²]"), rows)
    return f"<p>{escape(words)}</p>{table}"


def write_mesh_error(study: Mapping[str, Any]) -> str:
    """Return how far each headline number is from that of a finer mesh."""
    errors = study.get("errors") or {}
    if not errors:
        return f"<p>Not measured: {escape(study.get('reason') or 'no results')}</p>"
    names = list(dict.fromkeys(name for one in errors.values() for name in one))
    header = ["difference to the fine mesh", *(f"{name} [%]" for name in errors)]
    rows = []
    for name in names:
        values = [one.get(name) for one in errors.values()]
        shares = [None if v is None else 100 * v for v in values]
        rows.append((name_quantity(name, unit=False), *shares))
    return make_table(header, rows)


def write_crosscheck(comparison: Mapping[str, Any]) -> str:
    """Return both codes side by side with their tolerance."""
    passed = comparison.get("pass")
    kind = "good" if passed else "bad"
    words = "every quantity is within its tolerance" if passed else "not within tolerance"
    note = comparison.get("note") or comparison.get("reason")
    words = f"{words}: {note}" if note else words
    rows = [
        (
            name_quantity(name),
            item.get("primary"),
            item.get("independent"),
            _percent(item.get("relative_difference")),
            _percent(item.get("tolerance")),
            _judge(item.get("pass")),
        )
        for name, item in (comparison.get("quantities") or {}).items()
    ]
    header = ("quantity", "primary", "independent", "difference [%]", "tolerance [%]", "within")
    box = f'<div class="verdict {kind}">{escape(words)}</div>'
    return box + (make_table(header, rows) if rows else "")


def _percent(value: float | None) -> float | None:
    return None if value is None else 100 * value


def write_history(history: Sequence[Mapping[str, str]], utilization_max: float) -> str:
    """Return the chart of volume, utilization and displacement over the iterations."""

    def column(name: str, factor: float = 1.0) -> list[float | None]:
        """Numbers of a column, None where it is empty."""
        return [factor * float(row[name]) if row.get(name) else None for row in history]

    limits = [value for value in column("displacement_limit_m", 1e3) if value is not None]
    return draw_history([
        Series("volume [m³]", column("volume_m3"), {}),
        Series("utilization, largest panel mean [-]", column("utilization_panel_mean_max"),
               {f"limit {utilization_max:g}": utilization_max}),
        Series("vertical displacement, down [mm]", column("displacement_vertical_max_m", 1e3),
               {"limit": limits[-1]} if limits else {}),
    ])  # fmt: skip
