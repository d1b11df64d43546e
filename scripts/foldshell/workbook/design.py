"""The workbook of one design that an engineer opens: verdict, panels, history, loads, notes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from foldshell.settings.loads import LOAD_CASES, Combinations
from foldshell.workbook.history import add_history_sheets
from foldshell.workbook.panels import FloatArray, IntArray, PanelGrid
from foldshell.workbook.styles import (
    Styles,
    add_sheet,
    create_workbook,
    mark_above,
    split_unit,
    write_pairs,
)
from foldshell.workbook.tables import Row, make_column, make_columns, write_table


@dataclass(frozen=True)
class DesignReport:
    """What `design.xlsx` shows, as plain values.

    `verdict` and `loads` map keys with unit suffixes to values; `criteria` maps a name to value,
    limit and met, as in analysis.json; `combinations` have factors of load cases by name;
    `settings`, `versions` and `sources` fill the sheet of notes. thickness in m, (P,) each.
    """

    title: str
    verdict: Mapping[str, Any]
    criteria: Mapping[str, Mapping[str, Any]]
    grid: PanelGrid
    thickness: FloatArray
    utilization: FloatArray
    history: Sequence[Row]
    thickness_class: IntArray | None = None
    loads: Mapping[str, Any] = field(default_factory=dict)
    combinations: Combinations = field(default_factory=Combinations)
    settings: Mapping[str, Any] = field(default_factory=dict)
    versions: Mapping[str, str] = field(default_factory=dict)
    sources: Sequence[str] = ()
    utilization_max: float = 1.0


def write_design(path: str | Path, report: DesignReport) -> None:
    """Write `design.xlsx`: sheets summary, panels, history, charts, loads and notes."""
    with create_workbook(path, report.title) as (book, styles):
        _add_summary(book, styles, report)
        _add_panels(book, styles, report)
        add_history_sheets(book, styles, report.history, report.utilization_max)
        _add_loads(book, styles, report)
        add_notes(book, styles, report.settings, report.versions, report.sources)


def _add_summary(book: Any, styles: Styles, report: DesignReport) -> None:
    sheet = add_sheet(book, "summary", landscape=False)
    for column, width in enumerate((34, 44, 14, 10)):
        sheet.set_column(column, column, width)
    sheet.write_string(0, 0, report.title, styles["title"])
    row = write_pairs(sheet, styles, 2, report.verdict) + 1
    for column, name in enumerate(("criterion", "value", "limit", "met")):
        sheet.write_string(row, column, name, styles["header"])
    for name, entry in report.criteria.items():
        row += 1
        label, unit = split_unit(name)
        label = label if unit == "-" else f"{label} [{unit}]"
        sheet.write_string(row, 0, label, styles["label"])
        for column, key in ((1, "value"), (2, "limit")):
            _write_limit(sheet, styles, row, column, entry.get(key))
        met = "yes" if entry.get("met") else "no"
        sheet.write_string(row, 3, met, styles["good" if met == "yes" else "bad"])


def _write_limit(sheet: Any, styles: Styles, row: int, column: int, value: Any) -> None:
    if isinstance(value, int | float) and not isinstance(value, bool):
        sheet.write_number(row, column, value, styles["general_left"])
    elif isinstance(value, list | tuple):
        sheet.write_string(row, column, " to ".join(f"{item:g}" for item in value), styles["text"])
    elif value is not None:
        sheet.write_string(row, column, str(value), styles["text"])


def _add_panels(book: Any, styles: Styles, report: DesignReport) -> None:
    grid = report.grid
    values = {
        "panel": grid.panel.tolist(),
        "zigzag": grid.zigzag_index.tolist(),
        "strip": grid.strip_index.tolist(),
        "thickness_m": report.thickness.tolist(),
        "utilization": report.utilization.tolist(),
    }
    if report.thickness_class is not None:
        values["class"] = report.thickness_class.tolist()
    rows = [dict(zip(values, row, strict=True)) for row in zip(*values.values(), strict=True)]
    sheet = add_sheet(book, "panels")
    write_table(sheet, styles, 0, make_columns(list(values)), rows)
    last = len(rows) + 1
    sheet.autofilter(1, 0, last, len(values) - 1)
    mark_above(sheet, styles, (2, 4, last, 4), report.utilization_max)
    scale = {"type": "2_color_scale", "min_color": "#F8FAFC", "max_color": "#93C5FD"}
    sheet.conditional_format(2, 3, last, 3, scale)


def _add_loads(book: Any, styles: Styles, report: DesignReport) -> None:
    sheet = add_sheet(book, "loads")
    sheet.set_column(0, 0, 34)
    sheet.set_column(1, 8, 14)
    sheet.write_string(0, 0, "Loads", styles["title"])
    row = write_pairs(sheet, styles, 2, report.loads) + 1
    sheet.write_string(row, 0, "Combinations: factors of the load cases", styles["title"])
    row += 2
    for column, name in enumerate(("combination", "for", *LOAD_CASES)):
        style = "header" if column < 2 else "header_number"
        sheet.write_string(row, column, name, styles[style])
    for purpose, group in vars(report.combinations).items():
        for name, factors in group.items():
            row += 1
            sheet.write_string(row, 0, name, styles["text"])
            sheet.write_string(row, 1, purpose, styles["text"])
            for column, case in enumerate(LOAD_CASES, start=2):
                if factors.get(case):
                    sheet.write_number(row, column, factors[case], styles["general"])


def add_notes(
    book: Any,
    styles: Styles,
    settings: Mapping[str, Any],
    versions: Mapping[str, str],
    sources: Sequence[str],
) -> None:
    """Add the sheet `notes`: every setting in kN, m, kPa and rad, versions, sources."""
    sheet = add_sheet(book, "notes", landscape=False)
    rows = [{"setting": key, "value": value} for key, value in flatten(settings).items()]
    rows += [{"setting": f"version of {name}", "value": text} for name, text in versions.items()]
    rows += [{"setting": "source", "value": text} for text in sources]
    write_table(sheet, styles, 0, [make_column("setting"), make_column("value")], rows)
    sheet.write_string(1, 0, "units: kN, m, kPa, rad", styles["unit_text"])


def flatten(values: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Return nested groups as {`group.key`: value}; lists become text."""
    flat: dict[str, Any] = {}
    for key, value in values.items():
        if isinstance(value, Mapping):
            flat.update(flatten(value, f"{prefix}{key}."))
        elif isinstance(value, list | tuple):
            flat[f"{prefix}{key}"] = ", ".join(str(item) for item in value)
        else:
            flat[f"{prefix}{key}"] = value
    return flat
