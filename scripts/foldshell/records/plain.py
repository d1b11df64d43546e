"""Between records and plain data: every value is checked against the type of its field."""

import dataclasses
import math
import sys
import typing
from collections.abc import Mapping
from typing import Any, TypeVar

from foldshell.files.whole import Json
from foldshell.records.entry import Entry, entries, strip_null
from foldshell.settings.nearest import hint_nearest

Record = TypeVar("Record")
PLAIN = {float, int, str, bool, type(None)}
"""Types whose values are plain data already."""
WORDS = {float: "a number", int: "a whole number", str: "a text", bool: "true or false"}


class DamageError(ValueError):
    """Plain data that are no such record: the key and what is allowed there."""


def from_plain(kind: type[Record], data: Any, closed: bool = True) -> Record:
    """Return the record that plain data hold.

    `closed` refuses keys that the record does not know.

    Raises
    ------
    DamageError
        names the first key that is missing, unknown or of another type.
    """
    return _to_record(kind, data, "", closed)


def to_plain(record: Any) -> Json:
    """Return a record as plain data by key; `left_out` fields that are None are left out."""
    plain = {}
    for key, about in entries(type(record)).items():
        value = getattr(record, about.attribute)
        if value is not None or not about.left_out:
            plain[key] = _to_value(value)
    return plain


def _to_value(value: Any) -> Any:
    if dataclasses.is_dataclass(value):
        return to_plain(value)
    if isinstance(value, Mapping):
        return {key: _to_value(item) for key, item in value.items()}
    if isinstance(value, tuple | list):
        # long lists of numbers are the rule: they hold nothing to turn
        return list(value) if set(map(type, value)) <= PLAIN else [_to_value(one) for one in value]
    return value


def _to_record(kind: type, data: Any, place: str, closed: bool) -> Any:
    if not isinstance(data, Mapping):
        raise DamageError(f"{place or 'content'}: {_shorten(data)}: must be names with values")
    known = entries(kind)
    if closed and (unknown := [key for key in data if key not in known]):
        hint = hint_nearest(str(unknown[0]), known)
        raise DamageError(f"{_join(place, unknown[0])}: is not known{hint}")
    values = {}
    for key, about in known.items():
        if key in data:
            values[about.attribute] = _check(about.type, data[key], _join(place, key), closed)
        elif about.required:
            raise DamageError(f"{_join(place, key)}: is missing")
    return kind(**values)


def _check(hint: Any, value: Any, place: str, closed: bool) -> Any:
    """Return a value as its annotation wants it: lists become tuples, whole numbers floats."""
    origin, inner = typing.get_origin(hint), typing.get_args(hint)
    if (needed := strip_null(hint)) is not hint:
        return None if value is None else _check(needed, value, place, closed)
    if origin is typing.Literal:
        if value not in inner:
            allowed = ", ".join(map(str, inner))
            raise DamageError(f"{place}: {_shorten(value)}: must be one of {allowed}")
        return value
    if dataclasses.is_dataclass(hint):
        return _to_record(hint, value, place, closed)
    if origin is tuple:
        return _check_list(inner, value, place, closed)
    if origin in (dict, Mapping):
        return _check_names(inner[1], value, place, closed)
    return _check_scalar(hint, value, place)


def _check_scalar(hint: type, value: Any, place: str) -> Any:
    if hint is Any:
        return value
    if hint is float and _is_finite(value):
        return float(value)
    if hint is not float and type(value) is hint:
        return value
    raise DamageError(f"{place}: {_shorten(value)}: must be {WORDS[hint]}")


def _is_finite(value: Any) -> bool:
    largest = sys.float_info.max
    return type(value) in (int, float) and -largest <= value <= largest


def _check_list(inner: tuple, value: Any, place: str, closed: bool) -> tuple:
    fixed = len(inner) if inner[-1] is not Ellipsis else None
    if not isinstance(value, list | tuple) or fixed not in (None, len(value)):
        words = "a list" if fixed is None else f"a list of {fixed}"
        raise DamageError(f"{place}: {_shorten(value)}: must be {words}")
    if fixed is None and (inner[0] is Any or (inner[0] in WORDS and _are_all(inner[0], value))):
        return tuple(value)
    hints = inner if fixed is not None else inner[:1] * len(value)
    pairs = enumerate(zip(hints, value, strict=True))
    return tuple(_check(hint, item, f"{place}[{k}]", closed) for k, (hint, item) in pairs)


def _are_all(kind: type, values: Any) -> bool:
    """Tell at once whether all values of a list are of the kind wanted, and finite."""
    same = all(type(value) is kind for value in values)
    return same and (kind is not float or all(map(math.isfinite, values)))


def _check_names(hint: Any, value: Any, place: str, closed: bool) -> dict:
    if not isinstance(value, Mapping):
        raise DamageError(f"{place}: {_shorten(value)}: must be names with values")
    return {name: _check(hint, item, _join(place, name), closed) for name, item in value.items()}


def _join(place: str, key: Any) -> str:
    return f"{place}.{key}" if place else str(key)


def _shorten(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def find_entry(kind: type, key: str) -> Entry:
    """Return what a record class says of a key."""
    return entries(kind)[key]
