"""Read the thicknesses from a workbook that a person may have edited."""

import re
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.settings.nearest import hint_nearest
from foldshell.sizing.rounding import round_thickness
from foldshell.workbook.cells import Cell, read_cells
from foldshell.workbook.package import open_package
from foldshell.workbook.panels import FloatArray, PanelGrid

SHEET = "thickness"
_NUMBER = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]{1,3})?")
_HEADER_ROWS = 200
# Days since 1900 of the years 2000 to 2099: `3/4` typed into a number cell becomes 46085.
_DATE_SERIALS = range(36526, 73051)
Rows = dict[int, dict[int, Cell]]


def read_thickness(path: str | Path, grid: PanelGrid, least: float, largest: float) -> FloatArray:
    """Return the thickness (P,) in m of every panel, in the order of panel ids.

    Rows are found by the panel's id and columns by their header, so that shuffled rows, inserted
    columns and rows above the header do no harm. Raises `InputError` with sheet, cell, value and
    what is allowed for anything but one number from `least` to `largest` (m) a panel.
    """
    package = open_package(path)
    sheets = package.find_sheets()
    if SHEET not in sheets:
        hint = hint_nearest(SHEET, sheets)
        raise InputError(f"{path}: sheet {SHEET!r} is missing{hint}")
    rows = read_cells(package, SHEET, sheets[SHEET], grid.panel.size)
    place = f"{path}: sheet {SHEET}"
    units = {"panel": "-", **dict.fromkeys(grid.indices, "-"), "thickness": "m"}
    header_row, columns = _find_header(rows, units, place)
    _check_units(rows, header_row, columns, units, place)
    thickness = np.full(grid.panel.size, np.nan)
    seen: dict[int, Cell] = {}
    for row in sorted(row for row in rows if row > header_row + 1):
        cells = {name: rows[row].get(column) for name, column in columns.items()}
        if cells["panel"] is None and cells["thickness"] is None:
            continue
        panel = _read_panel(cells["panel"], row, grid, seen, place)
        _check_indices(cells, panel, grid, place)
        thickness[panel] = _read_value(cells["thickness"], panel, row, least, largest, place)
    missing = np.flatnonzero(np.isnan(thickness))
    if missing.size:
        raise InputError(
            f"{place}: panel {missing[0]}: the row is missing ({missing.size} of {thickness.size} "
            "panels are): one row per panel is due"
        )
    return round_thickness(thickness)


def _find_header(rows: Rows, units: dict[str, str], place: str) -> tuple[int, dict[str, int]]:
    """Return the row whose texts name both a panel and a thickness column, and its columns."""
    for row in sorted(rows)[:_HEADER_ROWS]:
        texts = {
            column: cell.value.strip().casefold()
            for column, cell in rows[row].items()
            if cell.kind == "text"
        }
        if not {"panel", "thickness"} <= set(texts.values()):
            continue
        columns: dict[str, int] = {}
        for column, text in texts.items():
            if text in columns:
                reference = rows[row][column].reference
                raise InputError(f"{place}: cell {reference}: {text!r}: the column stands twice")
            if text in units:
                columns[text] = column
        return row, columns
    raise InputError(f"{place}: no header row: one with the columns 'panel' and 'thickness' is due")


def _check_units(
    rows: Rows, header_row: int, columns: dict[str, int], units: dict[str, str], place: str
) -> None:
    cell = rows.get(header_row + 1, {}).get(columns["thickness"])
    if cell is None or cell.kind != "text":
        raise InputError(
            f"{place}: row {header_row + 1}: the row of units is missing: it stands below the "
            "header, with m for the thickness"
        )
    for name, column in columns.items():
        unit = rows[header_row + 1].get(column)
        text = "" if unit is None else str(unit.value).strip().strip("[]")
        if text != units[name] and (name == "thickness" or text):
            reference = "" if unit is None else f"cell {unit.reference}: "
            raise InputError(
                f"{place}: {reference}{text!r}: the unit {units[name]!r} is due for {name}"
            )


def _read_panel(
    cell: Cell | None, row: int, grid: PanelGrid, seen: dict[int, Cell], place: str
) -> int:
    if cell is None:
        raise InputError(f"{place}: row {row}: a thickness without a panel id: an id is due")
    number = to_number(cell)
    count = grid.panel.size
    if number is None or not 0 <= number < count or number != int(number):
        raise InputError(
            f"{place}: cell {cell.reference}: {_show(cell)}: unknown panel, 0 to {count - 1} "
            "are allowed"
        )
    panel = int(number)
    if panel in seen:
        raise InputError(
            f"{place}: cell {cell.reference}: {panel}: the panel stands twice, first in "
            f"{seen[panel].reference}"
        )
    seen[panel] = cell
    return panel


def _check_indices(cells: dict[str, Cell | None], panel: int, grid: PanelGrid, place: str) -> None:
    """Refuse a row whose indices belong to another panel: a column was moved or sorted alone."""
    for name, index in grid.indices.items():
        cell, due = cells.get(name), int(index[panel])
        if cell is not None and to_number(cell) != due:
            raise InputError(
                f"{place}: cell {cell.reference}: {_show(cell)}: {name} of panel {panel} is {due}"
            )


def _read_value(
    cell: Cell | None, panel: int, row: int, least: float, largest: float, place: str
) -> float:
    allowed = f"a number in m from {least:g} to {largest:g} is allowed"
    if cell is None:
        raise InputError(f"{place}: row {row}: the thickness of panel {panel} is empty: {allowed}")
    number = to_number(cell)
    if number is None or not least * (1 - 1e-12) <= number <= largest * (1 + 1e-12):
        raise InputError(
            f"{place}: cell {cell.reference}: {_show(cell)}: {allowed}"
            + _hint(cell, number, least, largest)
        )
    return min(max(number, least), largest)


def to_number(cell: Cell) -> float | None:
    """Return what a cell says as a number, also one that stands as text; None for anything else."""
    if cell.kind == "number":
        return float(cell.value)
    if cell.kind == "text" and _NUMBER.fullmatch(cell.value.strip()):
        return float(cell.value)
    return None


def _show(cell: Cell) -> str:
    if cell.kind in ("number", "date", "percent") and isinstance(cell.value, float):
        words = {"number": "", "date": "a date, ", "percent": "a percentage, "}
        return f"{words[cell.kind]}{cell.value:.12g}"
    if cell.kind in ("error", "no_value"):
        return f"{'the error ' if cell.kind == 'error' else ''}{cell.value[:60]}"
    return repr(cell.value[:60] if isinstance(cell.value, str) else cell.value)


def _hint(cell: Cell, number: float | None, least: float, largest: float) -> str:
    if number is not None:
        if 1000 * least <= number <= 1000 * largest:
            return f", the value looks like mm: write {number / 1000:.12g}"
        dated = cell.kind == "number" and number in _DATE_SERIALS
        return (
            ", the value looks like a date that the spreadsheet made of the input" if dated else ""
        )
    text = cell.value.strip() if isinstance(cell.value, str) else ""
    if re.fullmatch(r"[0-9]+,[0-9]+", text):
        return f", write {text.replace(',', '.')} with a decimal point"
    with_unit = re.fullmatch(r"([0-9]+(?:\.[0-9]+)?)\s*(mm|cm|m)", text)
    if with_unit:
        metres = float(with_unit[1]) / {"mm": 1000, "cm": 100, "m": 1}[with_unit[2]]
        return f", write {metres:g} without a unit"
    return ""
