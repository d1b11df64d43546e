"""The sizing loop under other settings: how far results hang on choices the paper leaves open."""

from collections.abc import Mapping
from copy import deepcopy
from dataclasses import fields
from typing import Any

from foldshell.settings.consistency import check_sizing
from foldshell.settings.options import Sizing

VARIANTS: dict[str, dict[str, dict[str, Any]]] = {
    "base": {},
    "start_60": {"sizing": {"start_thickness": 0.06}},
    "start_100": {"sizing": {"start_thickness": 0.1}},
    "least_20": {"sizing": {"least_thickness": 0.02}},
    "plan_area": {"loads": {"area_basis": "plan"}},
    "element_max": {"sizing": {"measure": "element_max"}},
    "stationary": {"sizing": {"stop": "stationary"}},
}
"""Settings that a variant changes, as {group: {field: value}} in m; `base` changes none."""


def change_settings(settings: Mapping[str, Any], variant: str) -> dict[str, Any]:
    """Return the plain settings of the stage `size` with those of a variant in their place.

    Raises `InputError` where they do not go together with the others.
    """
    changed = deepcopy(dict(settings))
    for group, values in VARIANTS[variant].items():
        changed[group] = changed[group] | values
    sizing = {field.name: changed["sizing"][field.name] for field in fields(Sizing)}
    check_sizing(Sizing(**sizing), f"sensitivity, variant {variant}")
    return changed


def describe_variants() -> dict[str, str]:
    """Return what each variant changes, in words."""
    words = {}
    for name, groups in VARIANTS.items():
        changes = {field: value for group in groups.values() for field, value in group.items()}
        items = [
            f"{field} {value}" + (" m" if isinstance(value, float) else "")
            for field, value in changes.items()
        ]
        words[name] = ", ".join(items) or "the settings of the study"
    return words
