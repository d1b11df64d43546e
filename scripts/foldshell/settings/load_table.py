"""The table of loads: sets of load cases by name, read strictly and checked row by row."""

import re
from collections.abc import Callable, Mapping
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.files.plain_text import find_unsafe
from foldshell.settings.combination_rules import ACTIONS
from foldshell.settings.load_rows import (
    AREAS,
    DIRECTION_ALLOWED,
    KINDS,
    SELF_WEIGHT,
    SETTLEMENT,
    SIGNS,
    TEMPERATURE,
    UNITS,
    VALUE_COLUMNS,
    ZONES_OF_KIND,
    LoadRow,
    default_action,
    read_direction,
)
from foldshell.settings.nearest import hint_nearest
from foldshell.settings.tables import read_table
from foldshell.settings.zones import (
    VARIATION_ALLOWED,
    ZONE_ALLOWED,
    read_number,
    read_variation,
    read_zone,
)

PAPER = "paper"
"""The set whose five cases have the values of the group `loads:` of the settings."""

COLUMNS = ("set", "case", "kind", *VALUE_COLUMNS, "direction", "area", "zone", "variation", "sign",
           "action")  # fmt: skip
SET_NAME = re.compile(r"[a-z0-9][a-z0-9_-]{0,31}")
CASE_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,15}")
LARGEST = 1e6
_ROWS_MAX = 5000

LoadSets = Mapping[str, tuple[LoadRow, ...]]
"""Rows by the name of their set."""


def read_load_sets(path: str | Path) -> LoadSets:
    """Read and check a table of loads: the rows of each set, in their order.

    Raises `InputError` that names file, line, set and case, the column, and what is allowed.
    """
    _require_units(Path(path))
    found: dict[str, list[LoadRow]] = {}
    seen: dict[tuple[str, LoadRow], int] = {}
    for line, cells in read_table(path, COLUMNS, ("set", "case", "kind"), _ROWS_MAX, "load"):
        place = f"{path}: line {line}"
        name = cells["set"]
        if not SET_NAME.fullmatch(name):
            raise InputError(
                f"{place}: set: {name!r}: a name of lower-case letters, digits, - and _, 32 at "
                "most, is allowed"
            )
        if name == PAPER:
            raise InputError(
                f"{place}: set: {name!r}: its values are the keys of the group loads: of the "
                "settings: another name is allowed"
            )
        row = _make_row(cells, f"{place}: set {name!r}")
        if (first := seen.setdefault((name, row), line)) != line:
            raise InputError(
                f"{place}: set {name!r}: case {row.case}: the same load stands in line {first}: "
                "once is allowed"
            )
        found.setdefault(name, []).append(row)
    for name, rows in found.items():
        _check_set(rows, f"{path}: set {name!r}")
    return {name: tuple(rows) for name, rows in found.items()}


def _require_units(path: Path) -> None:
    """Refuse the plain column `value`, which has no unit."""
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError):
        return  # said by the reader of tables
    header = next((one for one in lines if one.strip() and not one.startswith("#")), "")
    for column in (cell.strip(" ") for cell in header.split("\t")):
        if column == "value" or (column.startswith("value") and column not in VALUE_COLUMNS):
            known = ", ".join(f"{name} ({UNITS[kind]})" for name, kind in VALUE_COLUMNS.items())
            raise InputError(
                f"{path}: column {column!r}: a load needs its unit in the header: allowed are "
                f"{known}"
            )


def _make_row(cells: Mapping[str, str], place: str) -> LoadRow:
    case = cells["case"]
    if not CASE_NAME.fullmatch(case):
        raise InputError(
            f"{place}: case: {case!r}: a name of up to 16 letters, digits and _, beginning with a "
            "letter, is allowed"
        )
    where = f"{place}: case {case}"
    for column, text in cells.items():
        if unsafe := find_unsafe(text):
            raise InputError(f"{where}: {column}: {text!a}: {unsafe}: plain text is allowed")
    kind = _choose(cells, "kind", KINDS, "", where)
    direction = _read_direction(cells.get("direction", ""), kind, where)
    row = LoadRow(
        case,
        kind,
        _read_value(cells, kind, where),
        direction,
        _choose(cells, "area", AREAS, AREAS[0], where),
        _read_text(cells, "zone", read_zone, ZONE_ALLOWED, where) or "all",
        _read_text(cells, "variation", read_variation, VARIATION_ALLOWED, where),
        _choose(cells, "sign", SIGNS, SIGNS[0], where),
        _choose(cells, "action", ACTIONS, default_action(case, kind), where),
    )
    _check_row(row, where)
    return row


def _choose(
    cells: Mapping[str, str], column: str, known: tuple[str, ...], default: str, where: str
) -> str:
    text = cells.get(column, "") or default
    if text in known:
        return text
    raise InputError(
        f"{where}: {column}: {text!r}: one of {', '.join(known)} is allowed"
        + hint_nearest(text.casefold(), known)
    )


def _read_value(cells: Mapping[str, str], kind: str, where: str) -> float | None:
    column = next(name for name, own in VALUE_COLUMNS.items() if own == kind)
    for other in VALUE_COLUMNS:
        if other != column and cells.get(other):
            raise InputError(
                f"{where}: {other}: {cells[other]!r}: a load of the kind {kind} has its value in "
                f"the column {column}: an empty cell is allowed here"
            )
    text = cells.get(column, "")
    if not text:
        if kind == SELF_WEIGHT:
            return None
        raise InputError(f"{where}: {column}: the cell is empty: a number in {UNITS[kind]} is due")
    try:
        value = read_number(text)
    except ValueError:
        value = LARGEST + 1
    if abs(value) > LARGEST:
        raise InputError(
            f"{where}: {column}: {text!r}: a number in {UNITS[kind]} from -1e6 to 1e6 is allowed, "
            "written plainly, without unit"
        )
    if value == 0:
        raise InputError(f"{where}: {column}: 0 loads nothing: a number other than 0 is allowed")
    return value


def _read_direction(text: str, kind: str, where: str) -> str:
    if kind == SELF_WEIGHT and text in ("", "-z"):
        return "-z"
    if kind == TEMPERATURE:
        if text in ("", "normal"):
            return text
        raise InputError(
            f"{where}: direction: {text!r}: empty for the mean temperature, or normal for the "
            "upper side less the lower one, is allowed"
        )
    if not text:
        raise InputError(f"{where}: direction: the cell is empty: {DIRECTION_ALLOWED} is due")
    if kind == SELF_WEIGHT:
        raise InputError(f"{where}: direction: {text!r}: -z or an empty cell is allowed")
    try:
        axis = read_direction(text)
    except ValueError as error:
        raise InputError(f"{where}: direction: {error}: {DIRECTION_ALLOWED} is allowed") from None
    if kind == SETTLEMENT and axis is None:
        raise InputError(f"{where}: direction: {text!r}: an axis or a vector is allowed")
    return text


def _read_text(
    cells: Mapping[str, str], column: str, read: Callable[[str], object], allowed: str, where: str
) -> str:
    text = " ".join(cells.get(column, "").split())
    try:
        read(text)
    except ValueError as error:
        raise InputError(f"{where}: {column}: {text!r}: {error}: {allowed} is allowed") from None
    return text


def _check_row(row: LoadRow, where: str) -> None:
    zone = read_zone(row.zone).kind
    known = ZONES_OF_KIND[row.kind]
    if zone not in known:
        words = ", ".join("box, polygon" if one == "region" else one for one in known)
        raise InputError(
            f"{where}: zone: {row.zone!r}: for a load of the kind {row.kind} {words} is allowed"
        )
    spread = row.kind == "pressure" or (row.kind == "force" and zone != "point")
    if row.area != AREAS[0] and not spread:
        raise InputError(
            f"{where}: area: {row.area!r}: only a load over an area refers to one: an empty cell "
            "is allowed"
        )
    if row.variation and row.kind != "pressure":
        raise InputError(
            f"{where}: variation: {row.variation!r}: only a pressure varies: an empty cell is "
            "allowed"
        )


def _check_set(rows: list[LoadRow], place: str) -> None:
    """Check that rows of one case agree on its action, and that names differ by more than case."""
    names: dict[str, LoadRow] = {}
    for row in rows:
        first = names.setdefault(row.case.casefold(), row)
        if first.case != row.case:
            raise InputError(
                f"{place}: case {row.case} differs from {first.case} in case alone: names that "
                "differ by more are allowed"
            )
        if first.action != row.action:
            raise InputError(
                f"{place}: case {row.case}: action: {first.action} and {row.action}: one for all "
                "loads of a case is allowed"
            )
