"""docs/records.md: every result file, key by key, made from the record classes."""

import dataclasses
import typing
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from foldshell.records.arrays import array_entries
from foldshell.records.catalogue import ARRAYS, FILES, ResultFile
from foldshell.records.entry import entries, strip_null

HEAD = """# Result files, key by key

This page is made from the classes in `scripts/foldshell/records/`, which read and write these
files: `PYTHONPATH=scripts python -m foldshell.records` prints it. A run writes the same as JSON
Schemas into `results/schemas/`, one per file, beside the results; those of tables describe a row.

Paths are below `results/`; NN is an iteration, 00, 01, ... The unit `count` is that of whole
numbers. A key in parentheses stands only where there is something to say. Numbers are in m, kN,
kPa and rad unless the unit says otherwise; z is up, tension positive, a downward displacement
positive where its name says `down` or `vertical`.
"""
SCALARS = {float: "number", int: "whole number", str: "text", bool: "true or false"}


def write_documentation() -> str:
    """Return the page."""
    told: set[type] = set()
    parts = [HEAD, *(_write_file(file, told) for file in FILES), "## Arrays\n", AXES]
    return "\n".join([*parts, *(_write_arrays(file) for file in ARRAYS)])


AXES = """Axes: P sized panels, B panels of an edge beam, E elements, K result cells of an element,
C combinations (strength first), N nodes, D unknowns of the shell model, F those that are free,
M linearised constraints, Q is P or 0; of the sheet V vertices, T facets, of its mesh L nodes of an
element, G edges of facets, J nodes along one, S supported edges of facets, H supported nodes (in
mesh.npz vertices, facets and panels of an edge beam stand after those of the sheet). Names in
parentheses may be missing.
"""


def _write_file(file: ResultFile, told: set[type]) -> str:
    head = f"## {file.path}\n\n{file.meaning[0].upper()}{file.meaning[1:]}.\n"
    return "\n".join([head, *_write_record(file.kind, told, False)])


def _write_record(kind: type, told: set[type], named: bool) -> list[str]:
    """Return the table of a class and those of the classes inside, each once on the page."""
    if kind in told:
        return [f"The keys of {kind.__name__} stand above.\n"] if not named else []
    told.add(kind)
    rows = [
        (
            f"`{key}`" if about.required or not about.left_out else f"(`{key}`)",
            _name_type(strip_null(about.type) if about.left_out else about.type),
            about.unit or " ",
            about.meaning,
        )
        for key, about in entries(kind).items()
    ]
    title = [f"### {kind.__name__}\n\n{(kind.__doc__ or '').split(chr(10))[0]}\n"] if named else []
    inner = [one for about in entries(kind).values() for one in _inner_records(about.type)]
    tables = [text for one in inner for text in _write_record(one, told, True)]
    return [*title, _make_table(("key", "type", "unit", "meaning"), rows), *tables]


def _write_arrays(file: ResultFile) -> str:
    rows = [
        (
            f"`{name}`" if about.required else f"(`{name}`)",
            ", ".join(about.axes) or "one value",
            about.unit or " ",
            about.meaning,
        )
        for name, about in array_entries(file.kind).items()
    ]
    return f"### {file.path}\n\n{_make_table(('array', 'axes', 'unit', 'meaning'), rows)}"


def _make_table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


def _name_type(hint: Any) -> str:
    """Return a type in words."""
    origin, inner = typing.get_origin(hint), typing.get_args(hint)
    if strip_null(hint) is not hint:
        return f"{_name_type(strip_null(hint))} or null"
    if origin is typing.Literal:
        return " \\| ".join(map(str, inner))
    if origin is tuple:
        count = "" if inner[-1] is Ellipsis else f"{len(inner)} of "
        return f"list: {count}{_name_type(inner[0])}"
    if origin in (dict, Mapping):
        return f"by name: {_name_type(inner[1])}"
    return SCALARS.get(hint, getattr(hint, "__name__", "anything").replace("Any", "anything"))


def _inner_records(hint: Any) -> list[type]:
    """Return the record classes that a type is made of."""
    if dataclasses.is_dataclass(hint):
        return [hint]
    return [one for part in typing.get_args(hint) for one in _inner_records(part)]
