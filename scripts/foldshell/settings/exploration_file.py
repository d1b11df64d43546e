"""The file of an exploration: read strictly, with a sentence for what is not allowed."""

import math
import re
from collections.abc import Mapping
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.settings.check import Reader
from foldshell.settings.config_file import read_config
from foldshell.settings.design import Design, DesignColumns, leave_out_names
from foldshell.settings.exploration import (
    AIMS,
    DerivedColumns,
    Exploration,
    Search,
    SearchLimits,
    Variable,
)
from foldshell.settings.field import Plain, Setting, list_settings
from foldshell.settings.nearest import hint_nearest

NAME = re.compile(r"[a-z0-9][a-z0-9_-]{0,63}")
VARIABLES_MAX = 12
FIXED = ("loads", "file_unit")
"""Columns that are the same for all candidates."""


def read_exploration(path: str | Path, defaults: DesignColumns) -> Exploration:
    """Read and check a file of an exploration; its name is that of the file.

    Raises
    ------
    InputError
        for anything that is not as config/explorations/README.md says.
    """
    path = Path(path)
    if not NAME.fullmatch(path.stem):
        raise InputError(
            f"{path}: a name of lower-case letters, digits, - and _ is due, as for designs"
        )
    data = read_config(path)
    known = {"base", "variables", "aims", "limits", "search"}
    for key in data:
        if key not in known:
            hint = hint_nearest(str(key), known) or f", allowed are {', '.join(sorted(known))}"
            raise InputError(f"{path}: {key}: unknown key{hint}")
    reader = Reader(str(path))
    base = _read_base(reader, data.get("base", {}))
    variables = _read_variables(reader, data.get("variables"))
    return Exploration(
        path.stem,
        _complete(base, defaults),
        variables,
        _read_aims(reader, data.get("aims", ["volume_m3"])),
        reader.read_group(SearchLimits, data.get("limits", {}), "limits"),
        reader.read_group(Search, data.get("search", {}), "search"),
    )


def _complete(base: Plain, defaults: DesignColumns) -> Plain:
    return leave_out_names(Design(name="base", **vars(defaults)).to_row()) | base


def _columns() -> dict[str, Setting]:
    return {known.key: known for known in list_settings(DesignColumns).values()}


def _variables() -> dict[str, Setting]:
    return _columns() | {known.key: known for known in list_settings(DerivedColumns).values()}


def _find_column(reader: Reader, name: str, place: str, columns: Mapping[str, Setting]) -> Setting:
    if name not in columns:
        hint = hint_nearest(name, columns) or f", columns are {', '.join(columns)}"
        raise InputError(f"{reader.source}: {place}.{name}: unknown column of designs{hint}")
    return columns[name]


def _read_base(reader: Reader, data: object) -> Plain:
    if not isinstance(data, Mapping):
        raise reader.refuse("base", data, "a group of columns with values")
    columns, found = _columns(), {}
    for name, value in data.items():
        known = _find_column(reader, str(name), "base", columns)
        found[name] = reader.read_value(known, value, f"base.{name}")
    return found


def _read_variables(reader: Reader, data: object) -> tuple[Variable, ...]:
    if not isinstance(data, Mapping) or not 1 <= len(data) <= VARIABLES_MAX:
        raise reader.refuse(
            "variables", data, f"1 to {VARIABLES_MAX} columns of designs, each with [least, most]"
        )
    for name in FIXED:
        if name in data:
            raise InputError(
                f"{reader.source}: variables.{name}: does not vary: one value holds for a search, "
                "give it under base"
            )
    return tuple(_read_variable(reader, str(name), value) for name, value in data.items())


def _read_variable(reader: Reader, name: str, value: object) -> Variable:
    place = f"variables.{name}"
    known = _find_column(reader, name, "variables", _variables())
    if not isinstance(value, list) or len(value) < 2:
        raise reader.refuse(place, value, "a list of [least, most], or of words to choose from,")
    given = [reader.read_value(known, item, place) for item in value]
    if known.kind is str:
        if len(set(given)) < len(given):
            raise reader.refuse(place, value, "a list of words, each once,")
        return Variable(name, choices=tuple(given))
    if len(given) != 2 or not float(given[0]) < float(given[1]):
        raise reader.refuse(place, value, "a list of [least, most], the least first,")
    if any(not math.isfinite(float(item)) for item in given):
        raise reader.refuse(place, value, "a list of two finite numbers")
    low, high = float(given[0]), float(given[1])
    if known.ranges and not any(least <= low and high <= most for least, most in known.ranges):
        words = " or ".join(f"{least:g} to {most:g}" for least, most in known.ranges)
        raise reader.refuse(place, value, f"a range within {words} (0 stands for none)")
    return Variable(name, low, high, known.kind is int)


def _read_aims(reader: Reader, data: object) -> tuple[str, ...]:
    words = ", ".join(AIMS)
    if not isinstance(data, list) or len(data) not in (1, 2) or data[1:] == data[:1]:
        raise reader.refuse("aims", data, f"a list of one or two of {words}")
    for aim in data:
        if aim not in AIMS:
            hint = hint_nearest(str(aim), AIMS) or f", allowed are {words}"
            raise InputError(f"{reader.source}: aims: {aim!r}: no design has this value{hint}")
    return tuple(data)
