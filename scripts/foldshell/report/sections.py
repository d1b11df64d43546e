"""The sections of a design's page: verdict, criteria, history, checks, mesh error, folding."""

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from foldshell.files.whole import read_json
from foldshell.report.history_chart import Series, draw_history
from foldshell.report.markup import Cell, Table, format_number, make_table
from foldshell.results.design_view import count_analyses
from foldshell.settings.design import Design
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

    design: Design
    final: Mapping[str, Any]
    quality: Mapping[str, Any]
    classes: Mapping[str, Any]
    mesh_convergence: Mapping[str, Any]
    comparison: Mapping[str, Any]
    history: Sequence[Mapping[str, str]]


@dataclass(frozen=True)
class Box:
    """A framed verdict: good or bad, the word that stands out, the rest, a reason below it."""

    kind: str
    words: str
    head: str = ""
    reason: str | None = None


@dataclass(frozen=True)
class Section:
    """A titled part of a page; what it lacks is left out."""

    title: str
    box: Box | None = None
    words: str = ""
    table: Table | None = None
    chart: str = ""
    note: str = ""


def read_files(design: Design, paths: Mapping[str, str | Path]) -> DesignFiles:
    """Read final, quality, classes, mesh_convergence, comparison (JSON) and history (CSV)."""
    names = ("final", "quality", "classes", "mesh_convergence", "comparison")
    with Path(paths["history"]).open(encoding="utf-8", newline="") as stream:
        history = list(csv.DictReader(stream))
    return DesignFiles(design, *(read_json(paths[name]) for name in names), history)


def make_sections(files: DesignFiles, utilization_max: float) -> list[Section]:
    """Return all sections of a design's page, what matters most first."""
    return [
        make_verdict(files.final),
        make_criteria(files.final.get("criteria") or {}),
        make_history(files.history, utilization_max),
        make_headlines(files.final),
        make_crosscheck(files.comparison),
        make_mesh_error(files.mesh_convergence),
        make_classes(files.classes),
        make_folding(files.quality),
    ]


def describe_design(design: Design) -> str:
    """Return the row of designs.tsv as one sentence."""
    tags = ", ".join(design.tags or ("none",))
    return (
        f"{design.pattern} pattern, surface {design.surface}, span {design.span:g} m, "
        f"height {design.height:g} m, {design.zigzag} zig-zags × {design.strip} strips, "
        f"{design.support} edges supported, folded in mode {design.fold_mode}; tags {tags}"
    )


def make_verdict(final: Mapping[str, Any]) -> Section:
    """Return verdict, count of analyses and reason."""
    verdict = str(final.get("verdict"))
    kind = "good" if verdict in GOOD_VERDICTS else "bad"
    words = f"after {count_analyses(final)}"
    box = Box(kind, words, verdict.replace("_", " "), final.get("reason") or "")
    return Section("Verdict", box)


def make_criteria(criteria: Mapping[str, Mapping[str, Any]]) -> Section:
    """Return the criteria with value, limit and whether they are met."""
    if not criteria:
        return Section("Criteria", words="No criteria: the analysis gave no results.")
    rows = [
        (name_quantity(name), item.get("value"), item.get("limit"), _judge(item.get("met")))
        for name, item in criteria.items()
    ]
    return Section("Criteria", table=make_table(("criterion", "value", "limit", "met"), rows))


def name_quantity(key: str, unit: bool = True) -> str:
    """Return the words of a key, its unit in brackets: displacement_m is "displacement [m]"."""
    stem, _, last = key.rpartition("_")
    if stem and last in UNITS:
        return stem.replace("_", " ") + (f" [{UNITS[last]}]" if unit else "")
    return key.replace("_", " ")


def _judge(met: Any) -> Cell:
    return Cell("–") if met is None else Cell("yes", "good") if met else Cell("no", "bad")


def make_headlines(final: Mapping[str, Any]) -> Section:
    """Return the numbers of the final state, and the buckling factors."""
    factors = final.get("buckling_factor") or {}
    words = ", ".join(f"{name} {format_number(value)}" for name, value in factors.items())
    note = f"Buckling factors: {words}" if words else ""
    return _list_quantities(Section("Final state", note=note), HEADLINES, final)


def make_folding(quality: Mapping[str, Any]) -> Section:
    """Return state, reason and measures of the folded sheet."""
    state = str(quality.get("state", "")).replace("_", " ")
    words = f"{state}: {quality.get('reason') or 'no reason given'}"
    return _list_quantities(Section("Folding", words=words), FOLDING, quality)


def _list_quantities(
    section: Section, labels: Mapping[str, str], values: Mapping[str, Any]
) -> Section:
    """Return the section with a table of the labelled values that there are."""
    rows = [(words, values[name]) for name, words in labels.items() if name in values]
    if not rows:
        return replace(section, words=f"{section.words} No results.".strip())
    return replace(section, table=make_table(("quantity", "value"), rows))


def make_classes(classes: Mapping[str, Any]) -> Section:
    """Return the thickness classes and the verdict on the grouped design."""
    title = "Thickness classes"
    if not classes.get("classes"):
        return Section(title, words=f"No classes: {classes.get('reason') or 'none were asked for'}")
    rows = [
        (item["class"], 1e3 * item["thickness_m"], item["panels"], item["area_m2"])
        for item in classes["classes"]
    ]
    added = classes.get("added_volume_relative")
    share = "" if added is None else f", volume {100 * added:+.1f} %"
    verdict = str(classes.get("verdict")).replace("_", " ")
    words = f"{verdict}{share}: {classes.get('reason') or ''}"
    return Section(
        title,
        words=words,
        table=make_table(("class", "thickness [mm]", "panels", "area [m²]"), rows),
    )


def make_mesh_error(study: Mapping[str, Any]) -> Section:
    """Return how far each headline number is from that of a finer mesh."""
    errors = study.get("errors") or {}
    if not errors:
        return Section("Mesh error", words=f"Not measured: {study.get('reason') or 'no results'}")
    names = list(dict.fromkeys(name for one in errors.values() for name in one))
    header = ["difference to the fine mesh", *(f"{name} [%]" for name in errors)]
    rows = [
        (name_quantity(name, unit=False), *(_percent(one.get(name)) for one in errors.values()))
        for name in names
    ]
    return Section("Mesh error", table=make_table(header, rows))


def make_crosscheck(comparison: Mapping[str, Any]) -> Section:
    """Return both codes side by side with their tolerance."""
    passed = comparison.get("pass")
    words = "every quantity is within its tolerance" if passed else "not within tolerance"
    note = comparison.get("note") or comparison.get("reason")
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
    return Section(
        "Cross-check by the independent code",
        Box("good" if passed else "bad", f"{words}: {note}" if note else words),
        table=make_table(header, rows) if rows else None,
    )


def _percent(value: float | None) -> float | None:
    return None if value is None else 100 * value


def make_history(history: Sequence[Mapping[str, str]], utilization_max: float) -> Section:
    """Return the chart of volume, utilization and displacement over the iterations."""

    def column(name: str, factor: float = 1.0) -> list[float | None]:
        """Numbers of a column, None where it is empty."""
        return [factor * float(row[name]) if row.get(name) else None for row in history]

    limits = [value for value in column("displacement_limit_m", 1e3) if value is not None]
    chart = draw_history([
        Series("volume [m³]", column("volume_m3"), {}),
        Series("utilization, largest panel mean [-]", column("utilization_panel_mean_max"),
               {f"limit {utilization_max:g}": utilization_max}),
        Series("vertical displacement, down [mm]", column("displacement_vertical_max_m", 1e3),
               {"limit": limits[-1]} if limits else {}),
    ])  # fmt: skip
    return Section("History", chart=chart)
