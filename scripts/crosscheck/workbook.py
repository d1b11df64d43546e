"""The comparison as a workbook: one sheet a view, a units row under each header."""

from collections.abc import Mapping, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any

from xlsxwriter import Workbook
from xlsxwriter.format import Format
from xlsxwriter.worksheet import Worksheet

from crosscheck.reading import write_whole

CREATED = datetime(2020, 1, 1)  # the same values give the same bytes
COLUMNS = ("quantity", "unit", "primary", "independent", "difference", "tolerance", "result")
UNITS = ("limit of the meshes", "", "in unit", "in unit", "%", "%", "")
MESH_COLUMNS = ("quantity", "unit", "code", "mesh n", "value", "limit", "error", "order")
MESH_UNITS = ("", "", "", "parts", "in unit", "in unit", "%", "-")


def write_comparison(path: str | Path, design: str, comparison: Mapping[str, Any]) -> None:
    """Write sheets `comparison` and `meshes`; failed rows are red."""
    with write_whole(path) as temporary, Workbook(str(temporary)) as book:
        book.set_properties({"title": f"Cross-check of {design}", "created": CREATED})
        style = _build_styles(book)
        _write_comparison(book.add_worksheet("comparison"), design, comparison, style)
        _write_meshes(book.add_worksheet("meshes"), comparison, style)


def _build_styles(book: Workbook) -> dict[str, Format]:
    red = {"font_color": "#9C0006", "bg_color": "#FFC7CE"}
    return {
        "title": book.add_format({"bold": True, "font_size": 13}),
        "header": book.add_format({"bold": True, "bottom": 1, "bg_color": "#D9E1F2"}),
        "units": book.add_format({"italic": True, "font_color": "#595959", "bottom": 1}),
        "text": book.add_format({}),
        "number": book.add_format({"num_format": "0.00000"}),
        "percent": book.add_format({"num_format": "0.00"}),
        "small": book.add_format({"num_format": "0.0E+00"}),
        "text_failed": book.add_format(red),
        "number_failed": book.add_format({**red, "num_format": "0.00000"}),
        "percent_failed": book.add_format({**red, "num_format": "0.00"}),
        "small_failed": book.add_format({**red, "num_format": "0.0E+00"}),
    }


def _write_head(
    sheet: Worksheet, row: int, columns: Sequence[str], units: Sequence[str], style: dict
) -> int:
    """Header and units row; returns the first row of data and freezes above it."""
    sheet.write_row(row, 0, columns, style["header"])
    sheet.write_row(row + 1, 0, units, style["units"])
    sheet.freeze_panes(row + 2, 1)
    return row + 2


def _write_comparison(
    sheet: Worksheet, design: str, comparison: Mapping[str, Any], style: dict
) -> None:
    verdict = "passed" if comparison["pass"] else "failed"
    sheet.write(0, 0, f"{design}: cross-check {verdict}", style["title"])
    row = _write_head(sheet, 1, COLUMNS, UNITS, style)
    for name, entry in comparison["quantities"].items():
        end = "" if entry["pass"] else "_failed"
        tight = "small" if entry["tolerance"] < 1e-3 else "percent"
        value = "small" if "imbalance" in name else "number"
        sheet.write(row, 0, name, style["text" + end])
        sheet.write(row, 1, entry["unit"], style["text" + end])
        sheet.write(row, 2, entry["primary"], style[value + end])
        sheet.write(row, 3, entry["independent"], style[value + end])
        sheet.write(row, 4, 100 * entry["relative_difference"], style[tight + end])
        sheet.write(row, 5, 100 * entry["tolerance"], style[tight + end])
        sheet.write(row, 6, "passed" if entry["pass"] else "failed", style["text" + end])
        row += 1
    sheet.set_column(0, 0, 38)
    sheet.set_column(1, 1, 6)
    sheet.set_column(2, 6, 13)


def _write_meshes(sheet: Worksheet, comparison: Mapping[str, Any], style: dict) -> None:
    row = _write_head(sheet, 0, MESH_COLUMNS, MESH_UNITS, style)
    for name, entry in comparison["quantities"].items():
        for code in ("primary", "independent"):
            limit = entry[code]
            for n, value in zip(
                comparison[f"{code}_subdivisions"], entry.get(f"{code}_meshes", []), strict=False
            ):
                error = abs(value - limit) / abs(limit) if limit else 0.0
                sheet.write_row(row, 0, [name, entry["unit"], code, n], style["text"])
                sheet.write_row(row, 4, [value, limit], style["number"])
                order = entry[f"{code}_order"]
                sheet.write_row(row, 6, [100 * error, order or "-"], style["percent"])
                row += 1
    sheet.set_column(0, 0, 38)
    sheet.set_column(1, 3, 12)
    sheet.set_column(4, 7, 13)
