"""JSON Schema in YAML files: load, fill in defaults, validate with one sentence an error."""

import functools
import math
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import jsonschema
import yaml

from foldshell.files.errors import InputError
from foldshell.files.package_data import workflow_folder
from foldshell.files.plain_text import find_unsafe
from foldshell.settings.nearest import find_nearest, hint_nearest

CONFIG_FOLDER = workflow_folder() / "config"
YAML, TABLE = "yaml", "table"
_NUMBERS = {"number": "a number", "integer": "a whole number"}
_TYPES = {**_NUMBERS, "string": "text", "boolean": "true or false", "array": "a list"}


def load_schema(name: str, folder: Path = CONFIG_FOLDER) -> dict[str, Any]:
    """Read a schema file with every `$ref` (`file#/pointer` or `#/pointer`) written out."""
    document = _read_schema(folder / name)
    return _resolve(document, document, folder)


@functools.cache
def _read_schema(path: Path) -> dict[str, Any]:
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def _resolve(node: Any, document: Any, folder: Path) -> Any:
    if isinstance(node, list):
        return [_resolve(item, document, folder) for item in node]
    if not isinstance(node, dict):
        return node
    own = {k: _resolve(v, document, folder) for k, v in node.items() if k != "$ref"}
    if not isinstance(node.get("$ref"), str):
        return own
    file, _, pointer = node["$ref"].partition("#/")
    document = _read_schema(folder / file) if file else document
    target = document
    for step in pointer.split("/"):
        target = target[step]
    return {**_resolve(target, document, folder), **own}


def fill_defaults(schema: Mapping[str, Any], data: Mapping[str, Any]) -> dict[str, Any]:
    """Return valid `data` with missing keys at their defaults, and numbers of the schema's type.

    `2` and `2.0` for a number become the same float, so that they hash alike.
    """
    result = dict(data)
    for key, part in schema.get("properties", {}).items():
        if "default" in part:
            result[key] = _cast(result.get(key, part["default"]), part)
        elif part.get("type") == "object":
            result[key] = fill_defaults(part, result.get(key, {}))
    return result


def _cast(value: Any, part: Mapping[str, Any]) -> Any:
    cast = {"number": float, "integer": int}.get(str(part.get("type")))
    if part.get("type") == "array":
        return [_cast(item, part["items"]) for item in value]
    return cast(value) if cast else value


def iterate_leaves(
    schema: Mapping[str, Any], place: tuple[str, ...] = ()
) -> Iterator[tuple[tuple[str, ...], Mapping[str, Any]]]:
    """Yield (path of keys, schema) of every setting that has a default."""
    for key, part in schema.get("properties", {}).items():
        if "default" in part:
            yield (*place, key), part
        elif part.get("type") == "object":
            yield from iterate_leaves(part, (*place, key))


def describe_allowed(schema: Mapping[str, Any]) -> str:
    """Say in words what a schema allows, with its unit."""
    if "allowed" in schema:
        return str(schema["allowed"])
    if "enum" in schema:
        return "one of " + ", ".join(str(value) for value in schema["enum"])
    kind = schema.get("type")
    if kind in _NUMBERS:
        return _NUMBERS[kind] + _describe_range(schema)
    if kind == "array":
        return f"a list of {schema['minItems']} values, each {describe_allowed(schema['items'])}"
    if kind == "object":
        return "a group of keys with values"
    if kind == "string" and "maxLength" in schema:
        return f"text of 1 to {schema['maxLength']} characters"
    return _TYPES.get(str(kind), str(kind))


def _describe_range(schema: Mapping[str, Any]) -> str:
    low, high = schema.get("minimum"), schema.get("maximum")
    above, below = schema.get("exclusiveMinimum"), schema.get("exclusiveMaximum")
    words = [f"of at least {low:g}"] if low is not None else []
    words += [f"above {above:g}"] if above is not None else []
    words += [f"of at most {high:g}"] if high is not None else []
    words += [f"below {below:g}"] if below is not None else []
    unit = f" in {schema['unit']}" if "unit" in schema else ""
    return unit + (" " if words else "") + " and ".join(words)


def validate(data: Any, schema: Mapping[str, Any], source: str, kind: str = YAML) -> None:
    """Raise `InputError` with the first thing in `data` that `schema` does not allow.

    `kind` is that of the file that `data` come from, YAML or TABLE: hints speak of it.
    """
    _refuse_unfit(data, source, "")
    validator = jsonschema.Draft202012Validator(schema)
    errors = sorted(validator.iter_errors(data), key=_rank)
    if errors:
        raise InputError(f"{source}: {_sentence(errors[0], schema, kind)}")


def _rank(error: jsonschema.ValidationError) -> tuple[bool, list[str]]:
    unknown_first = error.validator != "additionalProperties"
    return unknown_first, [str(step) for step in error.absolute_path]


def _refuse_unfit(data: Any, source: str, place: str) -> None:
    if isinstance(data, float) and not math.isfinite(data):
        raise InputError(f"{source}: {place}: {data}: only finite numbers are allowed")
    unsafe = find_unsafe(data) if isinstance(data, str) else None
    if unsafe:
        raise InputError(f"{source}: {place}: {data!a}: {unsafe}: plain text is allowed")
    items = data.items() if isinstance(data, Mapping) else ()
    items = enumerate(data) if isinstance(data, list) else items
    for key, value in items:
        _refuse_unfit(value, source, join_place(place, key))


def join_place(place: str, key: Any) -> str:
    """Return `place.key`, or `place[3]` for an index."""
    if isinstance(key, int):
        return f"{place}[{key}]"
    return f"{place}.{key}" if place else str(key)


def _sentence(error: jsonschema.ValidationError, schema: Mapping[str, Any], kind: str) -> str:
    place = ""
    for step in error.absolute_path:
        place = join_place(place, step)
    part = error.schema
    if error.validator == "additionalProperties":
        known = list(part["properties"])
        key = next(key for key in error.instance if key not in known)
        return describe_unknown_key(join_place(place, key), str(key), place, known, schema)
    if error.validator == "required":
        missing = next(key for key in error.validator_value if key not in error.instance)
        return f"{join_place(place, missing)}: is missing"
    if error.validator in ("minProperties", "maxProperties", "minItems", "maxItems"):
        return f"{place}: {len(error.instance)} entries: {_describe_count(part)}"
    if "propertyNames" in error.absolute_schema_path:
        return (
            f"{place}: {error.instance!r}: a name of up to 16 letters, digits and _, "
            "beginning with a letter, is allowed"
        )
    hint = describe_hint(error.instance, part, kind)
    return f"{place}: {error.instance!r}: {describe_allowed(part)} is allowed{hint}"


def _describe_count(part: Mapping[str, Any]) -> str:
    low = part.get("minItems", part.get("minProperties"))
    high = part.get("maxItems", part.get("maxProperties"))
    if low == high:
        return f"exactly {low} are allowed"
    return f"at least {low} are needed" + (f" and at most {high} allowed" if high else "")


def describe_unknown_key(
    place: str, key: str, parent: str, known: list[str], schema: Mapping[str, Any]
) -> str:
    """Say that a key is unknown and which known one is nearest, in its group or elsewhere."""
    near = find_nearest(key, known)
    if near:
        return f"{place}: unknown key, the nearest is {join_place(parent, near)}"
    elsewhere = {leaf[-1]: ".".join(leaf) for leaf, _ in iterate_leaves(schema)}
    other = find_nearest(key, elsewhere, cutoff=0.8)
    if other:
        return f"{place}: unknown key, the nearest is {elsewhere[other]}"
    return f"{place}: unknown key, allowed are {', '.join(known)}"


def describe_hint(value: Any, schema: Mapping[str, Any], kind: str = YAML) -> str:
    """Say what was probably meant: a decimal comma, a number with an exponent, a near name."""
    if isinstance(value, str) and "enum" in schema:
        return hint_nearest(value.casefold(), schema["enum"])
    if not isinstance(value, str) or schema.get("type") not in _NUMBERS:
        return ""
    if re.fullmatch(r"[-+]?\d+,\d+", value.strip()):
        return f", write {value.strip().replace(',', '.')} with a decimal point"
    if kind == TABLE:
        return _describe_table_number(value)
    try:
        number = float(value)
    except ValueError:
        return ", the value is text"
    if not math.isfinite(number):
        return ""
    mantissa, _, exponent = f"{number:e}".partition("e")
    mantissa = mantissa.rstrip("0") + ("0" if mantissa.rstrip("0").endswith(".") else "")
    return f", the value is text in YAML: write {mantissa}e{exponent} without quotes"


def _describe_table_number(value: str) -> str:
    """Say what is wrong with a cell of a table that is no plain number."""
    if re.fullmatch(r"""(["']).*\1""", value):
        return ", write it without quotes"
    unit = re.fullmatch(r"[-+0-9.]+ *(m|mm|cm|in|ft|deg|%)", value)
    if unit:
        return f", write the number alone, without {unit[1]}"
    if re.fullmatch(r"[-+]?0[0-9]+(\.[0-9]*)?", value):
        return ", write it without leading zeros"
    if re.fullmatch(r"[-+]?\.[0-9]+", value):
        return ", write a digit before the point"
    return ", the value is text"
