"""Records in JSON files: read whole and checked, or one sentence that says what is wrong."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from foldshell.files.errors import InputError
from foldshell.files.whole import SECONDS, read_json, write_json
from foldshell.records.entry import entry
from foldshell.records.plain import DamageError, from_plain, to_plain

Record = TypeVar("Record")


@dataclass(frozen=True, kw_only=True)
class TimeRecord:
    """The contents of seconds.json: how long the file beside it took to compute."""

    elapsed: float = entry("wall time", "s", key="seconds")


REMEDY = "delete this file and start again, it is computed anew"


def read_record(path: str | Path, kind: type[Record], closed: bool = True) -> Record:
    """Read a JSON file as a record; `closed` refuses keys that the record does not know.

    Raises
    ------
    InputError
        for a file that is missing, is no JSON, or holds something else under some key.
    """
    try:
        return from_plain(kind, _read(path), closed)
    except DamageError as error:
        raise InputError(f"{path}: {error}: {REMEDY}") from None


def read_records(path: str | Path, kind: type[Record]) -> list[Record]:
    """Read a JSON file that holds a list of records; errors as `read_record`."""
    data = _read(path)
    if not isinstance(data, list):
        raise InputError(f"{path}: must hold a list: {REMEDY}")
    found = []
    for number, item in enumerate(data):
        try:
            found.append(from_plain(kind, item))
        except DamageError as error:
            raise InputError(f"{path}: [{number}].{error}: {REMEDY}") from None
    return found


def write_record(path: str | Path, record: Any) -> None:
    """Write a record as JSON, whole or not at all.

    Seconds of one that was computed now stand in seconds.json beside it. The record comes last,
    since jobs wait for it.
    """
    if getattr(record, "seconds", None) is not None:
        apart = TimeRecord(elapsed=record.seconds)
        write_json(Path(path).with_name(SECONDS), to_plain(apart))
    write_json(path, to_plain(record))


def write_records(path: str | Path, records: Sequence[Any]) -> None:
    """Write records as a JSON list, whole or not at all."""
    write_json(path, [to_plain(record) for record in records])


def _read(path: str | Path) -> Any:
    try:
        return read_json(path)
    except FileNotFoundError:
        raise InputError(f"{path}: no such file: start again, it is computed anew") from None
    except (OSError, ValueError, RecursionError):
        raise InputError(f"{path}: cannot be read as JSON: {REMEDY}") from None
