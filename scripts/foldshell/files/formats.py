"""Which files hold a flat crease pattern, a folded sheet, or both: by their suffixes."""

from pathlib import Path

from foldshell.files.meshes.read import FORMATS

PATTERN_FORMATS = (".fold", ".svg", ".dxf")
"""Suffixes of files of crease patterns, in small letters."""
FOLDED_FORMATS = (".fold", *FORMATS)
"""Suffixes of files of folded sheets; those of target surfaces are FORMATS."""


def has_suffix(name: str | Path, suffixes: tuple[str, ...]) -> bool:
    """Tell whether a name ends with one of the suffixes, in small or capital letters."""
    return Path(name).suffix.lower() in suffixes
