"""Tables of plain rows: columns with units, written to .csv and to sheets alike."""

import csv
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from foldshell.files.whole import atomic_path
from foldshell.workbook.styles import Styles, split_unit, write_header, write_value

Row = Mapping[str, Any]
_LINE_HEIGHT = 13.5


@dataclass(frozen=True)
class Column:
    """A column: the key of its values, unit, named format and width in characters."""

    key: str
    unit: str
    style: str
    width: float


_INTEGERS = (
    "iteration",
    "iterations",
    "panel",
    "zigzag",
    "strip",
    "class",
    "panels",
    "panels_above_one",
    "panels_at_bound",
    "mesh_subdivisions",
    "second_order_iterations",
    "designs",
)
_TEXTS = {
    "design": 34.0,
    "tags": 36.0,
    "reason": 50.0,
    "settings_hash": 14.0,
    "state": 24.0,
    "verdict": 24.0,
    "note": 40.0,
    "name": 26.0,
    "value": 60.0,
    "setting": 36.0,
}
_CHANGES = ("change", "volume_change_relative")
_TEXT_KEYS = ("pattern", "surface", "support", "fold_mode", "crosscheck", "edited", "met", "source")


def make_column(key: str) -> Column:
    """Choose unit, format and width by a column's key."""
    unit = split_unit(key)[1]
    width = max(10.0, min(18.0, 1.1 * len(key) + 2.0))
    if key == "reason":
        return Column(key, "", "wrap", _TEXTS[key])
    if key in _TEXTS or key in _TEXT_KEYS:
        return Column(key, "", "text", _TEXTS.get(key, 11.0))
    if key in _INTEGERS:
        return Column(key, "-", "integer", width)
    if key in ("mesh_error", "buckling_mesh_error"):
        return Column(key, "-", "percent", width)
    if key in _CHANGES:
        return Column(key, "-", "change", width)
    if key.startswith(("reaction_", "imbalance")):
        return Column(key, "-", "scientific", width)
    if key in ("span_m", "height_m", "edge_beam_depth_m", "edge_beam_thickness_m"):
        return Column(key, unit, "general", width)
    return Column(key, unit, "metre" if unit == "m" else "decimal", width)


def make_columns(keys: Sequence[str]) -> list[Column]:
    """Return the columns of several keys."""
    return [make_column(key) for key in keys]


FORMULA_STARTS = ("=", "+", "@", "\t", "\r")
"""A spreadsheet runs a text of a .csv file that begins so; an apostrophe before it says not to."""


def write_csv(path: str | Path, keys: Sequence[str], rows: Sequence[Row]) -> None:
    """Write rows as UTF-8 .csv with a header; floats with all their digits, None left empty."""
    with (
        atomic_path(path) as temporary,
        temporary.open("w", encoding="utf-8", newline="") as stream,
    ):
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(keys)
        for row in rows:
            writer.writerow([_show(row.get(key)) for key in keys])


def _show(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return repr(float(value))
    text = str(value)
    return f"'{text}" if isinstance(value, str) and text.startswith(FORMULA_STARTS) else text


def write_table(
    sheet: Any,
    styles: Styles,
    row: int,
    columns: Sequence[Column],
    rows: Sequence[Row],
    upright: bool = False,
) -> int:
    """Write header, units and rows from a row on; return the first row of values.

    `upright` turns the headers of numbers, so that a wide table fits a page. Endings in the
    columns `state`, `verdict` and `crosscheck` are coloured by what they say.
    """
    heads = [(column.key, column.unit, column.style, column.width) for column in columns]
    write_header(sheet, styles, row, heads, upright)
    for offset, values in enumerate(rows, start=row + 2):
        lines = _count_lines(columns, values)
        if lines > 1:
            sheet.set_row(offset, _LINE_HEIGHT * lines)
        for index, column in enumerate(columns):
            value = values.get(column.key)
            style = styles[column.style]
            if column.key in ("state", "verdict", "crosscheck") and value:
                style = styles.choose_verdict(str(value))
            write_value(sheet, offset, index, value, style)
    return row + 2


def _count_lines(columns: Sequence[Column], values: Row) -> int:
    """Return the lines that the wrapped texts of a row need; not every program finds out itself."""
    needed = [
        math.ceil(1.1 * len(str(values.get(column.key) or "")) / column.width)
        for column in columns
        if column.style == "wrap"
    ]
    return max(needed, default=1)
