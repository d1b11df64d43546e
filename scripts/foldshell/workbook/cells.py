"""Read the cells of one worksheet with all that tells a typed number from something else.

A cell's formula, its cached value, its error and its number format are needed in one pass:
openpyxl shows formulas or values but not both, python-calamine no formulas at all, and neither
bounds its memory. So the sheet's XML is streamed here, and tests compare with both libraries.
"""

import math
import re
from collections.abc import Iterator
from typing import Any, NamedTuple
from xml.parsers import expat

from foldshell.files.errors import InputError
from foldshell.workbook.package import Package

MOST_ROWS, MOST_COLUMNS = 20_000, 64
_CELLS_A_ROW, _BYTES_A_ROW = 20, 1000
_SPARE_ROWS = 200
_REFERENCE = re.compile(r"([A-Z]{1,3})([1-9][0-9]{0,6})")
_NUMBER = re.compile(
    r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?|[-+]?(nan|inf)", re.IGNORECASE
)
_BUILT_IN_DATES = {*range(14, 23), *range(27, 37), *range(45, 48), *range(50, 59)}
_BUILT_IN_PERCENT = {9, 10}
# What is not a placeholder in a number format: quoted text, escapes, [colours], fill characters.
_LITERALS = re.compile(r'"[^"]*"|\\.|_.|\*.|\[(?!h|m|s)[^\]]*\]', re.IGNORECASE)


class Cell(NamedTuple):
    """One cell: `kind` is number, text, boolean, date, percent, error or no_value (a formula)."""

    row: int
    column: int
    kind: str
    value: Any

    @property
    def reference(self) -> str:
        """Name of the cell, such as D7."""
        return f"{name_column(self.column)}{self.row}"


def name_column(column: int) -> str:
    """Return A for 1, Z for 26, AA for 27."""
    name = ""
    while column:
        column, rest = divmod(column - 1, 26)
        name = chr(65 + rest) + name
    return name


def read_cells(package: Package, sheet: str, part: str, rows: int) -> dict[int, dict[int, Cell]]:
    """Return the filled cells of a worksheet as {row: {column: cell}}, both counted from 1.

    `rows` is the number of rows that the table should have: it bounds what is read. Raises
    `InputError` for damaged XML, a cell far outside of any table, or one that stands twice.
    """
    place = f"{package.path}: sheet {sheet}"
    bound = rows + _SPARE_ROWS
    text = package.read_part(part, _BYTES_A_ROW * bound)
    kinds, strings = _read_number_kinds(package), _read_shared_strings(package)
    stream = _SheetStream(place, kinds, strings, _CELLS_A_ROW * bound)
    try:
        stream.parse(text)
    except expat.ExpatError as error:
        raise InputError(f"{place}: damaged XML ({error})") from None
    return stream.rows


class _SheetStream:
    """Collects cells from the events of an XML parser."""

    def __init__(self, place: str, kinds: list[str], strings: list[str], most: int) -> None:
        self.rows: dict[int, dict[int, Cell]] = {}
        self._place, self._kinds, self._strings, self._most = place, kinds, strings, most
        self._row = self._column = self._count = 0
        self._attributes: dict[str, str] = {}
        self._text: list[str] | None = None
        self._value: str | None = None
        self._formula = False

    def parse(self, text: str) -> None:
        """Feed the whole XML text of a worksheet."""
        parser = expat.ParserCreate("utf-8", namespace_separator=" ")
        parser.buffer_text = True
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._characters
        parser.Parse(text.encode(), True)

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        tag = name[name.rfind(" ") + 1 :]
        if tag == "c":
            self._attributes, self._value, self._formula = attributes, None, False
            self._locate(attributes.get("r"))
        elif tag in ("v", "t"):
            self._text = []
        elif tag == "f":
            self._formula = True
        elif tag == "row":
            self._row = _parse_integer(attributes.get("r"), self._row + 1)
            self._column = 0

    def _locate(self, reference: str | None) -> None:
        self._count += 1
        if self._count > self._most:
            raise InputError(f"{self._place}: more than {self._most} cells: a table is allowed")
        if reference is None:
            self._column += 1
            return
        match = _REFERENCE.fullmatch(reference)
        if match is None:
            raise InputError(f"{self._place}: cell {reference!r}: not the name of a cell")
        letters, row = match.groups()
        self._row, self._column = int(row), 0
        for letter in letters:
            self._column = 26 * self._column + ord(letter) - 64

    def _characters(self, text: str) -> None:
        if self._text is not None:
            self._text.append(text)

    def _end(self, name: str) -> None:
        tag = name[name.rfind(" ") + 1 :]
        if tag == "c":
            if self._value is not None or self._formula:
                self._finish()
        elif tag in ("v", "t") and self._text is not None:
            self._value = (self._value or "") + "".join(self._text)
            self._text = None

    def _finish(self) -> None:
        kind, value = self._interpret()
        if kind == "text" and not value.strip():
            return
        cell = Cell(self._row, self._column, kind, value)
        if self._row > MOST_ROWS or self._column > MOST_COLUMNS:
            raise InputError(
                f"{self._place}: cell {cell.reference}: a value far outside of the table, "
                f"{name_column(MOST_COLUMNS)}{MOST_ROWS} is the last cell allowed"
            )
        row = self.rows.setdefault(self._row, {})
        if self._column in row:
            raise InputError(f"{self._place}: cell {cell.reference}: stands twice in the file")
        row[self._column] = cell

    def _interpret(self) -> tuple[str, Any]:
        kind, text = self._attributes.get("t", "n"), self._value
        if text is None or (self._formula and not text and kind != "str"):
            return "no_value", "a formula without a value"
        if kind == "s":
            index = _parse_integer(text, -1)
            if not 0 <= index < len(self._strings):
                raise InputError(f"{self._place}: shared text {text!r} is missing: damaged")
            return "text", self._strings[index]
        if kind in ("str", "inlineStr"):
            return "text", text
        if kind == "b":
            return "boolean", text.strip() == "1"
        if kind in ("e", "d"):
            return ("error" if kind == "e" else "date"), text
        style = _parse_integer(self._attributes.get("s"), 0)
        shown_as = self._kinds[style] if 0 <= style < len(self._kinds) else "number"
        return _interpret_number(text, shown_as)


def _interpret_number(text: str, shown_as: str) -> tuple[str, Any]:
    if not _NUMBER.fullmatch(text.strip(" \t\r\n")):
        return "text", text
    number = float(text)
    return (shown_as, number) if math.isfinite(number) else ("error", text)


def _parse_integer(text: str | None, default: int) -> int:
    plain = text is not None and len(text) < 10 and text.isascii() and text.isdigit()
    return int(text) if plain else default


def _read_shared_strings(package: Package) -> list[str]:
    name = "xl/sharedStrings.xml"
    if name not in package.names():
        return []
    return ["".join(_iterate_text(item)) for item in package.parse_part(name)]


def _iterate_text(item: Any) -> Iterator[str]:
    """Yield the runs of a shared text, without phonetic readings."""
    for child in item:
        tag = child.tag.rpartition("}")[2]
        parts = child if tag == "r" else [child]
        for part in parts:
            if part.tag.rpartition("}")[2] == "t":
                yield part.text or ""


def _read_number_kinds(package: Package) -> list[str]:
    """Return number, date or percent for each cell style, by its number format."""
    if "xl/styles.xml" not in package.names():
        return []
    root = package.parse_part("xl/styles.xml")
    codes: dict[int, str] = {}
    kinds: list[str] = []
    for group in root:
        tag = group.tag.rpartition("}")[2]
        if tag == "numFmts":
            for item in group:
                codes[_parse_integer(item.get("numFmtId"), -1)] = item.get("formatCode", "")
        elif tag == "cellXfs":
            kinds = [_classify(_parse_integer(item.get("numFmtId"), 0), codes) for item in group]
    return kinds


def _classify(format_id: int, codes: dict[int, str]) -> str:
    if format_id not in codes:
        if format_id in _BUILT_IN_DATES:
            return "date"
        return "percent" if format_id in _BUILT_IN_PERCENT else "number"
    code = codes[format_id].partition(";")[0]
    if code.casefold() in ("general", "standard"):
        return "number"
    placeholders = _LITERALS.sub("", code)
    if "%" in placeholders:
        return "percent"
    return "date" if re.search(r"[ymdhs]", placeholders, re.IGNORECASE) else "number"
