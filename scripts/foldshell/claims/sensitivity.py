"""The sizing loop under other settings, and its last state under other loads and theory: how far
results hang on choices the paper leaves open."""

from collections.abc import Mapping
from dataclasses import dataclass

from foldshell.files.whole import Json
from foldshell.settings.consistency import check_sizing
from foldshell.settings.stage import StageSettings


@dataclass(frozen=True)
class Times:
    """A factor of the value that a setting has."""

    factor: float


Values = dict[str, float | str | Times]
RESIZED: dict[str, dict[str, Values]] = {
    "base": {},
    "start_60": {"sizing": {"start_thickness": 0.06}},
    "start_100": {"sizing": {"start_thickness": 0.1}},
    "least_20": {"sizing": {"least_thickness": 0.02}},
    "plan_area": {"loads": {"area_basis": "plan_abs"}},
    "element_max": {"sizing": {"measure": "element_max"}},
    "strip": {"sizing": {"measure": "strip"}},
    "stationary": {"sizing": {"stop": "stationary"}},
}
"""Settings under which a loop runs anew, as {group: {field: value}} in m; `base` changes none."""
DELIVERED: dict[str, dict[str, Values]] = {
    "wind_turned": {"loads": {"wind": Times(-1)}},
    "sdl_vertical": {"loads": {"sdl_direction": "vertical"}},
    "creep": {"material": {"youngs_modulus": Times(1 / 3)}},
    "imperfection": {"analysis": {"imperfection": 0.01}},
}
"""Settings under which the state that a loop delivered is analysed once more, as it is: the wind
from the other side, SDL straight down, creep 2 under all loads, the first mode by 10 mm."""
SHEAR = "shear"
"""The delivered state with the share of shear deformation that the independent code finds."""
VARIANTS = RESIZED | DELIVERED | {SHEAR: {}}


def change_settings(settings: StageSettings, variant: str) -> StageSettings:
    """Return the settings of the stage `size` with those of a variant in their place.

    A factor of a setting that the stage was not given changes nothing. Raises `InputError` where
    they do not go together with the others.
    """
    changed = settings.changed(
        *(
            getattr(settings, group).changed(**_resolve(vars(getattr(settings, group)), values))
            for group, values in VARIANTS[variant].items()
        )
    )
    check_sizing(changed.sizing, f"sensitivity, variant {variant}")
    return changed


def _resolve(known: Mapping[str, float], values: Values) -> dict[str, float | str]:
    """Return values with factors multiplied out; those of unknown settings are left out."""
    return {
        name: known[name] * value.factor if isinstance(value, Times) else value
        for name, value in values.items()
        if name in known or not isinstance(value, Times)
    }


def list_changes(variant: str) -> dict[str, Json]:
    """Return what a variant changes, by group, as plain data."""
    return {group: {name: _show(value) for name, value in values.items()}
            for group, values in VARIANTS[variant].items()}  # fmt: skip


def _show(value: float | str | Times) -> float | str:
    return f"times {value.factor:.3g}" if isinstance(value, Times) else value


def describe_variants() -> dict[str, str]:
    """Return what each variant changes, in words."""
    words = {}
    for name, groups in VARIANTS.items():
        changes = {field: value for group in groups.values() for field, value in group.items()}
        items = [
            f"{field} {_show(value)}" + (" m" if isinstance(value, float) else "")
            for field, value in changes.items()
        ]
        words[name] = ", ".join(items) or "the settings of the study"
        if name in DELIVERED:
            words[name] += "; the delivered state, not sized anew"
    return words | {SHEAR: "shear deformation by the independent code, the delivered state"}
