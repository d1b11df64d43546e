"""The workbook of one design that an engineer opens: verdict, panels, history, loads, notes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from foldshell.records.analysis import Criteria
from foldshell.records.engineering import EngineeringArrays, EngineeringRecord
from foldshell.records.history import HistoryRow
from foldshell.settings.loads import LOAD_CASES, Combinations
from foldshell.settings.stage import StageSettings, flatten
from foldshell.workbook.engineering import (
    add_checks,
    add_combinations,
    add_reactions,
    list_groups,
    list_panel_columns,
    write_volume,
)
from foldshell.workbook.history import add_history_sheets
from foldshell.workbook.panels import FloatArray, IntArray, PanelGrid
from foldshell.workbook.reinforcement import add_reinforcement
from foldshell.workbook.styles import (
    LINE_WIDTH,
    Line,
    Styles,
    add_sheet,
    create_workbook,
    mark_above,
    print_in_blocks,
    write_lines,
    write_value,
)
from foldshell.workbook.tables import Column, write_table


@dataclass(frozen=True)
class DesignReport:
    """What `design.xlsx` shows, as plain values.

    `combinations` have factors of load cases by name, those of `cases`; `settings`, `versions` and
    `sources` fill the sheet of notes. thickness in m, utilization by `measure`, (P,) each.
    """

    title: str
    verdict: Sequence[Line]
    criteria: Criteria
    grid: PanelGrid
    thickness: FloatArray
    utilization: FloatArray
    history: Sequence[HistoryRow]
    thickness_class: IntArray | None = None
    loads: Sequence[Line] = ()
    cases: Sequence[str] = LOAD_CASES
    combinations: Combinations = field(default_factory=Combinations)
    settings: StageSettings = field(default_factory=StageSettings)
    versions: Mapping[str, str] = field(default_factory=dict)
    sources: Sequence[str] = ()
    utilization_max: float = 1.0
    measure: str = "panel_mean"
    engineering: EngineeringRecord | None = None
    engineering_arrays: EngineeringArrays | None = None

    @property
    def judged(self) -> tuple[Sequence[Line], float, str]:
        """Verdict, largest utilization allowed and the measure that it holds for."""
        return self.verdict, self.utilization_max, self.measure


def write_design(path: str | Path, report: DesignReport) -> None:
    """Write `design.xlsx`: sheets summary, panels, history, charts, loads and notes; with an
    engineering verdict its checks, reactions and combinations as well."""
    with create_workbook(path, report.title) as (book, styles):
        _add_summary(book, styles, report)
        engineering, limit = report.engineering, report.utilization_max
        if engineering is not None:
            add_checks(book, styles, engineering, f"{report.title}: engineering checks")
        _add_panels(book, styles, report)
        if engineering is not None:
            add_reinforcement(book, styles, engineering.reinforcement)
            add_reactions(book, styles, engineering, report.engineering_arrays)
            own = {f"sizing loop, {name}": getattr(report.combinations, name)
                   for name in ("strength", "deflection")}  # fmt: skip
            groups = own | list_groups(engineering)
            add_combinations(book, styles, groups, engineering.loads, engineering.load_moments)
        add_history_sheets(book, styles, report.history, limit, report.measure)
        _add_loads(book, styles, report)
        add_notes(
            book, styles, flatten(report.settings.to_plain()), report.versions, report.sources
        )


def _add_summary(book: Any, styles: Styles, report: DesignReport) -> None:
    sheet = add_sheet(book, "summary", landscape=False)
    for column, width in enumerate((34, LINE_WIDTH, 14, 10)):
        sheet.set_column(column, column, width)
    sheet.write_string(0, 0, report.title, styles["title"])
    row = write_lines(sheet, styles, 2, report.verdict) + 1
    for column, name in enumerate(("criterion", "value", "limit", "met")):
        sheet.write_string(row, column, name, styles["header"])
    for about, item in report.criteria.items():
        row += 1
        label = about.words if about.unit == "-" else f"{about.words} [{about.unit}]"
        sheet.write_string(row, 0, label, styles["label"])
        for column, value in ((1, item.value), (2, item.limit)):
            write_value(sheet, row, column, value, styles["general_left"])
        met = "yes" if item.met else "no"
        sheet.write_string(row, 3, met, styles["good" if item.met else "bad"])


def _add_panels(book: Any, styles: Styles, report: DesignReport) -> None:
    grid = report.grid
    about = grid.columns
    columns = [
        Column("panel", "-", "integer", 10.0),
        *(Column(name, unit, style, 10.0) for name, unit, style, _ in about),
        Column("thickness_m", "m", "metre", 14.0),
        Column(f"utilization_{report.measure}", "-", "decimal", 14.0),
    ]
    values = [grid.panel, *(one[-1] for one in about), report.thickness, report.utilization]
    place = 1 + len(about)
    if report.thickness_class is not None:
        columns.append(Column("class", "-", "integer", 10.0))
        values.append(report.thickness_class)
    if report.engineering is not None:
        more = list_panel_columns(report.engineering)
        known = {column.key for column in columns}
        columns += [column for column, _ in more if column.key not in known]
        values += [np.array(own) for column, own in more if column.key not in known]
    rows = list(zip(*(column.tolist() for column in values), strict=True))
    wide = report.engineering is not None
    sheet = add_sheet(book, "panels", landscape=wide)
    first = write_table(sheet, styles, 0, columns, rows, upright=wide)
    if report.engineering is not None:
        names = [column.key for column in columns]
        print_in_blocks(sheet, [9.0] * len(columns))
        write_volume(sheet, styles, first, report.engineering, names)
    last = len(rows) + 1
    sheet.autofilter(1, 0, last, len(values) - 1)
    mark_above(sheet, styles, (2, place + 1, last, place + 1), report.utilization_max)
    scale = {"type": "2_color_scale", "min_color": "#F8FAFC", "max_color": "#93C5FD"}
    sheet.conditional_format(2, place, last, place, scale)


def _add_loads(book: Any, styles: Styles, report: DesignReport) -> None:
    sheet = add_sheet(book, "loads")
    sheet.set_column(0, 0, 34)
    sheet.set_column(1, 8, 14)
    sheet.write_string(0, 0, "Loads", styles["title"])
    row = write_lines(sheet, styles, 2, report.loads) + 1
    sheet.write_string(row, 0, "Combinations: factors of the load cases", styles["title"])
    row += 2
    for column, name in enumerate(("combination", "for", *report.cases)):
        style = "header" if column < 2 else "header_number"
        sheet.write_string(row, column, name, styles[style])
    for purpose in ("strength", "deflection"):
        for name, factors in getattr(report.combinations, purpose).items():
            row += 1
            sheet.write_string(row, 0, name, styles["text"])
            sheet.write_string(row, 1, purpose, styles["text"])
            for column, case in enumerate(report.cases, start=2):
                if factors.get(case):
                    sheet.write_number(row, column, factors[case], styles["general"])


def add_notes(
    book: Any,
    styles: Styles,
    settings: Sequence[tuple[str, object]],
    versions: Mapping[str, str],
    sources: Sequence[str],
) -> None:
    """Add the sheet `notes`: settings by name in kN, m, kPa and rad, versions, sources."""
    sheet = add_sheet(book, "notes", landscape=False)
    rows = list(settings)
    rows += [(f"version of {name}", text) for name, text in versions.items()]
    rows += [("source", text) for text in sources]
    columns = [Column("setting", "", "text", 36.0), Column("value", "", "text", 60.0)]
    write_table(sheet, styles, 0, columns, rows)
    sheet.write_string(1, 0, "units: kN, m, kPa, rad", styles["unit_text"])
