"""From the units of config keys to kN, m, kPa and rad."""

import math
from collections.abc import Mapping
from typing import Any

_UNITS = {
    "_gpa": lambda value: value * 1e6,
    "_mpa": lambda value: value * 1e3,
    # Twelve digits, as workbooks hold them: 4.2 / 1000 is not the number that 0.0042 is read as.
    "_mm": lambda value: float(f"{value / 1000:.12g}"),
    "_deg": math.radians,
    "_kn_m2": float,
    "_kn_m3": float,
    "_m3": float,
    "_m": float,
}


def convert_units(group: Mapping[str, Any]) -> dict[str, Any]:
    """Return the values in kN, m, kPa and rad under keys without their unit suffix."""
    converted = {}
    for key, value in group.items():
        suffix = next((suffix for suffix in _UNITS if key.endswith(suffix)), None)
        name = key.removesuffix(suffix) if suffix else key
        converted[name] = _UNITS[suffix](value) if suffix else value
    return converted
