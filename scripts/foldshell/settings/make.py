"""Typed settings, made once from the validated configuration; kN, m, kPa and rad inside.

Field names are the keys of config.yaml without their unit suffix: `youngs_modulus_gpa: 31` becomes
`material.youngs_modulus = 31e6` (kPa), `start_thickness_mm: 150` becomes 0.15 (m).
"""

import functools
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from foldshell.files.errors import InputError
from foldshell.settings.config_file import read_config
from foldshell.settings.consistency import check_crosscheck, check_sizing
from foldshell.settings.material import age_material
from foldshell.settings.options import (
    Analysis,
    Combinations,
    Crosscheck,
    Defaults,
    Drawings,
    ExactWeights,
    Exports,
    Figures,
    Fold,
    FoldLimits,
    FoldWeights,
    Jobs,
    Limits,
    Loads,
    Material,
    Pattern,
    Settings,
    Sizing,
    Tolerance,
)
from foldshell.settings.schema import fill_defaults, load_schema, validate
from foldshell.settings.units import convert_units

LOAD_CASES = ("SW", "SDL", "LL", "WX", "WY")
UPLIFT = {
    "S6": {"SW": 0.9, "SDL": 0.9, "WX": 1.0},
    "S7": {"SW": 0.9, "SDL": 0.9, "WY": 1.0},
}


_GROUPS = {
    "defaults": Defaults,
    "pattern": Pattern,
    "fold": Fold,
    "material": Material,
    "loads": Loads,
    "combinations": Combinations,
    "analysis": Analysis,
    "sizing": Sizing,
    "crosscheck": Crosscheck,
    "limits": Limits,
    "jobs": Jobs,
    "figures": Figures,
    "drawings": Drawings,
    "exports": Exports,
}
_NESTED = {
    ("fold", "weights"): FoldWeights,
    ("fold", "exact"): ExactWeights,
    ("fold", "limits"): FoldLimits,
    ("crosscheck", "tolerance"): Tolerance,
}


@functools.cache
def config_schema() -> dict[str, Any]:
    """Return the schema of config.yaml."""
    return load_schema("config.schema.yaml")


def read_settings(path: str | Path) -> Settings:
    """Read, validate and type one configuration file."""
    return make_settings(read_config(path), str(path))


def make_settings(config: Mapping[str, Any], source: str = "configuration") -> Settings:
    """Fill in defaults, validate, check settings against each other, and type them.

    `config` is what a file holds or what Snakemake merged from files and `--config`; `source`
    stands in messages. Raises `InputError`.
    """
    validate(_plain_copy(config), config_schema(), source)
    filled = fill_defaults(config_schema(), _plain_copy(config))
    settings = _type_settings(filled, source)
    check_sizing(settings.sizing, source)
    check_crosscheck(settings.crosscheck, settings.combinations, source)
    return settings


def _plain_copy(data: Any) -> Any:
    if isinstance(data, Mapping):
        return {key if isinstance(key, str) else repr(key): _plain_copy(data[key]) for key in data}
    if isinstance(data, list | tuple):
        return [_plain_copy(item) for item in data]
    return data


def _type_settings(filled: Mapping[str, Any], source: str) -> Settings:
    groups: dict[str, Any] = {}
    for name, kind in _GROUPS.items():
        if name == "combinations":
            groups[name] = _type_combinations(filled, source)
            continue
        fields = convert_units(filled[name])
        for (group, key), nested in _NESTED.items():
            if group == name:
                fields[key] = nested(**convert_units(fields[key]))
        groups[name] = kind(**fields)
    groups["material"] = age_material(groups["material"], groups["analysis"].creep_coefficient)
    return Settings(designs=filled["designs"], study=filled["study"], **groups)


def _type_combinations(filled: Mapping[str, Any], source: str) -> Combinations:
    groups = {
        group: {
            name: {case: float(factors[case]) for case in LOAD_CASES if case in factors}
            for name, factors in filled["combinations"][group].items()
        }
        for group in ("strength", "deflection")
    }
    both = sorted(set(groups["strength"]) & set(groups["deflection"]))
    if both:
        raise InputError(
            f"{source}: combinations.deflection.{both[0]}: names a strength combination too, "
            "each name may stand once"
        )
    if filled["loads"]["uplift"]:
        for name, factors in UPLIFT.items():
            if name in groups["strength"] or name in groups["deflection"]:
                raise InputError(
                    f"{source}: loads.uplift: true: it adds a combination {name}, which stands "
                    "under combinations already: rename that one or leave uplift out"
                )
            groups["strength"][name] = dict(factors)
    return Combinations(**groups)
