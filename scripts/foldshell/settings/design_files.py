"""Columns of a design that may name a file: pattern, surface, folded, file_unit."""

from collections.abc import Collection
from dataclasses import replace
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.files.formats import FOLDED_FORMATS, PATTERN_FORMATS, has_suffix
from foldshell.files.meshes.read import FORMATS
from foldshell.files.units import DECLARED
from foldshell.settings.design import FOLDED, NONE, PATTERNS, SURFACES, Design
from foldshell.settings.nearest import hint_nearest
from foldshell.settings.outline_text import OUTLINE_ALLOWED, is_outline_file, read_loops


def check_pattern(pattern: str, where: str) -> None:
    """Raise `InputError` for a pattern that is neither known by name nor a file that is there."""
    _check_name(pattern, "pattern", PATTERNS, PATTERN_FORMATS, "a file of a pattern", where)


def check_surface(surface: str, where: str) -> None:
    """Raise `InputError` for a surface that is neither known by name nor a file that is there."""
    _check_name(surface, "surface", SURFACES, FORMATS, "a mesh file", where)


def _check_name(
    name: str, column: str, known: tuple[str, ...], suffixes: tuple[str, ...], kind: str, where: str
) -> None:
    if name in known:
        return
    if has_suffix(name, suffixes):
        _check_there(name, column, where)
        return
    hint = hint_nearest(name.casefold(), known)
    raise InputError(
        f"{where}: {column}: {name!r}: one of {', '.join(known)} or {kind} "
        f"({', '.join(suffixes)}) is allowed{hint}"
    )


def _check_there(name: str, column: str, where: str) -> None:
    if not Path(name).exists():
        raise InputError(f"{where}: {column}: {name!r}: no such file")


def check_outline(design: Design, where: str) -> None:
    """Raise `InputError` for an outline or openings that are neither polygons nor a file.

    What a file of them holds is looked at where the sheet is cut.
    """
    for column in ("outline", "openings"):
        text = getattr(design, column)
        if text == NONE:
            continue
        if is_outline_file(text):
            _check_there(text, column, where)
            continue
        try:
            loops = read_loops(text)
        except ValueError as error:
            raise InputError(
                f"{where}: {column}: {text[:80]!r}: {error}: {OUTLINE_ALLOWED} is allowed"
            ) from None
        if column == "outline" and len(loops) > 1:
            raise InputError(
                f"{where}: outline: {len(loops)} polygons: one is allowed, openings have a column "
                "of their own"
            )


def settle_files(design: Design, given: Collection[str], where: str) -> Design:
    """Return a design whose columns agree about its files; `given` are the fields with a cell.

    A folded sheet stands for pattern and surface; its span and height are 0 until they are
    measured, where no cell gives them. Counts of polylines are 0 where a file has its own.
    Raises `InputError`.
    """
    if design.folded != NONE:
        design = _settle_folded(design, given, where)
    else:
        check_pattern(design.pattern, where)
        check_surface(design.surface, where)
        if design.pattern not in PATTERNS:
            _refuse_beside(("zigzag", "strip"), given, "pattern", design.pattern, where)
            design = replace(design, zigzag=0, strip=0)
    if design.files and design.file_unit == "m" and "file_unit" not in given:
        design = replace(design, file_unit=DECLARED)
    if design.file_unit != "m" and not design.files:
        raise InputError(
            f"{where}: file_unit: {design.file_unit!r}: without a file only m is allowed"
        )
    return design


def _settle_folded(design: Design, given: Collection[str], where: str) -> Design:
    if not has_suffix(design.folded, FOLDED_FORMATS):
        raise InputError(
            f"{where}: folded: {design.folded!r}: a file of a folded sheet "
            f"({', '.join(FOLDED_FORMATS)}) is allowed"
        )
    _check_there(design.folded, "folded", where)
    names = ("pattern", "surface", "zigzag", "strip", "fold_mode")
    _refuse_beside(names, given, "folded", design.folded, where)
    measured = {name: 0.0 for name in ("span", "height") if name not in given}
    return replace(design, pattern=FOLDED, surface=NONE, zigzag=0, strip=0, **measured)


def _refuse_beside(
    names: tuple[str, ...], given: Collection[str], column: str, value: str, where: str
) -> None:
    for name in names:
        if name in given:
            raise InputError(
                f"{where}: {name}: given beside {column} = {value!r}, which has its own: an empty "
                "cell is allowed"
            )
