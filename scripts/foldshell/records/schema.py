"""JSON Schemas of the result files, made from their record classes."""

import dataclasses
import typing
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from foldshell.files.whole import Json, write_json
from foldshell.records.catalogue import FILES, ResultFile
from foldshell.records.entry import Entry, entries, strip_null

DIALECT = "https://json-schema.org/draft/2020-12/schema"
SCALARS = {float: "number", int: "integer", str: "string", bool: "boolean"}
Schema = Json


def write_schemas(folder: str | Path) -> list[Path]:
    """Write `<name>.schema.json` of every result file; return their paths."""
    paths = [Path(folder) / f"{file.name}.schema.json" for file in FILES]
    for path, file in zip(paths, FILES, strict=True):
        write_json(path, make_schema(file))
    return paths


def make_schema(file: ResultFile) -> Schema:
    """Return the schema of a result file; of a table it is that of its rows with typed cells."""
    found: dict[str, Schema] = {}
    reference = _of_record(file.kind, found)
    if file.path.endswith(".csv"):  # a column stands whether its cells are empty or not
        columns = entries(file.kind).items()
        due = [key for key, about in columns if not about.left_out]
        found[file.kind.__name__]["required"] = due
    content = {"type": "array", "items": reference} if file.many else reference
    head = {"$schema": DIALECT, "title": file.path, "description": file.meaning}
    return {**head, **content, "$defs": found}


def _of_record(kind: type, found: dict[str, Schema]) -> Schema:
    """Return a reference to a record class, whose schema is added to `found`."""
    name = kind.__name__
    if name not in found:
        found[name] = {}
        known = entries(kind)
        found[name] = {
            "type": "object",
            "description": (kind.__doc__ or "").split("\n\n")[0].strip(),
            "properties": {key: _of_entry(about, found) for key, about in known.items()},
            "required": [key for key, about in known.items() if about.required],
            "additionalProperties": False,
        }
    return {"$ref": f"#/$defs/{name}"}


def _of_entry(about: Entry, found: dict[str, Schema]) -> Schema:
    hint = strip_null(about.type) if about.left_out else about.type
    schema = _of_type(hint, found) | {"description": about.meaning}
    return schema | ({"unit": about.unit} if about.unit else {})


def _of_type(hint: Any, found: dict[str, Schema]) -> Schema:
    origin, inner = typing.get_origin(hint), typing.get_args(hint)
    if strip_null(hint) is not hint:
        return _or_null(_of_type(strip_null(hint), found))
    if origin is typing.Literal:
        return {"enum": list(inner)}
    if origin is tuple:
        return _of_tuple(inner, found)
    if origin in (dict, Mapping):
        return {"type": "object", "additionalProperties": _of_type(inner[1], found)}
    if dataclasses.is_dataclass(hint):
        return _of_record(hint, found)
    return {"type": SCALARS[hint]} if hint in SCALARS else {}


def _or_null(schema: Schema) -> Schema:
    if isinstance(schema.get("type"), str):
        return {**schema, "type": [schema["type"], "null"]}
    return {"anyOf": [schema, {"type": "null"}]}


def _of_tuple(inner: tuple, found: dict[str, Schema]) -> Schema:
    if inner[-1] is Ellipsis:
        return {"type": "array", "items": _of_type(inner[0], found)}
    items = [_of_type(hint, found) for hint in inner]
    return {"type": "array", "prefixItems": items, "items": False, "minItems": len(items)}
