"""The JSON Schema of config.yaml and of a row of designs.tsv, for editors and other programs."""

from foldshell.settings.allowed import describe_allowed
from foldshell.settings.check import COMBINATION_NAME, COMBINATIONS_MAX
from foldshell.settings.design import DesignColumns
from foldshell.settings.designs import NAME, NAME_ALLOWED, TAGS, TAGS_ALLOWED
from foldshell.settings.field import NUMBERS, Factors, Plain, Setting, list_groups, list_settings
from foldshell.settings.load_table import CASE_NAME
from foldshell.settings.study import Settings

_DIALECT = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
_TYPES = {float: "number", int: "integer", str: "string", bool: "boolean"}
_BOUNDS = {
    "minimum": "minimum",
    "above": "exclusiveMinimum",
    "maximum": "maximum",
    "below": "exclusiveMaximum",
}


def make_config_schema() -> Plain:
    """Return the schema of config.yaml."""
    return {**_DIALECT, "title": "Settings of the study", **_describe_group(Settings)}


def make_designs_schema() -> Plain:
    """Return the schema of one row of designs.tsv, numbers as numbers."""
    group = _describe_group(DesignColumns)
    name = {
        "type": "string",
        "pattern": f"^{NAME.pattern}$",
        "description": f"Name of the design and of its folder in results/, unique: {NAME_ALLOWED}.",
    }
    tags = {
        "type": "string",
        "pattern": f"^{TAGS.pattern}$",
        "description": f"Parts of the study: {TAGS_ALLOWED}.",
    }
    group["properties"] = {"design": name, **group["properties"], "tags": tags}
    return {**_DIALECT, **group, "title": "One row of the table of designs", "required": ["design"]}


def _describe_group(kind: type) -> Plain:
    parts = {known.key: _describe_setting(known) for known in list_settings(kind).values()}
    parts |= {name: _describe_group(nested) for name, nested in list_groups(kind).items()}
    return {
        "type": "object",
        "description": describe_group(kind),
        "additionalProperties": False,
        "properties": parts,
    }


def describe_group(kind: type) -> str:
    """Return what a group of settings is about: the docstring of its class, on one line."""
    return " ".join((kind.__doc__ or "").split())


def _describe_setting(known: Setting) -> Plain:
    default = list(known.default) if isinstance(known.default, tuple) else known.default
    rest = {
        "default": default,
        "description": f"{known.meaning} Allowed: {describe_allowed(known)}",
    }
    if known.unit:
        rest["unit"] = known.unit
    if known.kind == Factors:
        return {**_describe_factors(known), **rest}
    if known.kind == tuple[int, int]:
        items = {"type": "integer", **_bounds(known)}
        return {"type": "array", "minItems": 2, "maxItems": 2, "items": items, **rest}
    if known.kind == NUMBERS:
        return {"type": "array", "items": {"type": "number", **_bounds(known)}, **rest}
    if known.kind == tuple[str, ...]:
        items = {"enum": list(known.choices)} if known.choices else {"minLength": 1}
        items = {"type": "string", **items}
        names = {"type": "array", "minItems": 1, "uniqueItems": True, "items": items}
        return {**(names if known.choices else {"anyOf": [items, names]}), **rest}
    if known.choices:
        return {"type": "string", "enum": [*known.choices, *known.former], **rest}
    if known.ranges:
        ranges = [{"minimum": low, "maximum": high} for low, high in known.ranges]
        return {"type": "number", "anyOf": [{"const": 0}, *ranges], **rest}
    if known.kind is str:
        length = {"minLength": 1} | ({"maxLength": known.longest} if known.longest else {})
        return {"type": "string", **length, **rest}
    return {"type": _TYPES[known.kind], **_bounds(known), **rest}


def _bounds(known: Setting) -> Plain:
    values = {word: getattr(known, name) for name, word in _BOUNDS.items()}
    return {word: value for word, value in values.items() if value is not None}


def _describe_factors(known: Setting) -> Plain:
    number = {"type": "number", **_bounds(known)}
    return {
        "type": "object",
        "minProperties": 1,
        "maxProperties": COMBINATIONS_MAX,
        "propertyNames": {"pattern": f"^{COMBINATION_NAME.pattern}$"},
        "additionalProperties": {
            "type": "object",
            "minProperties": 1,
            "propertyNames": {"pattern": f"^{CASE_NAME.pattern}$"},
            "additionalProperties": number,
            "properties": {case: number for case in known.choices},
        },
    }
