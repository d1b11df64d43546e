"""What a thickness workbook holds, whoever wrote it: for telling an edit from damage."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from foldshell.workbook.cells import MOST_ROWS, Cell, read_cells
from foldshell.workbook.package import Package, open_package

_SUMMARY_ROWS = 60


@dataclass(frozen=True)
class Peek:
    """Cells of the column `thickness` by panel as they stand there (None where one is empty), and
    whose workbook it is (design and iteration of its summary; None where they are missing)."""

    cells: dict[Any, Cell | None]
    design: Any
    iteration: Any

    @property
    def thickness(self) -> dict[Any, Any]:
        """Values of these cells."""
        return {panel: _value(cell) for panel, cell in self.cells.items()}


def peek_thickness(path: str | Path) -> Peek:
    """Read a thickness workbook without judging its values.

    Raises
    ------
    InputError
        for a file that is no workbook, or one that cannot be opened.
    """
    package = open_package(path)
    sheets = package.find_sheets()
    rows = _rows(package, sheets, "thickness", MOST_ROWS)
    header = next((row for row in sorted(rows) if _texts(rows[row]) >= {"panel", "thickness"}), 0)
    places = {
        str(cell.value).strip().casefold(): cell.column for cell in rows.get(header, {}).values()
    }
    found = {}
    for row in sorted(rows):
        if header and row > header + 1:
            panel, value = (rows[row].get(places[name]) for name in ("panel", "thickness"))
            found[_value(panel)] = value
    summary = _rows(package, sheets, "summary", _SUMMARY_ROWS)
    pairs = {
        str(_value(cells.get(1))).casefold(): _value(cells.get(2)) for cells in summary.values()
    }
    return Peek(found, pairs.get("design"), pairs.get("iteration"))


def _rows(
    package: Package, sheets: dict[str, str], name: str, most: int
) -> dict[int, dict[int, Cell]]:
    return read_cells(package, name, sheets[name], most) if name in sheets else {}


def _texts(cells: dict[int, Cell]) -> set[str]:
    return {cell.value.strip().casefold() for cell in cells.values() if cell.kind == "text"}


def _value(cell: Cell | None) -> Any:
    return None if cell is None else cell.value
