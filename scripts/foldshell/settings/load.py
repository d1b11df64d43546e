"""Everything that is checked before the first job: settings files, settings, designs."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from foldshell.files.errors import InputError
from foldshell.files.meshes.surface import read_surface
from foldshell.settings.config_file import read_config
from foldshell.settings.designs import SURFACES, Design, check_defaults, read_designs
from foldshell.settings.make import config_schema, make_settings
from foldshell.settings.options import Settings
from foldshell.settings.schema import validate


def load_study(
    config: Mapping[str, Any], files: Iterable[str | Path] = ()
) -> tuple[Settings, list[Design]]:
    """Return the typed settings and the designs of a study.

    `files` are read strictly for what Snakemake's own YAML reading lets through (duplicate keys,
    octal numbers, `no` for False) and validated alone, so that the message names the file;
    `config` is what Snakemake merged from them and `--config`. Raises `InputError`.
    """
    source = "configuration"
    for file in files:
        validate(read_config(file), config_schema(), str(file))
        source = f"{file} with --config"
    settings = make_settings(config, source)
    check_defaults(settings, source)
    designs = read_designs(settings.designs, settings)
    check_surface_files(designs, str(settings.designs))
    return settings, designs


def check_surface_files(designs: Iterable[Design], source: str) -> None:
    """Raise `InputError` for a design whose surface is a mesh file that cannot be its target.

    Each file is read once for each span, whatever the number of designs.
    """
    seen = set()
    for design in designs:
        if design.surface in SURFACES or (design.surface, design.span) in seen:
            continue
        seen.add((design.surface, design.span))
        try:
            read_surface(design.surface, design.span)
        except InputError as error:
            raise InputError(f"{source}: design {design.name!r}: surface: {error}") from None
