"""The table of designs: read strictly, validate, fill in defaults, choose by tag."""

import csv
import functools
import io
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from foldshell.files.errors import InputError
from foldshell.files.meshes.read import FORMATS, is_mesh_file
from foldshell.settings.config_file import read_text
from foldshell.settings.nearest import hint_nearest
from foldshell.settings.options import Settings
from foldshell.settings.schema import TABLE, load_schema, validate
from foldshell.settings.units import convert_units

SURFACES = ("paraboloid", "hypar", "hypar_twist", "arch", "arch_strip")
COLUMNS = (
    "design",
    "pattern",
    "surface",
    "span_m",
    "height_m",
    "zigzag",
    "strip",
    "support",
    "fold_mode",
    "edge_beam_depth_m",
    "edge_beam_thickness_m",
    "tags",
)
# Names under results/ that are not designs, and device names that Windows cannot create.
_RESERVED = {"archive", "bench", "figures", "logs", "report", "schemas"}
_RESERVED |= {"con", "prn", "aux", "nul"}
_RESERVED |= {f"{device}{number}" for device in ("com", "lpt") for number in range(1, 10)}
_NUMBER = re.compile(r"[-+]?(0|[1-9][0-9]*)(\.[0-9]*)?([eE][-+]?[0-9]{1,3})?")
_DESIGNS_MAX = 10_000


@dataclass(frozen=True)
class Design:
    """One design of the study; lengths in m, zigzag and strip are counts of polylines, both sizes
    of the edge beam are 0 where there is none."""

    name: str
    pattern: str
    surface: str
    span: float
    height: float
    zigzag: int
    strip: int
    support: str
    fold_mode: str
    edge_beam_depth: float
    edge_beam_thickness: float
    tags: tuple[str, ...]

    @property
    def panels(self) -> int:
        """Number of panels, (zigzag - 1)(strip - 1)."""
        return (self.zigzag - 1) * (self.strip - 1)

    def to_row(self) -> dict[str, Any]:
        """Return the design as a plain row with the columns of designs.tsv."""
        row = {column: getattr(self, column.removesuffix("_m"), None) for column in COLUMNS}
        return {**row, "design": self.name, "tags": ",".join(self.tags)}


@functools.cache
def designs_schema() -> dict[str, Any]:
    """Return the schema of one row of designs.tsv."""
    return load_schema("designs.schema.yaml")


def read_designs(path: str | Path, settings: Settings) -> list[Design]:
    """Read and validate a table of designs, in its order.

    Raises `InputError` that names the file, the line, the design, the column and what is allowed.
    """
    path = Path(path)
    rows = _read_rows(path)
    defaults = _default_row(settings)
    designs = [_make_design(row, defaults, settings, f"{path}: line {line}") for line, row in rows]
    _check_unique(designs, [line for line, _ in rows], path)
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


def _read_rows(path: Path) -> list[tuple[int, dict[str, str]]]:
    text = read_text(path)
    lines = [
        (number, line)
        for number, line in enumerate(io.StringIO(text, newline=None), start=1)
        if line.strip() and not line.startswith("#")
    ]
    if not lines:
        raise InputError(f"{path}: the table is empty: a header line and a line a design are due")
    header_line, header_text = lines[0]
    header = _split(header_text)
    _check_header(header, f"{path}: line {header_line}")
    if len(lines) == 1:
        raise InputError(f"{path}: no design stands below the header: one line per design is due")
    if len(lines) - 1 > _DESIGNS_MAX:
        raise InputError(f"{path}: {len(lines) - 1} designs: at most {_DESIGNS_MAX} are allowed")
    rows = []
    for number, line in lines[1:]:
        cells = _split(line)
        if len(cells) != len(header):
            raise InputError(
                f"{path}: line {number}: {len(cells)} cells: {len(header)} are allowed, as many as "
                "the header has, with one tab between two"
            )
        rows.append((number, dict(zip(header, cells, strict=True))))
    return rows


def _split(line: str) -> list[str]:
    cells = next(csv.reader([line.rstrip("\r\n")], delimiter="\t", quoting=csv.QUOTE_NONE))
    return [cell.strip(" ") for cell in cells]


def _check_header(header: list[str], place: str) -> None:
    if len(header) == 1 and header[0] != "design":
        raise InputError(f"{place}: {header[0][:60]!r}: column names with tabs between are allowed")
    for index, column in enumerate(header):
        if column not in COLUMNS:
            hint = hint_nearest(column, COLUMNS) or f", allowed are {', '.join(COLUMNS)}"
            raise InputError(f"{place}: column {index + 1}: {column!r}: unknown column{hint}")
        if column in header[:index]:
            raise InputError(f"{place}: column {index + 1}: {column!r}: the column stands twice")
    if "design" not in header:
        raise InputError(f"{place}: the column 'design' is missing")


def _default_row(settings: Settings) -> dict[str, Any]:
    defaults = settings.defaults
    row = {column: getattr(defaults, column.removesuffix("_m"), None) for column in COLUMNS[1:]}
    return {**row, "tags": ""}


def _make_design(
    cells: Mapping[str, str], defaults: Mapping[str, Any], settings: Settings, place: str
) -> Design:
    if not cells["design"]:
        raise InputError(f"{place}: design: the cell is empty: a name is due")
    where = f"{place}: design {cells['design']!r}"
    given = {column: _parse(column, cell) for column, cell in cells.items() if cell}
    row = {**defaults, **given}
    validate(row, designs_schema(), where, TABLE)
    _check_name(row["design"], where)
    _check_surface(row["surface"], where)
    _check_edge_beam(row, where)
    values = convert_units({key: row[key] for key in COLUMNS if key not in ("design", "tags")})
    tags = tuple(tag.strip() for tag in row["tags"].split(",") if tag.strip())
    design = Design(name=row["design"], tags=tuple(dict.fromkeys(tags)), **values)
    if design.panels > settings.limits.panels_max:
        raise InputError(
            f"{where}: zigzag x strip: {design.zigzag} x {design.strip} lines are "
            f"{design.panels} panels: at most limits.panels_max = {settings.limits.panels_max} "
            "are allowed"
        )
    return design


def _parse(column: str, cell: str) -> Any:
    """Return the number in a cell of a number column; other text stays, for the schema to name.

    A whole number may be written with a decimal point, as in settings files: 15.0 is 15.
    """
    kind = designs_schema()["properties"][column]["type"]
    if kind not in ("integer", "number") or not _NUMBER.fullmatch(cell):
        return cell
    value = float(cell)
    return int(value) if kind == "integer" and value.is_integer() else value


def _check_name(name: str, where: str) -> None:
    if not re.fullmatch(design_name_pattern(), name):
        raise InputError(f"{where}: design: {designs_schema()['properties']['design']['allowed']}")
    if name in _RESERVED:
        raise InputError(f"{where}: design: this name is reserved, choose another one")


def design_name_pattern() -> str:
    """Return the regular expression that a design's name matches whole, for rules too."""
    return str(designs_schema()["properties"]["design"]["pattern"]).strip("^$")


def _check_surface(surface: str, where: str) -> None:
    if surface in SURFACES:
        return
    if is_mesh_file(surface):
        if not Path(surface).exists():
            raise InputError(f"{where}: surface: {surface!r}: no such file")
        return
    hint = hint_nearest(surface.casefold(), SURFACES)
    raise InputError(
        f"{where}: surface: {surface!r}: one of {', '.join(SURFACES)} or a mesh file "
        f"({', '.join(FORMATS)}) is allowed{hint}"
    )


def _check_edge_beam(row: Mapping[str, Any], where: str) -> None:
    depth, thickness = row["edge_beam_depth_m"], row["edge_beam_thickness_m"]
    if bool(depth) != bool(thickness):
        given, missing = ("depth", "thickness") if depth else ("thickness", "depth")
        raise InputError(
            f"{where}: edge_beam_{missing}_m: 0 beside edge_beam_{given}_m = "
            f"{depth or thickness:g}: both above 0 are allowed, or none"
        )
    if depth and row["support"] == "all":
        raise InputError(
            f"{where}: edge_beam_depth_m: {depth:g}: with support all no border is free to carry "
            "an edge beam: 0 is allowed"
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
    """Raise `InputError` if the default surface cannot be used."""
    _check_surface(settings.defaults.surface, f"{source}: defaults")
