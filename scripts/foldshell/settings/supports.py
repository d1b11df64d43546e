"""The table of supports: sets of rows, each of which holds edges or vertices in some way."""

import re
from collections.abc import Mapping
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.files.plain_text import find_unsafe
from foldshell.settings.nearest import hint_nearest
from foldshell.settings.regions import read_numbers
from foldshell.settings.support_row import AXES, SUPPORTS, SupportRow
from foldshell.settings.tables import read_table
from foldshell.settings.where import WHERE_ALLOWED, read_where

SPRINGS = ("spring_x", "spring_y", "spring_z")
COLUMNS = ("set", "name", "where", "fix", "clamp", *SPRINGS)
SOFTEST, STIFFEST = 1e-6, 1e12
_SET = re.compile(r"[a-z0-9][a-z0-9_-]{0,31}")
_ROWS_MAX = 10_000
_NAME_MAX = 60
_YES, _NO = ("yes", "true", "1"), ("", "-", "no", "false", "0")

SupportSets = Mapping[str, tuple[SupportRow, ...]]


def read_support_sets(path: str | Path) -> dict[str, tuple[SupportRow, ...]]:
    """Read a table of supports; return the rows of each set, in their order.

    Raises `InputError` that names the file, the line, the column and what is allowed.
    """
    sets: dict[str, dict[str, SupportRow]] = {}
    for line, cells in read_table(path, COLUMNS, ("set", "name", "where"), _ROWS_MAX):
        place = f"{path}: line {line}"
        name = cells["set"]
        if not _SET.fullmatch(name) or name in SUPPORTS:
            raise InputError(
                f"{place}: set: {name!r}: a word of lower-case letters, digits, - and _ is allowed "
                f"that is none of {', '.join(SUPPORTS)}"
            )
        row = _read_row(cells, place)
        rows = sets.setdefault(name, {})
        if row.name in rows:
            raise InputError(f"{place}: name: {row.name!r}: stands twice in the set {name}")
        rows[row.name] = row
    return {name: tuple(rows.values()) for name, rows in sets.items()}


class SupportFinder:
    """Finds the rows of sets by name; the table is read once, and only where a set is named."""

    def __init__(self, path: str) -> None:
        self._path = path
        self._sets: SupportSets | None = None

    def find(self, name: str, place: str) -> tuple[SupportRow, ...]:
        """Return the rows that a design's support names, none for one of `SUPPORTS`.

        Raises `InputError` for a word that is neither; `place` begins its sentence.
        """
        if name in SUPPORTS:
            return ()
        if self._sets is None:
            self._sets = read_support_sets(self._path) if Path(self._path).exists() else {}
        if name not in self._sets:
            known = [*SUPPORTS, *self._sets]
            raise InputError(
                f"{place}: {name!r}: one of {', '.join(SUPPORTS)} or a set of {self._path} is "
                f"allowed ({', '.join(self._sets) or 'it has none'}){hint_nearest(name, known)}"
            )
        return self._sets[name]


def _read_row(cells: Mapping[str, str], place: str) -> SupportRow:
    name = cells["name"]
    if not 1 <= len(name) <= _NAME_MAX or find_unsafe(name):
        raise InputError(f"{place}: name: {name!a}: plain text of 1 to {_NAME_MAX} characters is "
                         "allowed")  # fmt: skip
    try:
        read_where(cells["where"])
    except ValueError as error:
        raise InputError(
            f"{place}: where: {cells['where']!r}: {error}: {WHERE_ALLOWED} is allowed"
        ) from None
    fix, clamp = _read_fix(cells.get("fix"), place), cells.get("clamp", "").casefold()
    if clamp not in (*_YES, *_NO):
        raise InputError(f"{place}: clamp: {clamp!r}: yes or no is allowed")
    spring = tuple(_read_spring(cells.get(key, ""), f"{place}: {key}") for key in SPRINGS)
    for axis, stiffness in zip(AXES, spring, strict=True):
        if stiffness and axis in fix:
            raise InputError(
                f"{place}: spring_{axis}: {stiffness:g}: {axis} is fixed too: one of both is "
                "allowed"
            )
    if not (fix or clamp in _YES or any(spring)):
        raise InputError(f"{place}: nothing is fixed, clamped or sprung: such a row holds nothing")
    return SupportRow(name, cells["where"], fix, clamp in _YES, spring)


def _read_fix(text: str | None, place: str) -> str:
    """Return the axes that are fixed; a table without the column fixes all, an empty cell none."""
    if text is None:
        return AXES
    found = text.replace(",", "").replace(" ", "")
    if found == "-":
        return ""
    if set(found) - set(AXES) or len(set(found)) < len(found):
        raise InputError(f"{place}: fix: {text!r}: some of x, y, z are allowed, each once, or -")
    return "".join(axis for axis in AXES if axis in found)


def _read_spring(text: str, place: str) -> float:
    if text in ("", "-"):
        return 0.0
    try:
        (value,) = read_numbers(text, 1)
    except ValueError as error:
        raise InputError(f"{place}: {text!r}: {error}: kN/m per m of edge, or kN/m at vertices, is "
                         "allowed") from None  # fmt: skip
    if value != 0 and not SOFTEST <= value <= STIFFEST:
        raise InputError(
            f"{place}: {text}: 0 or {SOFTEST:g} to {STIFFEST:g} kN/m per m of edge, or kN/m at "
            "vertices, is allowed"
        )
    return value
