"""Read the thicknesses from a workbook that a person may have edited."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.settings.nearest import hint_nearest
from foldshell.settings.sizing import Sizing
from foldshell.sizing.panel_limits import PanelLimits, find_conflict, hold_limits
from foldshell.sizing.rounding import round_thickness
from foldshell.workbook.cell_values import read_length, show_cell, to_number
from foldshell.workbook.cells import Cell, read_cells
from foldshell.workbook.package import open_package
from foldshell.workbook.panels import FloatArray, PanelGrid
from foldshell.workbook.read_limits import LIMIT_UNITS, read_limits

SHEET = "thickness"
_HEADER_ROWS = 200
Rows = dict[int, dict[int, Cell]]


@dataclass(frozen=True)
class PanelInput:
    """Thickness (P,) m to be analysed, and what is asked of panels, None for nothing."""

    thickness: FloatArray
    limits: PanelLimits | None


def read_panel_input(path: str | Path, grid: PanelGrid, sizing: Sizing) -> PanelInput:
    """Return thickness and limits of every panel; the thickness within the limits.

    A panel outside of its own bounds is taken at the bound, a group at its largest thickness.
    Raises `InputError` as `read_thickness`, and for limits that contradict each other.
    """
    place, rows, first, columns = _open_table(path, grid)
    thickness = _read_column(rows, first, columns, grid, sizing.bounds, place)
    limits = read_limits(_find_rows(rows, first, columns), columns, grid.panel.size, sizing, place)
    if limits is None:
        return PanelInput(thickness, None)
    words = find_conflict(limits, thickness, *sizing.bounds)
    if words:
        raise InputError(f"{place}: {words}")
    return PanelInput(round_thickness(hold_limits(limits, thickness, *sizing.bounds)), limits)


def read_thickness(path: str | Path, grid: PanelGrid, least: float, largest: float) -> FloatArray:
    """Return the thickness (P,) in m of every panel as it is written, in the order of panel ids.

    Rows are found by the panel's id and columns by their header, so that shuffled rows, inserted
    columns and rows above the header do no harm. Raises `InputError` with sheet, cell, value and
    what is allowed for anything but one number from `least` to `largest` (m) a panel.
    """
    place, rows, first, columns = _open_table(path, grid)
    return _read_column(rows, first, columns, grid, (least, largest), place)


def _open_table(path: str | Path, grid: PanelGrid) -> tuple[str, Rows, int, dict[str, int]]:
    """Return the place in words, all cells, the row of the header and the columns by name."""
    package = open_package(path)
    sheets = package.find_sheets()
    if SHEET not in sheets:
        hint = hint_nearest(SHEET, sheets)
        raise InputError(f"{path}: sheet {SHEET!r} is missing{hint}")
    rows = read_cells(package, SHEET, sheets[SHEET], grid.panel.size)
    place = f"{path}: sheet {SHEET}"
    units = {"panel": "-", **dict.fromkeys(grid.indices, "-"), "thickness": "m", **LIMIT_UNITS}
    header_row, columns = _find_header(rows, units, place)
    _check_units(rows, header_row, columns, units, place)
    return place, rows, header_row, columns


def _read_column(
    rows: Rows,
    header_row: int,
    columns: dict[str, int],
    grid: PanelGrid,
    bounds: tuple[float, float],
    place: str,
) -> FloatArray:
    thickness = np.full(grid.panel.size, np.nan)
    seen: dict[int, Cell] = {}
    for row in sorted(row for row in rows if row > header_row + 1):
        cells = {name: rows[row].get(column) for name, column in columns.items()}
        if cells["panel"] is None and cells["thickness"] is None:
            continue
        panel = _read_panel(cells["panel"], row, grid, seen, place)
        _check_indices(cells, panel, grid, place)
        thickness[panel] = _read_value(cells["thickness"], panel, row, *bounds, place)
    missing = np.flatnonzero(np.isnan(thickness))
    if missing.size:
        raise InputError(
            f"{place}: panel {missing[0]}: the row is missing ({missing.size} of {thickness.size} "
            "panels are): one row per panel is due"
        )
    return round_thickness(thickness)


def _find_rows(rows: Rows, header_row: int, columns: dict[str, int]) -> dict[int, dict[int, Cell]]:
    """Return the cells of each panel's row by column; the ids have been read before."""
    found = {}
    for row in rows:
        cell = rows[row].get(columns["panel"])
        if row > header_row + 1 and cell is not None:
            found[int(to_number(cell))] = rows[row]
    return found


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
            f"{place}: cell {cell.reference}: {show_cell(cell)}: unknown panel, 0 to {count - 1} "
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
                f"{place}: cell {cell.reference}: {show_cell(cell)}: {name} of panel {panel} is "
                f"{due}"
            )


def _read_value(
    cell: Cell | None, panel: int, row: int, least: float, largest: float, place: str
) -> float:
    if cell is None:
        raise InputError(
            f"{place}: row {row}: the thickness of panel {panel} is empty: a number in m from "
            f"{least:g} to {largest:g} is allowed"
        )
    return read_length(cell, least, largest, place)
