"""The sections of a design's page: verdict, criteria, history, checks, mesh error, folding."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from foldshell.files.units import name_unit
from foldshell.records.analysis import AnalysisRecord, Criteria, read_analysis
from foldshell.records.classes import ClassesRecord
from foldshell.records.comparison import ComparisonRecord, read_comparison
from foldshell.records.engineering import EngineeringRecord
from foldshell.records.entry import Entry, entries
from foldshell.records.files import read_record
from foldshell.records.history import HistoryRow
from foldshell.records.mesh_convergence import MeshConvergenceRecord
from foldshell.records.quality import QualityRecord
from foldshell.records.table import read_rows
from foldshell.report.checks import Check, describe_share, find_governing, read_checks
from foldshell.report.engineering import make_engineering, read_verdict
from foldshell.report.history_chart import Series, draw_history
from foldshell.report.markup import format_number, make_table
from foldshell.report.quality_sections import make_crosscheck, make_mesh_error
from foldshell.report.reading import say_both
from foldshell.report.section import Box, Section, judge_met
from foldshell.results.comparisons import UNFOLDED
from foldshell.results.design_view import count_analyses
from foldshell.settings.design import NONE, Design
from foldshell.settings.support_row import SUPPORTS
from foldshell.workbook.styles import GOOD_VERDICTS

FOLDING = (
    "rms_over_span",
    "max_over_span",
    "edge_strain_max",
    "edge_strain_rms",
    "angle_defect_max_rad",
    "planarity_max",
    "planarity_mean",
    "neutral_fold_mean_deg",
    "flipped_folds",
    "self_intersections",
    "plan_coverage",
    "beyond_border_m",
    "unfold_closure_m",
    "refold_closure_m",
)
HEADLINES = (
    "volume_m3",
    "area_m2",
    "utilization_panel_mean_max",
    "governing_combination",
    "utilization_p99",
    "utilization_max",
    "utilization_mean",
    "displacement_vertical_max_m",
    "panels_above_one",
    "panels_at_bound",
    "reaction_imbalance",
    "mesh_subdivisions",
    "dofs",
)
CHECKS = "Checks by the paper's criteria"


@dataclass(frozen=True)
class DesignFiles:
    """What the files of a design say; `history` are the rows of history.csv."""

    design: Design
    final: AnalysisRecord
    quality: QualityRecord
    classes: ClassesRecord
    mesh_convergence: MeshConvergenceRecord
    comparison: ComparisonRecord
    history: Sequence[HistoryRow]
    checks: Sequence[Check] = ()
    engineering: EngineeringRecord | None = None


def read_files(design: Design, paths: Mapping[str, str | Path]) -> DesignFiles:
    """Read final, quality, classes, mesh_convergence, comparison (JSON) and history (CSV).

    Raises `InputError` for a file that is missing or damaged.
    """
    final = read_analysis(paths["final"])
    return DesignFiles(
        design=design,
        final=final,
        quality=read_record(paths["quality"], QualityRecord),
        classes=read_record(paths["classes"], ClassesRecord),
        mesh_convergence=read_record(paths["mesh_convergence"], MeshConvergenceRecord),
        comparison=read_comparison(paths["comparison"]),
        history=read_rows(paths["history"], HistoryRow),
        checks=read_checks(final, paths),
        engineering=read_verdict(paths.get("engineering")),
    )


def make_sections(files: DesignFiles, utilization_max: float) -> list[Section]:
    """Return all sections of a design's page, what matters most first."""
    return [
        make_verdict(files.final, files.history),
        *(engineering := make_engineering(files.engineering))[:1],
        *make_warnings(files.final),
        make_checks(files.checks, say_both([files.final])),
        make_criteria(files.final.criteria),
        make_history(files.history, utilization_max),
        make_headlines(files.final),
        *engineering[1:],
        make_crosscheck(files.comparison),
        make_mesh_error(files.mesh_convergence),
        make_classes(files.classes),
        make_folding(files.quality),
    ]


def describe_design(design: Design) -> str:
    """Return the row of designs.tsv as one sentence."""
    tags = ", ".join(design.tags or ("none",))
    laid = design.pattern in UNFOLDED
    made = "laid out, not folded" if laid else f"folded in mode {design.fold_mode}"
    size = f"{say_span(design)} m, height {design.height:g} m"
    end = f"supports {design.support}, {made}; tags {tags}"
    if design.folded != NONE:
        unit = f"coordinates in {name_unit(design.file_unit) or 'the unit that it declares'}"
        return f"sheet folded already, from {design.folded}, {unit}; {size}, {end}"
    if not design.on_grid:
        return f"{design.pattern} pattern, surface {design.surface}, {size}, {end}"
    return (
        f"{design.pattern} pattern, surface {design.surface}, {size}, "
        f"{design.zigzag} zig-zags × {design.strip} strips, "
        f"{_name_supports(design)}, {made}; tags {tags}"
    )


def say_span(design: Design) -> str:
    """Return the span, or both sides of a rectangular plan, as words before the unit m."""
    x, y = design.sides
    return f"span {x:g}" if x == y else f"plan {x:g} x {y:g} m, span {design.span:g}"


def _name_supports(design: Design) -> str:
    pinned = design.support in SUPPORTS
    return f"{design.support} edges supported" if pinned else f"supports {design.support}"


def make_verdict(final: AnalysisRecord, history: Sequence[HistoryRow] = ()) -> Section:
    """Return verdict, count of analyses and reason; below it that a person changed panels."""
    kind = "good" if final.verdict in GOOD_VERDICTS else "bad"
    words = f"after {count_analyses(final)}"
    box = Box(kind, words, final.verdict.replace("_", " "), final.reason)
    return Section("Verdict by the paper's criteria", box, note=describe_edits(history))


def make_warnings(final: AnalysisRecord) -> list[Section]:
    """Return what theory or mesh does not hold, so that no number is read without it."""
    found = final.model_warnings or ()
    words = f"of the model: {'; '.join(found)}"
    head = "1 warning" if len(found) == 1 else f"{len(found)} warnings"
    return [Section("Model", Box("bad", words, head))] if found else []


def make_checks(checks: Sequence[Check], reading: str = "") -> Section:
    """Return the checks with the share of its limit that each uses; what governs stands first.

    `reading` says how the values are to be read.
    """
    governing = find_governing(checks)
    if governing is None:
        return Section(
            "Checks by the paper's criteria",
            words="No check has a value: the analysis gave no results.",
        )
    rows = [
        (check.name, check.value, check.limit, describe_share(check.ratio), judge_met(check.met),
         check.where)
        for check in checks
    ]  # fmt: skip
    header = ("check", "value", "limit", "of its limit", "met", "where")
    box = Box(
        "good" if governing.met else "bad", governing.words, "governs by the paper's criteria"
    )
    return Section(
        "Checks by the paper's criteria", box, words=reading, table=make_table(header, rows)
    )


def describe_edits(history: Sequence[HistoryRow]) -> str:
    """Say in which workbooks a person changed panels, nothing where nobody has."""
    edits = [f"{row.iteration:02d} ({row.edited_panels} panels)"
             for row in history if row.edited_panels]  # fmt: skip
    return (
        f"A person changed thicknesses in the workbook of iteration {', '.join(edits)}; "
        "the allowed iterations count from there."
        if edits
        else ""
    )


def make_criteria(criteria: Criteria) -> Section:
    """Return the criteria with value, limit and whether they are met."""
    rows = []
    for about, item in criteria.items():
        words, factor = show_unit(about)
        value = None if item.value is None else factor * item.value
        rows.append((words, value, factor * item.limit, judge_met(item.met)))
    if not rows:
        return Section("Criteria", words="No criteria: the analysis gave no results.")
    return Section("Criteria", table=make_table(("criterion", "value", "limit", "met"), rows))


def show_unit(about: Entry) -> tuple[str, float]:
    """Return the words of a field with the unit that people read, and the factor into it: files
    hold displacements in m, pages show them in mm."""
    if about.key.startswith("displacement") and about.unit == "m":
        return f"{about.words} [mm]", 1e3
    return about.label(), 1


def make_headlines(final: AnalysisRecord) -> Section:
    """Return the numbers of the final state, and the buckling factors."""
    factors = final.buckling_factor
    words = ", ".join(f"{name} {format_number(value)}" for name, value in factors.items())
    note = f"Buckling factors: {words}" if words else ""
    section = _list_quantities(Section("Final state", note=note), HEADLINES, final)
    keys = [key for key in HEADLINES if getattr(final, key) is not None]
    rows = [(*row, final.describe_limit(key))
            for key, row in zip(keys, section.table.rows, strict=True)]  # fmt: skip
    return replace(section, table=make_table(("quantity", "value", "limit"), rows))


def make_folding(quality: QualityRecord) -> Section:
    """Return state, reason and measures of the folded sheet."""
    words = f"{quality.state.replace('_', ' ')}: {quality.reason or 'no reason given'}"
    return _list_quantities(Section("Folding", words=words), FOLDING, quality)


def _list_quantities(section: Section, keys: Sequence[str], record: Any) -> Section:
    """Return the section with a table of the fields of a record that have a value."""
    known = entries(type(record))
    values = [(*show_unit(known[key]), getattr(record, known[key].attribute)) for key in keys]
    rows = [(words, value if factor == 1 else factor * value)
            for words, factor, value in values if value is not None]  # fmt: skip
    return replace(section, table=make_table(("quantity", "value"), rows))


def make_classes(classes: ClassesRecord) -> Section:
    """Return the thickness classes and the verdict on the grouped design."""
    rows = [(one.number, 1e3 * one.thickness_m, one.panels, one.area_m2) for one in classes.classes]
    share = f", volume {100 * classes.added_volume_relative:+.1f} %"
    return Section(
        "Thickness classes",
        words=f"{classes.verdict.replace('_', ' ')}{share}: {classes.reason}",
        table=make_table(("class", "thickness [mm]", "panels", "area [m²]"), rows),
    )


def make_history(history: Sequence[HistoryRow], utilization_max: float) -> Section:
    """Return the chart of volume, utilization and displacement over the iterations."""
    known = entries(HistoryRow)
    limits = [row.displacement_limit_m for row in history if row.displacement_limit_m is not None]
    down = known["displacement_vertical_max_m"].label(unit=False)
    moved = [row.displacement_vertical_max_m for row in history]
    chart = draw_history([
        Series(known["volume_m3"].label(), [row.volume_m3 for row in history], {}),
        Series(known["utilization_panel_mean_max"].label(),
               [row.utilization_panel_mean_max for row in history],
               {f"limit {utilization_max:g}": utilization_max}),
        Series(f"{down} [mm]", [None if one is None else 1e3 * one for one in moved],
               {"limit": 1e3 * limits[-1]} if limits else {}),
    ])  # fmt: skip
    return Section("History", chart=chart)
