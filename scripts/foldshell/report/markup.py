"""Values as the pages' templates take them, and the templates filled in: all text is escaped."""

import base64
import functools
import hashlib
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

FOLDER = Path(__file__).parent
JSON_OPTIONS = {"allow_nan": False, "ensure_ascii": False, "separators": (",", ":")}


@dataclass(frozen=True)
class Cell:
    """A table's cell: text or number, and a class (good, bad) that colours it."""

    value: Any
    kind: str = ""


@dataclass(frozen=True)
class Table:
    """Header, rows of cells, and which columns hold numbers, which stand at the right."""

    header: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    numeric: tuple[bool, ...]


def make_table(header: Sequence[str], rows: Iterable[Sequence[Any]]) -> Table:
    """Return a table of plain values and `Cell`s; a column of numbers and gaps is numeric."""
    cells = tuple(
        tuple(value if isinstance(value, Cell) else Cell(value) for value in row) for row in rows
    )
    numeric = tuple(bool(cells) and all(map(_is_number, column)) for column in zip(*cells))  # noqa: B905
    return Table(tuple(header), cells, numeric or (False,) * len(header))


def _is_number(cell: Cell) -> bool:
    value = cell.value
    return value is None or (isinstance(value, int | float) and not isinstance(value, bool))


def format_number(value: Any, digits: int = 4) -> str:
    """Return a value as people read it: 4 digits, no exponent where it can be avoided."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not isinstance(value, float):
        return str(value)
    if not math.isfinite(value):
        return "–"
    if value == 0 or 1e-3 <= abs(value) < 1e6:
        decimals = digits - 1 - (math.floor(math.log10(abs(value))) if value else 0)
        text = f"{value:.{max(decimals, 0)}f}"
        return text.rstrip("0").rstrip(".") if "." in text else text
    return f"{value:.2e}"


@functools.cache
def templates() -> Environment:
    """Return the environment of the templates: every value is escaped, a missing one an error."""
    environment = Environment(
        loader=FileSystemLoader(FOLDER / "templates"), autoescape=True, undefined=StrictUndefined,
        trim_blocks=True, lstrip_blocks=True, keep_trailing_newline=True, auto_reload=False,
    )  # fmt: skip
    environment.policies["json.dumps_kwargs"] = JSON_OPTIONS
    environment.filters["number"] = format_number
    environment.globals |= {"join_assets": join_assets, "fingerprint": fingerprint}
    return environment


def render(name: str, **values: Any) -> Markup:
    """Return a template filled in, as markup that other templates take as it is."""
    return Markup(templates().get_template(name).render(values))


def join_assets(names: Sequence[str]) -> Markup:
    """Return style sheets or scripts of this folder as one: the project's own, not escaped."""
    return Markup("".join((FOLDER / name).read_text(encoding="utf-8") for name in names))


def fingerprint(script: str) -> str:
    """Return what a page's policy calls the one script that it lets run."""
    return "sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode("ascii")
