"""From plain values of a file to typed settings, with one sentence for what is not allowed."""

import itertools
import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from foldshell.files.errors import InputError
from foldshell.files.plain_text import find_unsafe
from foldshell.settings.allowed import NUMBER, describe_allowed, describe_hint, in_range
from foldshell.settings.field import NUMBERS, Factors, Setting, list_groups, list_settings
from foldshell.settings.nearest import find_nearest

COMBINATIONS_MAX = 40
COMBINATION_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,15}")


@dataclass(frozen=True)
class Reader:
    """Where values stand: `source` begins each sentence, `yaml` is False for tables.

    `notes` gathers what is to be said once, such as a place with an old word, and the new one;
    `cases` are load cases of the table of loads, which combinations may name beside the paper's.
    """

    source: str
    yaml: bool = True
    notes: list[str] = field(default_factory=list)
    cases: tuple[str, ...] = ()

    def read_group(self, kind: type, data: object, place: str = "") -> Any:
        """Return the group of class `kind` from nested plain values, defaults where left out.

        Raises `InputError` with file, place, value and what is allowed.
        """
        self._refuse_unknown(kind, data, place, kind)
        return self._read(kind, data, place)

    def _refuse_unknown(self, kind: type, data: object, place: str, root: type) -> None:
        if not isinstance(data, Mapping):
            raise self.refuse(place, data, "a group of keys with values")
        groups = list_groups(kind)
        known = [item.key for item in list_settings(kind).values()] + list(groups)
        for key in data:
            if key not in known:
                here = join_place(place, key)
                words = describe_unknown_key(here, str(key), place, known, root)
                raise InputError(f"{self.source}: {words}")
        for name, nested in groups.items():
            if name in data:
                self._refuse_unknown(nested, data[name], join_place(place, name), root)

    def _read(self, kind: type, data: Mapping[str, object], place: str) -> Any:
        values = {}
        for name, known in list_settings(kind).items():
            if known.key in data:
                given = self.read_value(known, data[known.key], join_place(place, known.key))
                values[name] = known.convert(given)
        for name, nested in list_groups(kind).items():
            if name in data:
                values[name] = self._read(nested, data[name], join_place(place, name))
        return kind(**values)

    def read_value(self, known: Setting, value: Any, place: str) -> Any:
        """Return an allowed value of the file, an old word as the new one."""
        if known.kind == tuple[int, int]:
            return self._read_pair(known, value, place)
        if known.kind == NUMBERS:
            return self._read_numbers(known, value, place)
        if known.kind == tuple[str, ...]:
            return self._read_words(known, value, place)
        if known.kind == Factors:
            return self._read_factors(known, value, place)
        if isinstance(value, float) and not math.isfinite(value):
            raise InputError(f"{self.source}: {place}: {value}: only finite numbers are allowed")
        unsafe = find_unsafe(value) if isinstance(value, str) else None
        if unsafe:
            raise InputError(f"{self.source}: {place}: {value!a}: {unsafe}: plain text is allowed")
        if isinstance(value, str) and value in known.former:
            new = known.former[value]
            self.notes.append(f"{place}: {value!r} is now called {new!r}")
            return new
        if not _is_allowed(known, value):
            hint = describe_hint(value, known, self.yaml)
            raise self.refuse(place, value, describe_allowed(known), hint)
        return value

    def refuse(self, place: str, value: object, allowed: str, hint: str = "") -> InputError:
        """Return the error of a value that is not allowed."""
        return InputError(f"{self.source}: {place}: {value!r}: {allowed} is allowed{hint}")

    def _read_pair(self, known: Setting, value: Any, place: str) -> list[Any]:
        if not isinstance(value, list | tuple):
            raise self.refuse(place, value, describe_allowed(known))
        if len(value) != 2:
            raise InputError(f"{self.source}: {place}: {len(value)} entries: exactly 2 are allowed")
        item = replace(known, kind=int)
        return [self.read_value(item, v, f"{place}[{i}]") for i, v in enumerate(value)]

    def _read_numbers(self, known: Setting, value: Any, place: str) -> list[float]:
        """Read a list of numbers in rising order; it may be empty."""
        if not isinstance(value, list | tuple):
            raise self.refuse(place, value, describe_allowed(known))
        item = replace(known, kind=float)
        found = [self.read_value(item, v, f"{place}[{i}]") for i, v in enumerate(value)]
        if any(low >= high for low, high in itertools.pairwise(found)):
            raise InputError(f"{self.source}: {place}: {value}: rising numbers are allowed")
        return found

    def _read_words(self, known: Setting, value: Any, place: str) -> list[str]:
        if isinstance(value, str) and not known.choices:
            return [self.read_value(replace(known, kind=str), value, place)]
        if (
            not isinstance(value, list | tuple)
            or not value
            or len(set(map(str, value))) < len(value)
        ):
            raise self.refuse(place, value, describe_allowed(known))
        item = replace(known, kind=str)
        return [self.read_value(item, word, f"{place}[{i}]") for i, word in enumerate(value)]

    def _read_factors(self, known: Setting, value: Any, place: str) -> Factors:
        if not isinstance(value, Mapping):
            raise self.refuse(place, value, "a group of keys with values")
        if not 1 <= len(value) <= COMBINATIONS_MAX:
            raise InputError(
                f"{self.source}: {place}: {len(value)} entries: at least 1 are needed and at most "
                f"{COMBINATIONS_MAX} allowed"
            )
        found = {}
        for name, factors in value.items():
            if not COMBINATION_NAME.fullmatch(str(name)):
                raise self.refuse(
                    place, name,
                    "a name of up to 16 letters, digits and _, beginning with a letter,",
                )  # fmt: skip
            found[name] = self._read_combination(known, factors, join_place(place, name))
        return found

    def _read_combination(self, known: Setting, factors: Any, place: str) -> Mapping[str, float]:
        if not isinstance(factors, Mapping):
            raise self.refuse(place, factors, "a group of keys with values")
        if not factors:
            raise InputError(f"{self.source}: {place}: 0 entries: at least 1 are needed")
        cases = tuple(dict.fromkeys((*known.choices, *self.cases)))
        for case in factors:
            if case not in cases:
                near = find_nearest(str(case).upper(), cases)
                hint = f"the nearest is {place}.{near}" if near else ""
                raise InputError(
                    f"{self.source}: {join_place(place, case)}: unknown key, "
                    f"{hint or 'allowed are ' + ', '.join(cases)}"
                )
        item = replace(known, kind=float, choices=())
        return {
            case: float(self.read_value(item, factors[case], join_place(place, case)))
            for case in cases
            if case in factors
        }


def _is_allowed(known: Setting, value: Any) -> bool:
    if known.kind is str:
        good = isinstance(value, str) and 1 <= len(value) <= (known.longest or len(value))
        return good and (not known.choices or value in known.choices)
    if known.kind is bool:
        return isinstance(value, bool)
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    whole = isinstance(value, int) or float(value).is_integer()
    return (whole or known.kind is float) and in_range(known, value)


def join_place(place: str, key: object) -> str:
    """Return `place.key`."""
    return f"{place}.{key}" if place else str(key)


def describe_unknown_key(place: str, key: str, parent: str, known: list[str], root: type) -> str:
    """Say that a key is unknown and which known one is nearest, in its group or elsewhere."""
    near = find_nearest(key, known)
    if near:
        return f"{place}: unknown key, the nearest is {join_place(parent, near)}"
    elsewhere = {where.rpartition(".")[2]: where for where, _ in iterate_settings(root)}
    other = find_nearest(key, elsewhere, cutoff=0.8)
    if other:
        return f"{place}: unknown key, the nearest is {elsewhere[other]}"
    return f"{place}: unknown key, allowed are {', '.join(known)}"


def iterate_settings(kind: type, place: str = "") -> Iterator[tuple[str, Setting]]:
    """Yield (place, setting) of every setting in a group and in those nested in it."""
    for known in list_settings(kind).values():
        yield join_place(place, known.key), known
    for name, nested in list_groups(kind).items():
        yield from iterate_settings(nested, join_place(place, name))


def parse_text(known: Setting, text: str) -> Any:
    """Return what a text stands for: a number for a setting that is one, true or false, or itself.

    This is the rule for cells of tables and for `--config`, which know nothing but text.
    """
    if known.kind is bool:
        return {"true": True, "false": False}.get(text.lower(), text)
    if known.kind in (int, float, tuple[int, int], NUMBERS, Factors) and NUMBER.fullmatch(text):
        number = float(text)
        return int(number) if number.is_integer() and "." not in text else number
    return text


def parse_group(kind: type, data: Any) -> Any:
    """Return nested plain values with each text parsed by the setting that it belongs to."""
    if not isinstance(data, Mapping):
        return data
    keys = {known.key: known for known in list_settings(kind).values()}
    groups = list_groups(kind)
    return {
        key: parse_group(groups[key], value)
        if key in groups
        else _parse_nested(keys[key], value)
        if key in keys
        else value
        for key, value in data.items()
    }


def _parse_nested(known: Setting, value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _parse_nested(known, item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_parse_nested(known, item) for item in value]
    if known.kind is str and isinstance(value, int | float) and not isinstance(value, bool):
        return f"{value}"
    return parse_text(known, value) if isinstance(value, str) else value
