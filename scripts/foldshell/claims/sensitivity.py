"""The sizing loop under other settings: how far results hang on choices the paper leaves open."""

from foldshell.settings.consistency import check_sizing
from foldshell.settings.stage import StageSettings

Values = dict[str, float | str]


VARIANTS: dict[str, dict[str, Values]] = {
    "base": {},
    "start_60": {"sizing": {"start_thickness": 0.06}},
    "start_100": {"sizing": {"start_thickness": 0.1}},
    "least_20": {"sizing": {"least_thickness": 0.02}},
    "plan_area": {"loads": {"area_basis": "plan_abs"}},
    "element_max": {"sizing": {"measure": "element_max"}},
    "stationary": {"sizing": {"stop": "stationary"}},
}
"""Settings that a variant changes, as {group: {field: value}} in m; `base` changes none."""


def change_settings(settings: StageSettings, variant: str) -> StageSettings:
    """Return the settings of the stage `size` with those of a variant in their place.

    Raises `InputError` where they do not go together with the others.
    """
    groups = VARIANTS[variant]
    changed = settings.changed(
        *(getattr(settings, group).changed(**values) for group, values in groups.items())
    )
    check_sizing(changed.sizing, f"sensitivity, variant {variant}")
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
