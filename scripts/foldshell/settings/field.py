"""One setting: default, unit, range and meaning, beside the field of the class that holds it.

A group of settings is a frozen dataclass whose fields are made by `setting`. The class is what the
library takes, in kN, m, kPa and rad; the key in config.yaml is the field's name with its unit
behind it, and default and range are given in that unit: `start_thickness = setting(150, unit="mm",
...)` is `start_thickness_mm: 150` in the file and 0.15 (m) in the class.
"""

import dataclasses
import functools
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Self, TypeVar, dataclass_transform

Factors = Mapping[str, Mapping[str, float]]
"""Factors of load cases by the name of their combination."""

Plain = dict[str, Any]
"""Settings as a file or Snakemake's `params` hold them: texts, numbers, lists and dicts."""

NUMBERS = tuple[float, ...]
"""Kind of a list of numbers in rising order."""

T = TypeVar("T")

_UNITS: dict[str, tuple[str, Callable[[float], float]]] = {
    "GPa": ("_gpa", lambda value: value * 1e6),
    "MPa": ("_mpa", lambda value: value * 1e3),
    # Twelve digits, as workbooks hold them: 4.2 / 1000 is not the number that 0.0042 is read as.
    "mm": ("_mm", lambda value: float(f"{value / 1000:.12g}")),
    "deg": ("_deg", math.radians),
    "kN/m2": ("_kn_m2", float),
    "kN/m3": ("_kn_m3", float),
    "m3": ("_m3", float),
    "m": ("_m", float),
}
"""Suffix of a key and the way into kN, m, kPa and rad, by unit; other units are only said."""


@dataclass(frozen=True)
class Setting:
    """What a setting is. Default, range and `none` are numbers of the file, in `unit`.

    `ranges` are several ranges beside 0, which stands for none; `choices` the words allowed (or,
    for factors, the load cases), `former` old words with the new one; `longest` is the number of
    characters of a text; `stages` are those that get it, by default each one that takes its group.
    What is `internal` stands in no file, it is filled in, and is not compared.
    """

    default: Any
    meaning: str
    unit: str = ""
    minimum: float | None = None
    above: float | None = None
    maximum: float | None = None
    below: float | None = None
    ranges: tuple[tuple[float, float], ...] = ()
    choices: tuple[str, ...] = ()
    former: Mapping[str, str] = dataclasses.field(default_factory=dict)
    longest: int | None = None
    stages: tuple[str, ...] | None = None
    internal: bool = False
    name: str = ""
    kind: Any = None

    @property
    def key(self) -> str:
        """Name with the unit behind it, as in config.yaml and in tables."""
        return self.name + _UNITS.get(self.unit, ("",))[0]

    def convert(self, value: Any) -> Any:
        """Return a value of the file as the class holds it, of the field's type, in kN, m, rad."""
        if self.kind is float:
            return _UNITS[self.unit][1](float(value)) if self.unit in _UNITS else float(value)
        if self.kind is int:
            return int(value)
        if self.kind == tuple[int, int]:
            return tuple(int(item) for item in value)
        if self.kind == NUMBERS:
            return tuple(_UNITS[self.unit][1](float(item)) for item in value)
        if self.kind == tuple[str, ...]:
            return (value,) if isinstance(value, str) else tuple(value)
        if self.kind == Factors:
            return {name: dict(factors) for name, factors in value.items()}
        return value


def setting(default: Any, *, meaning: str, **rest: Any) -> Any:
    """Return all that is to be known of a setting, for a field of a class; see `Setting`."""
    return Setting(default, meaning, **rest)


class Group:
    """Base of the groups. A stage's settings may leave fields out; reading one of those fails."""

    def __getattr__(self, name: str) -> Any:
        """Fail for a field that this stage was not given."""
        if name in list_fields(type(self)) or name in list_groups(type(self)):
            raise AttributeError(
                f"{type(self).__name__}.{name} was not given to this stage: `stages` of that "
                "setting, or STAGES in settings/stages.py, must name it"
            )
        raise AttributeError(f"{type(self).__name__} has no field {name}")

    def __repr__(self) -> str:
        """Show the fields that there are."""
        fields = ", ".join(f"{name}={value!r}" for name, value in vars(self).items())
        return f"{type(self).__name__}({fields})"

    def changed(self, **values: Any) -> Self:
        """Return the group with other values of some fields."""
        return restore(type(self), vars(self) | values)


@dataclass_transform(frozen_default=True, field_specifiers=(setting,))
def settings_group(kind: type) -> type:
    """Make a frozen dataclass of a class whose fields are settings, or groups of them.

    Defaults come from factories, so that the class itself holds no value, and a field that a stage
    was not given is missing.
    """
    for name, annotation in kind.__annotations__.items():
        known = vars(kind).get(name)
        if isinstance(known, Setting):
            known = dataclasses.replace(known, name=name, kind=annotation)
            make = functools.partial(known.convert, known.default)
            field = dataclasses.field(
                default_factory=make, metadata={"setting": known}, compare=not known.internal
            )
        else:
            field = dataclasses.field(default_factory=annotation, metadata={"group": annotation})
        setattr(kind, name, field)
    return dataclass(frozen=True, repr=False)(kind)


@functools.cache
def list_settings(kind: type) -> dict[str, Setting]:
    """Return the settings of a group by the names of their fields; nested groups are left out."""
    return {name: known for name, known in list_fields(kind).items() if not known.internal}


@functools.cache
def list_fields(kind: type) -> dict[str, Setting]:
    """Return the same with those that are internal."""
    found = dataclasses.fields(kind)
    return {field.name: field.metadata["setting"] for field in found if "setting" in field.metadata}


@functools.cache
def list_groups(kind: type) -> dict[str, type]:
    """Return the classes of the groups that are nested in a group, by the names of their fields."""
    found = dataclasses.fields(kind)
    return {field.name: field.metadata["group"] for field in found if "group" in field.metadata}


def restore(kind: type[T], values: Mapping[str, object]) -> T:
    """Return a group that holds the given fields and no others, each value as it is."""
    made = object.__new__(kind)
    for name, value in values.items():
        object.__setattr__(made, name, value)
    return made
