"""Typed settings, made once from the configuration, and checked against each other."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.settings.check import Reader
from foldshell.settings.config_file import read_config
from foldshell.settings.consistency import check_combinations, check_crosscheck, check_sizing
from foldshell.settings.load_sets import find_load_sets, list_cases
from foldshell.settings.loads import LOAD_CASES, UPLIFT, Combinations
from foldshell.settings.material import age_material
from foldshell.settings.study import LOAD_TABLE, Settings
from foldshell.settings.supports import SupportFinder


def read_settings(path: str | Path) -> Settings:
    """Read, check and type one configuration file."""
    return make_settings(read_config(path), str(path))


def make_settings(
    config: Mapping[str, object], source: str = "configuration", notes: list[str] | None = None
) -> Settings:
    """Check settings one by one and against each other, fill in defaults, and type them.

    `config` is what a file holds or what Snakemake merged from files and `--config`; `source`
    stands in messages, `notes` gathers what is to be said once (old words). Raises `InputError`.
    """
    sets = find_load_sets(config.get("load_table", LOAD_TABLE), source)
    reader = Reader(source, notes=[] if notes is None else notes, cases=list_cases(sets))
    settings = replace(reader.read_group(Settings, config), load_sets=sets)
    combinations = _add_uplift(settings, source) if settings.loads.uplift else settings.combinations
    others = set(list_cases(sets)) - set(LOAD_CASES)
    check_combinations(combinations, settings.loads, source, others)
    check_sizing(settings.sizing, source)
    SupportFinder(settings.supports).find(settings.defaults.support, f"{source}: defaults.support")
    listed = combinations if combinations.rule == "listed" else None
    check_crosscheck(settings.crosscheck, listed, source)
    material = age_material(settings.material, settings.analysis.creep_coefficient)
    return replace(settings, material=material, combinations=combinations)


def _add_uplift(settings: Settings, source: str) -> Combinations:
    given = settings.combinations
    taken = {name.casefold(): name for name in given.all}
    for name in UPLIFT:
        if name.casefold() in taken:
            raise InputError(
                f"{source}: loads.uplift: true: it adds a combination {name}, but "
                f"{taken[name.casefold()]} stands under combinations already: rename that one or "
                "leave uplift out"
            )
    return replace(given, strength={**given.strength, **UPLIFT})
