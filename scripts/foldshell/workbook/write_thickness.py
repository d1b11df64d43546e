"""Write the workbook that one analysis of the sizing loop reads."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from foldshell.sizing.panel_limits import PanelLimits
from foldshell.sizing.rounding import round_thickness
from foldshell.workbook.panels import FloatArray, ThicknessTable
from foldshell.workbook.styles import (
    LINE_WIDTH,
    Line,
    Styles,
    add_sheet,
    create_workbook,
    mark_above,
    write_header,
    write_lines,
    write_value,
)

PANEL = ("panel", "-", "integer", 9.0)
THICKNESS = ("thickness", "m", "input", 12.0)
LIMIT_COLUMNS = [
    ("fixed", "-", "input_text", 7.0),
    ("least", "m", "input", 9.0),
    ("largest", "m", "input", 9.0),
    ("group", "-", "input_count", 7.0),
]
RESULT_COLUMNS = [
    ("previous", "m", "metre", 12.0),
    ("utilization", "-", "decimal", 12.0),
    ("change", "-", "change", 12.0),
    ("note", "", "text", 36.0),
]
_LIMIT_HELP = {
    "fixed": "yes: this panel keeps its thickness.",
    "least": "Least thickness of this panel in m; empty for that of the settings.",
    "largest": "Largest thickness of this panel in m; empty for that of the settings.",
    "group": "A number from 1 on: panels of one number take one thickness.",
}
_HELP = (
    "The blue numbers of the sheet 'thickness' may be changed: type metres with a decimal point, "
    "save, and run the workflow again. What follows this iteration is then computed anew. The "
    "columns fixed, least, largest and group hold for it and for all iterations after it."
)


def write_thickness(
    path: str | Path,
    table: ThicknessTable,
    summary: Sequence[Line],
    least: float,
    largest: float,
    utilization_max: float = 1.0,
) -> None:
    """Write sheet `summary` (label, value, unit) and sheet `thickness` (one row per panel).

    Least and largest (m) bound the input cells. Thickness is rounded to 12 digits, so that reading
    gives back exactly `round_thickness(table.thickness)`. Raises `ValueError` for values that are
    not finite or outside of the bounds.
    """
    thickness = round_thickness(table.thickness)
    inside = np.isfinite(thickness) & (thickness >= least) & (thickness <= largest)
    if thickness.shape != table.grid.panel.shape or not inside.all():
        raise ValueError(f"one thickness per panel from {least} to {largest} m is due")
    with create_workbook(path, "Thickness of the panels") as (book, styles):
        sheet = add_sheet(book, "summary", landscape=False)
        sheet.set_column(0, 0, 34)
        sheet.set_column(1, 1, LINE_WIDTH)
        sheet.set_column(2, 2, 10)
        sheet.write_string(0, 0, "Thickness of the panels", styles["title"])
        row = write_lines(sheet, styles, 2, summary)
        sheet.merge_range(row + 1, 0, row + 3, 2, _HELP, styles["wrap"])
        _write_panels(add_sheet(book, "thickness"), styles, table, thickness)
        place = 1 + len(table.grid.columns)
        _mark_input(book, styles, (thickness.size, place), least, largest, utilization_max)


def _write_panels(sheet: Any, styles: Styles, table: ThicknessTable, thickness: FloatArray) -> None:
    about = table.grid.columns
    values: list[Any] = [table.grid.panel, *(column[-1] for column in about), thickness]
    results = [table.previous, table.utilization, table.change, table.note]
    columns = [PANEL, *((name, unit, style, 9.0) for name, unit, style, _ in about), THICKNESS]
    columns += LIMIT_COLUMNS
    values += _list_limits(table.limits, thickness.size)
    if any(result is not None for result in results):
        columns += RESULT_COLUMNS
        values += [[None] * thickness.size if result is None else result for result in results]
    write_header(sheet, styles, 0, columns)
    sheet.autofilter(1, 0, thickness.size + 1, len(columns) - 1)
    for column, (content, (_, _, style, _)) in enumerate(zip(values, columns, strict=True)):
        plain = content.tolist() if isinstance(content, np.ndarray) else content
        for row, value in enumerate(plain, start=2):
            write_value(sheet, row, column, value, styles[style])


def _list_limits(limits: PanelLimits | None, count: int) -> list[list[Any]]:
    """Return the cells of what a person asks of panels, None for empty ones."""
    if limits is None:
        return [[None] * count] * len(LIMIT_COLUMNS)
    fixed = ["yes" if one else None for one in limits.fixed.tolist()]
    group = [one or None for one in limits.group.tolist()]
    return [fixed, limits.least.tolist(), limits.largest.tolist(), group]


def _mark_input(
    book: Any,
    styles: Styles,
    size: tuple[int, int],
    least: float,
    largest: float,
    limit: float,
) -> None:
    """Bound the cells of thicknesses, `size` rows and column; mark utilization above its limit."""
    count, column = size
    sheet = book.get_worksheet_by_name("thickness")
    allowed = f"a number in m from {least:g} to {largest:g}"
    rule = {
        "validate": "decimal",
        "criteria": "between",
        "minimum": least,
        "maximum": largest,
        "input_title": "Thickness",
        "input_message": f"Thickness of this panel, {allowed}.",
        "error_title": "Thickness",
        "error_message": f"Only {allowed} is allowed.",
    }
    sheet.data_validation(2, column, count + 1, column, rule)
    for place, (title, words) in enumerate(_LIMIT_HELP.items(), start=column + 1):
        note = {"validate": "any", "input_title": title, "input_message": words}
        sheet.data_validation(2, place, count + 1, place, note)
    used = column + len(LIMIT_COLUMNS) + 2
    mark_above(sheet, styles, (2, used, count + 1, used), limit)
