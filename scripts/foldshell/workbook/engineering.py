"""Sheets of the engineering verdict: checks, panels, reactions, combinations, loads."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from foldshell.checks.materials import CRITERION_WORDS
from foldshell.records.analysis import NO_LIMIT
from foldshell.records.engineering import (
    EngineeringArrays,
    EngineeringCheck,
    EngineeringRecord,
)
from foldshell.settings.field import Factors
from foldshell.workbook.cells import name_column
from foldshell.workbook.reinforcement import add_reinforcement
from foldshell.workbook.styles import (
    LINE_HEIGHT,
    Line,
    Styles,
    add_sheet,
    count_lines,
    create_workbook,
    print_in_blocks,
    write_lines,
)
from foldshell.workbook.tables import Column, write_table

VERDICTS = {"passes": "good", "fails": "bad", "not_applicable": "plain"}
PLACES = ("reinforced_place", "steel_place")
TEXTS = ("reinforced_check", "reinforced_combination", "steel_combination", *PLACES)
"""Columns of words beside those of reinforcement."""
CHECK_COLUMNS = (
    Column("check", "", "wrap", 58.0),
    Column("value", "see unit", "general", 12.0),
    Column("limit", "see unit", "general", 12.0),
    Column("unit", "", "text", 7.0),
    Column("used", "of limit", "percent", 10.0),
    Column("met", "", "text", 26.0),
    Column("combination", "", "text", 13.0),
    Column("panel", "-", "integer", 8.0),
    Column("place", "", "wrap", 44.0),
    Column("mesh error", "-", "percent", 10.0),
)
REACTION_COLUMNS = (
    Column("combination", "", "text", 14.0),
    Column("at", "", "text", 26.0),
    *(Column(f"R{axis}", "kN", "decimal", 13.0) for axis in "xyz"),
    Column("thrust", "kN", "decimal", 13.0),
)


def write_engineering(
    path: str | Path, title: str, record: EngineeringRecord, arrays: EngineeringArrays
) -> None:
    """Write the workbook of an engineering verdict; reactions of vertices are in design.xlsx."""
    with create_workbook(path, f"Engineering checks of {title}") as (book, styles):
        add_checks(book, styles, record, f"Engineering checks of {title}")
        add_panels(book, styles, record)
        add_reinforcement(book, styles, record.reinforcement)
        add_reactions(book, styles, record, arrays, vertices=False)
        add_combinations(book, styles, list_groups(record), record.loads, record.load_moments)


def add_checks(book: Any, styles: Styles, record: EngineeringRecord, title: str) -> None:
    """Add the sheet `checks`: verdict, each check with its share of the limit as a formula, and
    utilization by criterion."""
    sheet = add_sheet(book, "checks")
    sheet.write_string(0, 0, title, styles["title"])
    sheet.write_string(1, 0, record.verdict.replace("_", " "), styles[VERDICTS[record.verdict]])
    width = sum(column.width for column in CHECK_COLUMNS)
    sheet.merge_range(2, 0, 2, len(CHECK_COLUMNS) - 1, record.reason, styles["wrap"])
    sheet.set_row(2, LINE_HEIGHT * count_lines(record.reason, width))
    rows = [_list_cells(one) for one in record.checks.values()]
    first = write_table(sheet, styles, 4, CHECK_COLUMNS, rows)
    for row, one in enumerate(record.checks.values(), start=first):
        _write_share(sheet, styles, row, one)
    row = first + len(rows) + 1
    sheet.write_string(row, 0, "The buckling factor that is required", styles["title"])
    lines = [Line(name.replace("_", " "), value) for name, value in record.buckling_terms.items()]
    row = write_lines(sheet, styles, row + 1, lines) + 1
    sheet.write_string(
        row, 0, "Utilization under the loop's own combinations, by criterion", styles["title"]
    )
    _add_measures(sheet, styles, row + 1, record)


def _list_cells(check: EngineeringCheck) -> list[Any]:
    met = {None: NO_LIMIT, True: "yes", False: "no"}[check.met]
    met += ", within mesh error" if check.within_mesh_error else ""
    first = [check.words, check.value, check.limit, check.unit, None, met]
    return [*first, check.governing_combination, check.panel, check.place,
            check.mesh_error]  # fmt: skip


def _write_share(sheet: Any, styles: Styles, row: int, check: EngineeringCheck) -> None:
    """Write which share of its limit a check uses, as a formula of the cells beside it."""
    if not check.value or not check.limit:
        return
    value, limit = f"B{row + 1}", f"C{row + 1}"
    parts = (limit, value) if check.at_least else (value, limit)
    share = check.limit / check.value if check.at_least else check.value / check.limit
    sheet.write_formula(row, 4, f"={parts[0]}/{parts[1]}", styles["percent"], share)
    if check.met is not None:
        text = _list_cells(check)[5]
        sheet.write_string(row, 5, text, styles["good" if check.met else "bad"])


def _add_measures(sheet: Any, styles: Styles, row: int, record: EngineeringRecord) -> None:
    names = ("criterion", "utilization_panel_mean_max", "utilization_strip_max",
             "panels_above_one", "area_share_above_one")  # fmt: skip
    for column, name in enumerate(names):
        style = styles["header_number" if column else "header"]
        sheet.write_string(row, column, name.replace("_", " "), style)
    sheet.set_row(row, 58)
    for line, (name, one) in enumerate(record.measures.items(), start=row + 1):
        sheet.write_string(line, 0, CRITERION_WORDS[name], styles["text"])
        for column, key in enumerate(names[1:], start=1):
            sheet.write_number(line, column, getattr(one, key), styles["general"])


def list_panel_columns(record: EngineeringRecord) -> list[tuple[Column, tuple]]:
    """Return the columns of panels with their values, by the names that engineering.json has."""
    found = []
    for name, values in record.panels.items():
        unit, style = _judge_column(name)
        width = 44.0 if name in PLACES else 13.0 if style == "text" else 11.0
        found.append((Column(name, unit, style, width), values))
    return found


def _judge_column(name: str) -> tuple[str, str]:
    if name == "panel":
        return "-", "integer"
    if name in ("governing_combination", "cracked", *TEXTS):
        return "", "text"
    if name == "layers":
        return "-", "integer"
    if name in ("CWB", "CWT"):
        return "mm", "decimal"
    for ending, unit in (("_cm2_m", "cm2/m"), ("_mm", "mm"), ("_kn_m", "kN/m")):
        if name.endswith(ending):
            return unit, "decimal"
    if name.endswith("_m2"):
        return "m2", "decimal"
    if name.endswith("_m"):
        return "m", "metre"
    if name[0] in "nv" and name.endswith(("_min", "_max")):
        return "kN/m", "decimal"
    return ("kNm/m", "decimal") if name[0] == "m" else ("-", "decimal")


def add_panels(book: Any, styles: Styles, record: EngineeringRecord) -> None:
    """Add the sheet `panels`: a row per panel, and their volume as a formula."""
    if not record.panels:
        return
    sheet = add_sheet(book, "panels")
    columns = list_panel_columns(record)
    rows = list(zip(*(values for _, values in columns), strict=True))
    first = write_table(sheet, styles, 0, [one for one, _ in columns], rows, upright=True)
    print_in_blocks(sheet, [one.width if one.key in PLACES else 9.0 for one, _ in columns])
    write_volume(sheet, styles, first, record, [one.key for one, _ in columns])


def write_volume(
    sheet: Any, styles: Styles, first: int, record: EngineeringRecord, names: Sequence[str]
) -> None:
    """Write area and volume of all panels below a table, as formulas of its columns."""
    count = len(record.panels.get("panel", ()))
    if not count:
        return
    area, thick = (np.array(record.panels[name]) for name in ("area_m2", "thickness_m"))
    ends = {name: _span(names.index(name), first, count) for name in ("area_m2", "thickness_m")}
    row = first + count + 1
    lines = (
        ("area [m2]", f"=SUM({ends['area_m2']})", float(area.sum())),
        ("volume [m3]", f"=SUMPRODUCT({ends['area_m2']},{ends['thickness_m']})",
         float(area @ thick)),
    )  # fmt: skip
    for offset, (words, formula, value) in enumerate(lines):
        sheet.write_string(row + offset, 0, words, styles["label"])
        sheet.write_formula(row + offset, 2, formula, styles["decimal"], value)


def _span(column: int, first: int, count: int) -> str:
    letter = name_column(column + 1)
    return f"{letter}{first + 1}:{letter}{first + count}"


def add_reactions(
    book: Any,
    styles: Styles,
    record: EngineeringRecord,
    arrays: EngineeringArrays,
    vertices: bool = True,
) -> None:
    """Add the sheet `reactions`: of edges with totals that close, then of `vertices`."""
    if arrays.edge_reaction is None:
        return
    sheet = add_sheet(book, "reactions", landscape=False)
    names = [*record.combinations.strength, *record.combinations.characteristic]
    row = write_table(sheet, styles, 0, REACTION_COLUMNS, [])
    for column, name in enumerate(names):
        row = _add_combination(sheet, styles, row, name, column, record, arrays)
    for column, name in enumerate(names if vertices else ()):
        for place, at, force in zip(
            arrays.vertex, arrays.vertex_place, arrays.vertex_reaction[..., column], strict=True
        ):
            x, y, z = at
            words = f"vertex {place} ({x:.2f}, {y:.2f}, {z:.2f})"
            row = _write_force(sheet, styles, row, name, words, force)
    sheet.autofilter(1, 0, row - 1, 5)


def _add_combination(
    sheet: Any, styles: Styles, row: int, name: str, column: int, record, arrays
) -> int:
    """Write the edges of a combination, their total, the loads and what is left of both."""
    start = row
    for edge, force in zip(record.reactions, arrays.edge_reaction[..., column], strict=True):
        row = _write_force(sheet, styles, row, name, edge.replace("_", " "), force)
    load, total = arrays.load_sum[:, column], arrays.edge_reaction[..., column].sum(axis=0)
    for words, values in (("total of supports", total), ("loads", load), ("closing", total + load)):
        sheet.write_string(row, 0, name, styles["text"])
        sheet.write_string(row, 1, words, styles["header"])
        for k, value in enumerate(values.tolist()):
            letter = "CDE"[k]
            if words == "total of supports":
                formula = f"=SUM({letter}{start + 1}:{letter}{row})"
                sheet.write_formula(row, 2 + k, formula, styles["decimal"], value)
            elif words == "closing":
                formula = f"={letter}{row - 1}+{letter}{row}"
                sheet.write_formula(row, 2 + k, formula, styles["decimal"], value)
            else:
                sheet.write_number(row, 2 + k, value, styles["decimal"])
        row += 1
    return row


def _write_force(
    sheet: Any, styles: Styles, row: int, name: str, words: str, force: np.ndarray
) -> int:
    """Write a reaction and its thrust, a formula; return the next row."""
    sheet.write_string(row, 0, name, styles["text"])
    sheet.write_string(row, 1, words, styles["text"])
    for k, value in enumerate(force.tolist()):
        sheet.write_number(row, 2 + k, value, styles["decimal"])
    formula = f"=SQRT(C{row + 1}^2+D{row + 1}^2)"
    sheet.write_formula(row, 5, formula, styles["decimal"], float(np.hypot(*force[:2])))
    return row + 1


def add_combinations(
    book: Any,
    styles: Styles,
    groups: Mapping[str, Factors],
    loads: Mapping[str, Sequence[float]],
    moments: Mapping[str, Sequence[float]] | None = None,
) -> None:
    """Add the sheet `combinations`: resultants of load cases, then factors by combination and the
    resultant of each as a formula of both; below them the moments of the cases.

    `groups` are combinations by purpose, `loads` the resultant (3,) kN of each case, `moments` that
    about the origin, kNm.
    """
    cases = list(loads)
    columns = [Column("combination", "", "text", 14.0), Column("for", "", "text", 26.0)]
    columns += [Column(case, "kN, then factors", "general", 15.0) for case in cases]
    columns += [Column(f"F{axis}", "kN", "decimal", 13.0) for axis in "xyz"]
    rows = [[f"F{axis}", "resultant of the case", *(loads[case][k] for case in cases)]
            for k, axis in enumerate("xyz")]  # fmt: skip
    listed = [(name, purpose, one) for purpose, group in groups.items()
              for name, one in group.items()]  # fmt: skip
    rows += [[name, purpose, *(one.get(case) for case in cases)] for name, purpose, one in listed]
    blank = [[*row, None, None, None] for row in rows]
    sheet = add_sheet(book, "combinations")
    first = write_table(sheet, styles, 0, columns, blank)
    ends = name_column(3), name_column(2 + len(cases))
    for row, (_, _, one) in enumerate(listed, start=first + 3):
        own = f"{ends[0]}{row + 1}:{ends[1]}{row + 1}"
        for k in range(3):
            case = f"{ends[0]}${first + k + 1}:{ends[1]}${first + k + 1}"
            value = sum(factor * loads[name][k] for name, factor in one.items())
            formula = f"=SUMPRODUCT({own},{case})"
            sheet.write_formula(row, 2 + len(cases) + k, formula, styles["decimal"], value)
    for k, axis in enumerate("xyz" if moments else ""):
        row = first + len(rows) + 1 + k
        sheet.write_string(row, 0, f"M{axis}", styles["text"])
        sheet.write_string(row, 1, "moment of the case, kNm", styles["text"])
        for column, case in enumerate(cases, start=2):
            sheet.write_number(row, column, moments[case][k], styles["decimal"])


def list_groups(record: EngineeringRecord) -> dict[str, Factors]:
    """Return the combinations of the engineering verdict by purpose, in words."""
    return {name.replace("_", " "): group for name, group in vars(record.combinations).items()}
