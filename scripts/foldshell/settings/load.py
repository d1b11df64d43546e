"""Everything that is checked before the first job: settings files, settings, designs."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from foldshell.settings.config_file import read_config
from foldshell.settings.designs import Design, check_defaults, read_designs
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
    return settings, read_designs(settings.designs, settings)
