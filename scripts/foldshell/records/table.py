"""Records in tables: .csv files with one row per record, and rows of cells for workbooks."""

import csv
import typing
from collections.abc import Sequence
from pathlib import Path
from typing import Any, TypeVar

from foldshell.files.errors import InputError
from foldshell.files.whole import atomic_path
from foldshell.records.entry import Entry, entries, strip_null
from foldshell.records.plain import DamageError, from_plain

Record = TypeVar("Record")
ANSWERS = {"yes": True, "no": False}
FORMULA_STARTS = ("=", "+", "@", "\t", "\r")
"""A spreadsheet runs a text of a .csv file that begins so; an apostrophe before it says not to."""
QUOTED = tuple(f"'{start}" for start in FORMULA_STARTS)


def choose_columns(kind: type, rows: Sequence[Any]) -> list[Entry]:
    """Return the columns of a table: `left_out` ones only where some row has a value."""
    return [
        about for about in entries(kind).values()
        if not about.left_out or any(getattr(row, about.attribute) is not None for row in rows)
    ]  # fmt: skip


def list_cells(columns: Sequence[Entry], rows: Sequence[Any]) -> list[list[Any]]:
    """Return the values of each row in the order of the columns."""
    return [[getattr(row, about.attribute) for about in columns] for row in rows]


def write_rows(path: str | Path, kind: type, rows: Sequence[Any]) -> None:
    """Write records as UTF-8 .csv with a header; floats with all their digits, None left empty."""
    columns = choose_columns(kind, rows)
    with (
        atomic_path(path) as temporary,
        temporary.open("w", encoding="utf-8", newline="") as stream,
    ):
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow([about.key for about in columns])
        for cells in list_cells(columns, rows):
            writer.writerow([_show(value) for value in cells])


def read_rows(path: str | Path, kind: type[Record]) -> list[Record]:
    """Read a .csv file as records.

    Raises
    ------
    InputError
        names the file, the row and the column of what cannot be used.
    """
    try:
        with Path(path).open(encoding="utf-8", newline="") as stream:
            rows = list(csv.DictReader(stream, strict=True))
    except FileNotFoundError:
        raise InputError(f"{path}: no such file: start again, it is computed anew") from None
    except (OSError, ValueError, csv.Error):
        raise InputError(f"{path}: cannot be read as a table: delete it and start again") from None
    return [_read_row(path, kind, row, number) for number, row in enumerate(rows, start=1)]


def _read_row(path: str | Path, kind: type[Record], row: dict, number: int) -> Record:
    known = entries(kind)
    try:
        if None in row or None in row.values():
            raise DamageError("has not one cell for each column")
        plain = {key: _parse(known[key], text) if key in known else text
                 for key, text in row.items()}  # fmt: skip
        return from_plain(kind, plain)
    except DamageError as error:
        raise InputError(f"{path}: row {number}: {error}: delete it and start again") from None


def _parse(about: Entry, text: str) -> Any:
    """Return the value of a cell; a text that is no such value stays one and is refused later."""
    kind = _scalar(about.type)
    if kind is str:
        text = text[1:] if text.startswith(QUOTED) else text
        return None if text == "" and not about.required else text
    if text == "":
        return None
    if kind is bool:
        return ANSWERS.get(text, text)
    try:
        return kind(text)
    except ValueError:
        return text


def _scalar(hint: Any) -> type:
    """Return the type of the cells of a column: float, int, bool or str."""
    hint = strip_null(hint)
    return str if typing.get_origin(hint) is typing.Literal else hint


def _show(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return repr(float(value))
    text = str(value)
    return f"'{text}" if isinstance(value, str) and text.startswith(FORMULA_STARTS) else text
