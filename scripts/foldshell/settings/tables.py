"""Tables of text with tabs between cells: a header, then one row a line; read strictly."""

import csv
import io
from collections.abc import Iterator, Sequence
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.settings.config_file import read_text
from foldshell.settings.nearest import hint_nearest


def read_table(
    path: str | Path,
    columns: Sequence[str],
    required: Sequence[str],
    rows_max: int,
    word: str = "row",
) -> Iterator[tuple[int, dict[str, str]]]:
    """Yield the number of each line below the header and its cells by column.

    Lines that are empty or begin with # are left out. `word` is what a row is called. Raises
    `InputError` for a table without rows, a column that is unknown, missing or there twice, and a
    row with more or fewer cells than the header.
    """
    lines = [
        (number, line)
        for number, line in enumerate(io.StringIO(read_text(path), newline=None), start=1)
        if line.strip() and not line.startswith("#")
    ]
    if not lines:
        raise InputError(f"{path}: the table is empty: a header and one line per {word} are due")
    number, text = lines[0]
    header = _split(text)
    _check_header(header, columns, required, f"{path}: line {number}")
    if len(lines) == 1:
        raise InputError(f"{path}: no {word} stands below the header: one line per {word} is due")
    if len(lines) - 1 > rows_max:
        raise InputError(f"{path}: {len(lines) - 1} {word}s: at most {rows_max} are allowed")
    for number, line in lines[1:]:
        cells = _split(line)
        if len(cells) != len(header):
            raise InputError(
                f"{path}: line {number}: {len(cells)} cells: {len(header)} are allowed, as many as "
                "the header has, with one tab between two"
            )
        yield number, dict(zip(header, cells, strict=True))


def _split(line: str) -> list[str]:
    cells = next(csv.reader([line.rstrip("\r\n")], delimiter="\t", quoting=csv.QUOTE_NONE))
    return [cell.strip(" ") for cell in cells]


def _check_header(
    header: list[str], columns: Sequence[str], required: Sequence[str], place: str
) -> None:
    if len(header) == 1 and header[0] not in columns:
        raise InputError(f"{place}: {header[0][:60]!r}: column names with tabs between are allowed")
    for index, column in enumerate(header):
        if column not in columns:
            hint = hint_nearest(column, columns) or f", allowed are {', '.join(columns)}"
            raise InputError(f"{place}: column {index + 1}: {column!r}: unknown column{hint}")
        if column in header[:index]:
            raise InputError(f"{place}: column {index + 1}: {column!r}: the column stands twice")
    for column in required:
        if column not in header:
            raise InputError(f"{place}: the column {column!r} is missing")
