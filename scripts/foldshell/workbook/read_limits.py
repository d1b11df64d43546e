"""The columns of thickness.xlsx in which a person asks something of single panels."""

from collections.abc import Mapping

from foldshell.files.errors import InputError
from foldshell.settings.sizing import Sizing
from foldshell.sizing.panel_limits import PanelLimits, no_limits
from foldshell.workbook.cell_values import read_length, show_cell, to_number
from foldshell.workbook.cells import Cell

LIMIT_UNITS = {"fixed": "-", "least": "m", "largest": "m", "group": "-"}
"""Columns and their units; each may be missing, and each cell may be empty."""

GROUP_MAX = 9999
_YES, _NO = ("yes", "true", "x", "1"), ("no", "false", "0")


def read_limits(
    rows: Mapping[int, Mapping[int, Cell]],
    columns: Mapping[str, int],
    count: int,
    sizing: Sizing,
    place: str,
) -> PanelLimits | None:
    """Return the limits of so many panels, None where nothing is asked for.

    `rows` are the cells of each panel by column, `columns` the columns by name. Raises `InputError`
    with cell, value and what is allowed.
    """
    limits = no_limits(count)
    for panel, row in rows.items():
        cells = {name: row.get(columns[name]) for name in LIMIT_UNITS if name in columns}
        cells = {name: cell for name, cell in cells.items() if _is_filled(cell)}
        if "fixed" in cells:
            limits.fixed[panel] = _read_answer(cells["fixed"], place)
        for name, values in (("least", limits.least), ("largest", limits.largest)):
            if name in cells:
                other = " or an empty cell"
                values[panel] = read_length(cells[name], *sizing.bounds, place, other)
        if "group" in cells:
            limits.group[panel] = _read_group(cells["group"], place)
    return limits if limits.given else None


def _is_filled(cell: Cell | None) -> bool:
    return cell is not None and not (isinstance(cell.value, str) and not cell.value.strip())


def _read_answer(cell: Cell, place: str) -> bool:
    value = cell.value
    word = f"{value:g}" if isinstance(value, float) else str(value).strip().casefold()
    if word not in (*_YES, *_NO):
        raise InputError(
            f"{place}: cell {cell.reference}: {show_cell(cell)}: yes, no or an empty cell is "
            "allowed for fixed"
        )
    return word in _YES


def _read_group(cell: Cell, place: str) -> int:
    number = to_number(cell)
    if number is None or number != int(number) or not 1 <= number <= GROUP_MAX:
        raise InputError(
            f"{place}: cell {cell.reference}: {show_cell(cell)}: a whole number from 1 to "
            f"{GROUP_MAX} or an empty cell is allowed for a group"
        )
    return int(number)
