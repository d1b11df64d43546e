"""Units of files of patterns and meshes, and the factor to metres."""

from pathlib import Path

from foldshell.files.errors import InputError

FACTORS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "inch": 0.0254, "feet": 0.3048}
WORDS = {"m": "metres", "cm": "centimetres", "mm": "millimetres", "inch": "inches", "feet": "feet"}


def agree_on_unit(path: str | Path, declared: str | None, given: str | None) -> float:
    """Return the metres of a file's unit: the one it declares, else the one given, else 1.

    Raises `InputError` for an unknown one and where both are there and differ.
    """
    if given is not None and given not in FACTORS:
        raise InputError(f"{path}: file_unit: {given!r}: one of {', '.join(FACTORS)} is allowed")
    if declared and given and declared != given:
        raise InputError(
            f"{path}: the file declares {WORDS[declared]}, file_unit says {WORDS[given]}: "
            "both must agree"
        )
    return FACTORS[declared or given or "m"]
