"""The table of designs: read strictly, validate, fill in defaults, choose by tag."""

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.settings.check import Reader, parse_text
from foldshell.settings.consistency import check_thickness
from foldshell.settings.design import (
    COLUMNS,
    MIURA_COLUMNS,
    NONE,
    OTHER_PARAMETERS,
    PARAMETERS,
    Design,
    DesignColumns,
)
from foldshell.settings.design_files import (
    check_outline,
    check_pattern,
    check_surface,
    settle_files,
)
from foldshell.settings.field import list_settings
from foldshell.settings.nearest import hint_nearest
from foldshell.settings.places import RESERVED
from foldshell.settings.study import Settings
from foldshell.settings.supports import SupportFinder
from foldshell.settings.tables import read_table

NAME = re.compile(r"[a-z0-9][a-z0-9_-]{0,63}")
NAME_ALLOWED = (
    "a name of lower-case letters, digits, - and _, 64 at most, beginning with a letter or digit"
)
TAGS = re.compile(r"([a-z0-9][a-z0-9_]{0,31}(, ?[a-z0-9][a-z0-9_]{0,31})*)?")
TAGS_ALLOWED = "a list of words of lower-case letters, digits and _, with commas between"
_DESIGNS_MAX = 10_000


def read_designs(
    path: str | Path, settings: Settings, notes: list[str] | None = None
) -> list[Design]:
    """Read and validate a table of designs, in its order; `notes` gathers what is to be said.

    Raises `InputError` that names the file, the line, the design, the column and what is allowed.
    """
    path, found = Path(path), []
    rows = list(read_table(path, COLUMNS, ("design",), _DESIGNS_MAX, "design"))
    designs = [_make_design(row, settings, f"{path}: line {line}", found) for line, row in rows]
    designs = _add_support_rows(designs, rows, settings, path)
    _check_unique(designs, [line for line, _ in rows], path)
    if notes is not None:
        notes += [f"{path}: {note}" for note in dict.fromkeys(found)]
    return designs


def select_designs(designs: Iterable[Design], tag: str, source: str = "designs") -> list[Design]:
    """Return the designs with a tag; raise `InputError` with the nearest tag if there are none."""
    designs = list(designs)
    chosen = [design for design in designs if tag in design.tags]
    if not chosen:
        known = sorted({tag for design in designs for tag in design.tags})
        hint = hint_nearest(tag, known) or f", known tags are {', '.join(known)}"
        raise InputError(f"{source}: tags: {tag!r}: no design has this tag{hint}")
    return chosen


def check_row(cells: Mapping[str, str], settings: Settings, place: str) -> Design:
    """Return the design of one row of cells; raises `InputError` that begins with `place`."""
    return _make_design(cells, settings, place, [])


def _make_design(
    cells: Mapping[str, str], settings: Settings, place: str, notes: list[str]
) -> Design:
    if not cells["design"]:
        raise InputError(f"{place}: design: the cell is empty: a name is due")
    where = f"{place}: design {cells['design']!r}"
    _check_name(cells["design"], where)
    reader = Reader(where, yaml=False, notes=notes)
    given = {
        name: known.convert(reader.read_value(known, parse_text(known, cell), known.key))
        for name, known in list_settings(DesignColumns).items()
        if (cell := cells.get(known.key))
    }
    tags = cells.get("tags", "")
    if not TAGS.fullmatch(tags):
        raise reader.refuse("tags", tags, TAGS_ALLOWED)
    words = dict.fromkeys(tag.strip() for tag in tags.split(",") if tag.strip())
    columns = vars(settings.defaults) | given
    design = Design(name=cells["design"], tags=tuple(words), **columns)
    check_outline(design, where)
    design = _settle_sides(settle_files(design, given, where), where)
    _check_edge_beam(design, where)
    _check_miura(design, settings, where)
    if design.panels:
        check_thickness(design, settings.sizing, where)
    if 0 < settings.limits.panels_max < design.panels:
        raise InputError(
            f"{where}: zigzag x strip: {design.zigzag} x {design.strip} lines are "
            f"{design.panels} panels: at most limits.panels_max = {settings.limits.panels_max} "
            "are allowed"
        )
    return design


def _settle_sides(design: Design, where: str) -> Design:
    """Return a design whose span is the shorter side of its plan; a square has no other sides."""
    if not (design.span_x or design.span_y):
        return design
    if design.folded != NONE:
        name = "span_x_m" if design.span_x else "span_y_m"
        raise InputError(
            f"{where}: {name}: given beside folded = {design.folded!r}, whose plan is its own: an "
            "empty cell is allowed"
        )
    x, y = design.sides
    if x == y:
        return replace(design, span=x, span_x=0.0, span_y=0.0)
    return replace(design, span=min(x, y), span_x=x, span_y=y)


def _add_support_rows(
    designs: list[Design],
    rows: list[tuple[int, dict[str, str]]],
    settings: Settings,
    path: Path,
) -> list[Design]:
    """Return the designs, those that name a set of the table of supports with its rows."""
    finder = SupportFinder(settings.supports)
    found = []
    for design, (line, _) in zip(designs, rows, strict=True):
        place = f"{path}: line {line}: design {design.name!r}: support"
        held = finder.find(design.support, place)
        found.append(replace(design, support_rows=held) if held else design)
    return found


def _check_name(name: str, where: str) -> None:
    if not NAME.fullmatch(name):
        raise InputError(f"{where}: design: {name!r}: {NAME_ALLOWED} is allowed")
    if name in RESERVED:
        raise InputError(f"{where}: design: this name is reserved, choose another one")


def _check_edge_beam(design: Design, where: str) -> None:
    depth, thickness = design.edge_beam_depth, design.edge_beam_thickness
    if bool(depth) != bool(thickness):
        given, missing = ("depth", "thickness") if depth else ("thickness", "depth")
        raise InputError(
            f"{where}: edge_beam_{missing}_m: 0 beside edge_beam_{given}_m = "
            f"{depth or thickness:g}: both above 0 are allowed, or none"
        )
    if depth and design.support == "all":
        raise InputError(
            f"{where}: edge_beam_depth_m: {depth:g}: with support all no border is free to carry "
            "an edge beam: 0 is allowed"
        )
    if depth and thickness >= abs(depth):
        raise InputError(
            f"{where}: edge_beam_thickness_m: {thickness:g}: less than the depth of the edge beam, "
            f"{abs(depth):g} m, is allowed"
        )


def _check_miura(design: Design, settings: Settings, where: str) -> None:
    for column in (*MIURA_COLUMNS, *OTHER_PARAMETERS):
        if getattr(design, column) and column not in PARAMETERS.get(design.pattern, ()):
            having = [name for name, columns in PARAMETERS.items() if column in columns]
            raise InputError(
                f"{where}: {column}: {getattr(design, column):g}: pattern {design.pattern} has no "
                f"such parameter: leave it empty, or take pattern {' or '.join(having)}"
            )
    angle = design.sector_angle_deg or math.degrees(settings.pattern.sector_angle)
    if design.sector_angle_deg and angle <= 45 and not design.rest_fold_angle_deg:
        raise InputError(
            f"{where}: sector_angle_deg: {angle:g}: above 45 is allowed where rest_fold_angle_deg "
            "is empty: below it no rest state has a Poisson's ratio of -1"
        )


def _check_unique(designs: list[Design], lines: list[int], path: Path) -> None:
    seen: dict[str, int] = {}
    for design, line in zip(designs, lines, strict=True):
        key = design.name.casefold()
        if key in seen:
            raise InputError(
                f"{path}: line {line}: design {design.name!r}: the name stands twice, first in "
                f"line {seen[key]}"
            )
        seen[key] = line


def check_defaults(settings: Settings, source: str) -> None:
    """Raise `InputError` if the default pattern or surface cannot be used."""
    check_pattern(settings.defaults.pattern, f"{source}: defaults")
    check_surface(settings.defaults.surface, f"{source}: defaults")
