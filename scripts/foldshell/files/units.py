"""Units of files of patterns and meshes, and the factor to metres."""

from collections.abc import Mapping
from pathlib import Path

from foldshell.files.errors import InputError

FACTORS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "inch": 0.0254, "feet": 0.3048}
_OF_FOLD = {"m": "m", "cm": "cm", "mm": "mm", "in": "inch", "inch": "inch", "ft": "feet"}
_SIZELESS = (None, "unit", "")
DECLARED = "declared"
"""Stands for the unit that a file declares, metres where it declares none."""
WORDS = {"m": "metres", "cm": "centimetres", "mm": "millimetres", "inch": "inches", "feet": "feet"}


def agree_on_unit(path: str | Path, declared: str | None, given: str | None) -> float:
    """Return the metres of a file's unit: the one it declares, else the one given, else 1.

    `given` may be DECLARED. Raises `InputError` for an unknown one and where both are there and
    differ.
    """
    given = None if given == DECLARED else given
    if given is not None and given not in FACTORS:
        raise InputError(f"{path}: file_unit: {given!r}: one of {', '.join(FACTORS)} is allowed")
    if declared and given and declared != given:
        raise InputError(
            f"{path}: the file declares {WORDS[declared]}, file_unit says {WORDS[given]}: "
            "both must agree"
        )
    return FACTORS[declared or given or "m"]


def name_unit(file_unit: str | None) -> str:
    """Return the unit that a mesh file must have in words, empty for the one that it declares."""
    return WORDS.get(file_unit or "", "")


def find_factor(declared: str, file_unit: str | None) -> float:
    """Return the metres of a mesh file's unit; `declared` are the words of WORDS, or empty."""
    words = declared or name_unit(file_unit) or WORDS["m"]
    return next(FACTORS[key] for key, name in WORDS.items() if name == words)


def find_fold_unit(path: str | Path, data: Mapping[str, object]) -> str | None:
    """Return the key of FACTORS that the top frame of a FOLD file declares, None for none.

    Raises `InputError` for another unit.
    """
    unit = data.get("frame_unit")
    if unit in _SIZELESS:
        return None
    if not isinstance(unit, str) or unit not in _OF_FOLD:
        raise InputError(f"{path}: frame_unit: {unit!r}: one of {', '.join(_OF_FOLD)} is allowed")
    return _OF_FOLD[unit]
