"""Tables of rows on sheets: columns with units, from the fields of a record or made by hand."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from foldshell.records.entry import COUNT, Entry, strip_null
from foldshell.records.table import choose_columns, list_cells
from foldshell.workbook.styles import (
    JUDGED,
    LINE_HEIGHT,
    Styles,
    count_lines,
    print_in_blocks,
    write_header,
    write_value,
)


@dataclass(frozen=True)
class Column:
    """A column: header, unit, named format and width in characters."""

    key: str
    unit: str
    style: str
    width: float


_WIDTHS = {
    "design": 34.0,
    "tags": 36.0,
    "reason": 50.0,
    "engineering_reason": 50.0,
    "engineering": 14.0,
    "model_warnings": 50.0,
    "settings_hash": 14.0,
    "state": 24.0,
    "verdict": 24.0,
}
"""Of texts whose length is known; others have 11 characters."""
WRAPPED = ("reason", "model_warnings", "engineering_reason")


def make_column(about: Entry) -> Column:
    """Return the column of a field: header, unit and format come from its record."""
    width = max(10.0, min(18.0, 1.1 * len(about.key) + 2.0))
    if strip_null(about.type) not in (int, float):
        style = "wrap" if about.key in WRAPPED else "text"
        return Column(about.key, "", style, _WIDTHS.get(about.key, 11.0))
    unit = "-" if about.unit == COUNT else about.unit
    if about.form:
        return Column(about.key, unit, about.form, width)
    if strip_null(about.type) is int:
        return Column(about.key, unit, "integer", width)
    return Column(about.key, unit, "metre" if unit == "m" else "decimal", width)


BLOCKS_FROM = 20
"""A table of more columns is printed in blocks on A3, since it would be too small on one page."""


def write_records(sheet: Any, styles: Styles, kind: type, rows: Sequence[Any]) -> list[Entry]:
    """Write a table of records from the first row on, headers of numbers turned; return its
    columns."""
    columns = choose_columns(kind, rows)
    made = [make_column(about) for about in columns]
    write_table(sheet, styles, 0, made, list_cells(columns, rows), upright=True)
    if len(made) > BLOCKS_FROM:
        texts = ("text", "wrap")
        print_in_blocks(sheet, [one.width if one.style in texts else 9.0 for one in made])
    return columns


def write_table(
    sheet: Any,
    styles: Styles,
    row: int,
    columns: Sequence[Column],
    rows: Sequence[Sequence[Any]],
    upright: bool = False,
) -> int:
    """Write header, units and rows of cells from a row on; return the first row of values.

    `upright` turns the headers of numbers, so that a wide table fits a page. Endings in the
    columns that are judged are coloured by what they say.
    """
    heads = [(column.key, column.unit, column.style, column.width) for column in columns]
    write_header(sheet, styles, row, heads, upright)
    for offset, cells in enumerate(rows, start=row + 2):
        lines = _count_lines(columns, cells)
        if lines > 1:
            sheet.set_row(offset, LINE_HEIGHT * lines)
        for index, (column, value) in enumerate(zip(columns, cells, strict=True)):
            style = styles[column.style]
            if column.key in JUDGED and value:
                style = styles.choose_verdict(str(value))
            write_value(sheet, offset, index, value, style)
    return row + 2


def _count_lines(columns: Sequence[Column], cells: Sequence[Any]) -> int:
    """Return the lines that the wrapped texts of a row need."""
    needed = [
        count_lines(str(value or ""), column.width)
        for column, value in zip(columns, cells, strict=True)
        if column.style == "wrap"
    ]
    return max(needed, default=1)
