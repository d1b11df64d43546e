"""What a cell that a person may have edited stands for: a number, or a sentence on what it is."""

import re

from foldshell.files.errors import InputError
from foldshell.workbook.cells import Cell

_NUMBER = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]{1,3})?")
# Days since 1900 of the years 2000 to 2099: `3/4` typed into a number cell becomes 46085.
_DATE_SERIALS = range(36526, 73051)


def read_length(cell: Cell, least: float, largest: float, place: str, other: str = "") -> float:
    """Return a length in m from `least` to `largest`; `other` names what is allowed besides.

    Raises `InputError` with cell, value and what is allowed.
    """
    allowed = f"a number in m from {least:g} to {largest:g}{other} is allowed"
    number = to_number(cell)
    if number is None or not least * (1 - 1e-12) <= number <= largest * (1 + 1e-12):
        raise InputError(
            f"{place}: cell {cell.reference}: {show_cell(cell)}: {allowed}"
            + hint_value(cell, number, least, largest)
        )
    return min(max(number, least), largest)


def to_number(cell: Cell) -> float | None:
    """Return what a cell says as a number, also one that stands as text; None for anything else."""
    if cell.kind == "number":
        return float(cell.value)
    if cell.kind == "text" and _NUMBER.fullmatch(cell.value.strip()):
        return float(cell.value)
    return None


def show_cell(cell: Cell) -> str:
    """Return what a cell holds, for a sentence."""
    if cell.kind in ("number", "date", "percent") and isinstance(cell.value, float):
        words = {"number": "", "date": "a date, ", "percent": "a percentage, "}
        return f"{words[cell.kind]}{cell.value:.12g}"
    if cell.kind in ("error", "no_value"):
        return f"{'the error ' if cell.kind == 'error' else ''}{cell.value[:60]}"
    return repr(cell.value[:60] if isinstance(cell.value, str) else cell.value)


def hint_value(cell: Cell, number: float | None, least: float, largest: float) -> str:
    """Say what was probably meant by a length that is not from `least` to `largest` (m)."""
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
