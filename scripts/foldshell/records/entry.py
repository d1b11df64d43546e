"""What is said of a field of a result file: unit, meaning, words, the key it stands under."""

import dataclasses
import types
import typing
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType
from typing import Any, get_type_hints

SIGNS = {"m2": "m²", "m3": "m³", "deg": "°", "kN/m2": "kN/m²", "kN/m3": "kN/m³",
         "kg/m2": "kg/m²"}  # fmt: skip
"""Units of files as people write them."""
COUNT = "count"
"""Unit of whole numbers that count something."""


FACTORS = {("m", "mm"): 1e3, ("m3/m2", "mm"): 1e3, ("-", "%"): 100.0}
"""From the unit of a file to the one that a person reads, where they differ."""


@dataclass(frozen=True)
class Entry:
    """A field of a record.

    `attribute` is its name in Python, `key` the one in the file, `type` the annotation. `unit` is
    that of the file: empty for texts and answers, `COUNT` for whole numbers, "-" for ratios.
    `words` are what a person reads for the key, without unit, and `shown` the unit of the number on
    pages that compare designs; `form` names the number format of
    workbooks where the type alone does not say it. A `left_out` field that is None has no key, or
    in a table no column.
    """

    attribute: str
    key: str
    type: Any
    unit: str
    meaning: str
    words: str
    form: str
    left_out: bool
    required: bool
    shown: str

    def label(self, unit: bool = True) -> str:
        """Return the words, with the unit in brackets where there is one."""
        return self._write(self.unit) if unit else self.words

    @property
    def shown_label(self) -> str:
        """The words, with the unit that is shown in brackets."""
        return self._write(self.shown)

    @property
    def factor(self) -> float:
        """The number in the unit that is shown over that of the file."""
        return 1.0 if self.shown == self.unit else FACTORS[self.unit, self.shown]

    def _write(self, unit: str) -> str:
        sign = SIGNS.get(unit, unit)
        return self.words if sign in ("", COUNT) else f"{self.words} [{sign}]"


def entry(
    meaning: str,
    unit: str = "",
    words: str = "",
    *,
    key: str = "",
    form: str = "",
    shown: str = "",
    left_out: bool = False,
    default: Any = dataclasses.MISSING,
) -> Any:
    """Return a dataclass field that carries what `Entry` says of it; `left_out` ones default to
    None."""
    about = {"unit": unit, "meaning": meaning, "words": words, "key": key, "form": form,
             "shown": shown, "left_out": left_out}  # fmt: skip
    if left_out and default is dataclasses.MISSING:
        default = None
    return dataclasses.field(default=default, metadata=about)


def elapsed() -> Any:
    """Return the field `seconds` of a record that is written into a file of its own, seconds.json:
    results are equal whenever they were computed, times are not."""
    return dataclasses.field(default=None, compare=False, metadata={"apart": True})


def same(
    kind: type, name: str, left_out: bool | None = None, empty: bool = False, **changed: str
) -> Any:
    """Return a dataclass field that says the same as a field of another record but for `changed`.

    `left_out` False keeps the column of a value that may be None; `empty` makes that the default.
    """
    field = kind.__dataclass_fields__[name]
    kept = field.metadata["left_out"] if left_out is None else left_out
    metadata = {**field.metadata, "left_out": kept, **changed}
    default = None if kept or empty else field.default
    return dataclasses.field(default=default, metadata=metadata)


@cache
def entries(kind: type) -> Mapping[str, Entry]:
    """Return the fields of a record class by their keys in the file, in order.

    Raises `TypeError` for a field that was not made by `entry`: without a meaning there is none.
    """
    hints = get_type_hints(kind)
    kept = (field for field in dataclasses.fields(kind) if not field.metadata.get("apart"))
    found = (_describe(field, hints[field.name]) for field in kept)
    return MappingProxyType({about.key: about for about in found})


def _describe(field: dataclasses.Field, hint: Any) -> Entry:
    about = field.metadata
    if not about.get("meaning"):
        raise TypeError(f"{field.name}: a field of a record has a meaning: make it by `entry`")
    key = about["key"] or field.name
    unit = about["unit"]
    words = about["words"] or name_key(key, unit)
    required = field.default is dataclasses.MISSING
    return Entry(field.name, key, hint, unit, about["meaning"], words, about["form"],
                 about["left_out"], required, about["shown"] or unit)  # fmt: skip


def strip_null(hint: Any) -> Any:
    """Return an annotation without None: of `float | None` float; others as they are."""
    if typing.get_origin(hint) in (types.UnionType, typing.Union):
        return next(one for one in typing.get_args(hint) if one is not type(None))
    return hint


def name_key(key: str, unit: str) -> str:
    """Return a key in words, without its unit: `height_m` of unit m is `height`."""
    suffix = "_" + unit.replace("/", "_").lower()
    return (key.removesuffix(suffix) if len(suffix) > 1 else key).replace("_", " ")
