"""The settings of one stage: plain values on the way through Snakemake, typed at both ends."""

import typing
from collections.abc import Iterator, Mapping
from typing import Any

from foldshell.settings.field import Group, Plain, list_fields, list_groups, restore


class StageSettings:
    """The groups of settings that a stage takes, each by its name: `settings.sizing.rule`.

    A group, or a setting in one, that the stage was not given is missing: reading it raises an
    AttributeError that says so.
    """

    def __init__(self, *groups: Group) -> None:
        for one in groups:
            self.__dict__[type(one).__name__.lower()] = one

    def __getattr__(self, name: str) -> Any:
        """Fail for a group that this stage was not given."""
        raise AttributeError(f"this stage was not given the settings {name}")

    def changed(self, *groups: Group) -> "StageSettings":
        """Return the settings with other groups in place of those of the same class."""
        return StageSettings(*vars(self).values(), *groups)

    def to_plain(self) -> Plain:
        """Return {group: {field: value}} in kN, m, kPa and rad."""
        return {name: to_plain(one) for name, one in vars(self).items()}


def flatten(values: Mapping[str, object], prefix: str = "") -> list[tuple[str, object]]:
    """Return nested plain settings as (`group.key`, value) in their order; lists become text."""
    flat: list[tuple[str, object]] = []
    for key, value in values.items():
        if isinstance(value, Mapping):
            flat += flatten(value, f"{prefix}{key}.")
        elif isinstance(value, list | tuple):
            flat.append((f"{prefix}{key}", ", ".join(str(item) for item in value)))
        else:
            flat.append((f"{prefix}{key}", value))
    return flat


def to_plain(values: Group, stage: str | None = None) -> Plain:
    """Return {field: value} of a group: of those fields that a stage gets, or of all it holds."""
    return dict(_iterate_plain(values, stage))


def _iterate_plain(values: Group, stage: str | None) -> Iterator[tuple[str, Any]]:
    settings, groups = list_fields(type(values)), list_groups(type(values))
    for name, value in vars(values).items():
        if name in groups:
            yield name, to_plain(value, stage)
        elif stage is None or settings[name].stages is None or stage in settings[name].stages:
            # Tuples as lists, as they come back from Snakemake and from JSON.
            yield name, list(value) if isinstance(value, tuple) else value


def read_stage(plain: Plain, *kinds: type) -> StageSettings:
    """Return typed settings of `params`, or of several put together: the groups of `kinds`.

    Raises `LookupError` for a group that is missing or of another class.
    """
    named = {kind.__name__.lower(): kind for kind in kinds}
    if named.keys() != plain.keys():
        raise LookupError(f"settings {', '.join(plain)} are not those of {', '.join(named)}")
    return StageSettings(*(_restore(named[name], values) for name, values in plain.items()))


def _restore(kind: type, plain: Plain) -> Any:
    groups, settings = list_groups(kind), list_fields(kind)
    return restore(
        kind,
        {
            name: _restore(groups[name], value)
            if name in groups
            else tuple(value)
            if typing.get_origin(settings[name].kind) is tuple
            else value
            for name, value in plain.items()
        },
    )
