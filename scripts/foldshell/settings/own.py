"""Settings of a design's own: the file that its row names, laid over those of the study."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.settings.check import Reader, parse_group
from foldshell.settings.config_file import read_config
from foldshell.settings.design import NONE, Design
from foldshell.settings.load_sets import check_loads
from foldshell.settings.make import make_settings
from foldshell.settings.nearest import hint_nearest
from foldshell.settings.study import Settings

OWN_GROUPS = ("combinations", "codes", "sizing", "checks", "reinforcement", "co2", "prices")
"""Groups that a design may have of its own: what it is sized for, and judged by. Shape, loads and
mesh have columns, or are those of the study."""


def read_own(path: str | Path, config: Mapping[str, object], place: str) -> Settings:
    """Return the settings of a study, as `config` holds them plain, with those of a file over them.

    Raises `InputError` that names the file, or `place` where there is none, for groups that are the
    study's alone and for settings that do not go together.
    """
    path = Path(path)
    if not path.is_file():
        raise InputError(f"{place}: settings: {str(path)!r}: no such file")
    own = read_config(path)
    for key in own:
        if key not in OWN_GROUPS:
            raise InputError(
                f"{path}: {key}: it is the study's and no design's own: one of "
                f"{', '.join(OWN_GROUPS)} is allowed" + hint_nearest(key, OWN_GROUPS)
            )
    Reader(str(path)).read_group(Settings, own)
    return make_settings(parse_group(Settings, lay_over(config, own)), str(path))


def lay_over(below: Mapping[str, object], above: Mapping[str, object]) -> dict[str, object]:
    """Return nested plain settings with those of `above` in place of those of the same key."""
    found = dict(below)
    for key, value in above.items():
        both = isinstance(value, Mapping) and isinstance(below.get(key), Mapping)
        found[key] = lay_over(below[key], value) if both else value
    return found


def add_own(
    settings: Settings, designs: Iterable[Design], config: Mapping[str, object]
) -> Settings:
    """Return the settings with those of all files that designs name, each file read once.

    Raises `InputError` as `read_own` does, and for combinations that a design's loads do not have.
    """
    naming: dict[str, list[Design]] = {}
    for design in designs:
        if design.settings != NONE:
            naming.setdefault(design.settings, []).append(design)
    found: dict[str, Settings] = {}
    for path, having in naming.items():
        place = f"{settings.designs}: design {having[0].name!r}"
        found[path] = read_own(path, config, place)
        check_loads(having, found[path], str(settings.designs), path)
    return replace(settings, own=found)


def settings_of(settings: Settings, design: Design | None) -> Settings:
    """Return the settings that a design has: its own, or those of the study."""
    if design is None or design.settings == NONE:
        return settings
    return settings.own[design.settings]
