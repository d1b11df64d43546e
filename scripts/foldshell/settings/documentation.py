"""config/README.md and config/config.yaml, generated from the schemas.

`python -m foldshell.settings.documentation` (with `scripts` on the path) writes both anew.
"""

from collections.abc import Mapping
from typing import Any

from foldshell.files.whole import atomic_path
from foldshell.settings.schema import CONFIG_FOLDER, describe_allowed, load_schema

_TABLE_HEAD = "| {} | default | allowed | meaning |\n|---|---|---|---|\n"


def generate_readme() -> str:
    """Return the text of config/README.md: one table per group of settings, and the columns."""
    schema = load_schema("config.schema.yaml")
    parts = [
        "<!-- Generated from config.schema.yaml and designs.schema.yaml by\n"
        "     `python -m foldshell.settings.documentation`; do not edit. -->\n\n"
        "# Settings\n\n"
        "`config.yaml` holds the settings, `designs.tsv` the designs. Both are checked before any "
        "job\nstarts; an unknown key, a wrong type or a value out of range stops the run with one "
        "sentence.\nA setting that is left out takes its default. Units stand in the names.\n",
        _group_section("", schema),
    ]
    parts += [
        _group_section(key, part)
        for key, part in schema["properties"].items()
        if part.get("type") == "object"
    ]
    parts.append(_designs_section())
    return "\n".join(parts)


def _group_section(name: str, group: Mapping[str, Any]) -> str:
    rows = "".join(_rows("", group, nested=bool(name)))
    title = f"## `{name}`\n\n{group['description']}\n\n" if name else ""
    return title + _TABLE_HEAD.format("setting") + rows


def _rows(prefix: str, group: Mapping[str, Any], nested: bool) -> list[str]:
    rows = []
    for key, part in group["properties"].items():
        if "default" in part:
            cells = [f"`{prefix}{key}`", _show(part["default"]), _allowed(part)]
            rows.append(f"| {' | '.join(cells)} | {part['description']} |\n")
        elif nested:
            rows += _rows(f"{prefix}{key}.", part, nested)
    return rows


def _allowed(part: Mapping[str, Any]) -> str:
    if part.get("type") == "object":
        return "names with factors of SW, SDL, LL, WX, WY"
    return describe_allowed(part)


def _show(value: Any) -> str:
    if isinstance(value, Mapping):
        return "<br>".join(
            f"{name}: " + " + ".join(f"{factor:g} {case}" for case, factor in factors.items())
            for name, factors in value.items()
        )
    return f"`{show_yaml(value)}`"


def _designs_section() -> str:
    rows = "".join(
        f"| `{key}` | {part.get('unit', '')} | {describe_allowed(part)} | {part['description']} |\n"
        for key, part in load_schema("designs.schema.yaml")["properties"].items()
    )
    return (
        "## `designs.tsv`\n\n"
        "Columns with tabs between, one row per design, lines that begin with # are remarks. Only\n"
        "`design` is needed; a column left out, or an empty cell, takes its value from `defaults`."
        "\n\n| column | unit | allowed | meaning |\n|---|---|---|---|\n" + rows
    )


def generate_config() -> str:
    """Return the text of config/config.yaml: every setting at its default."""
    lines = ["# Settings at their defaults; config/README.md says what each one means.", ""]
    for key, part in load_schema("config.schema.yaml")["properties"].items():
        lines += _yaml_lines(key, part, 0)
    return "\n".join(lines) + "\n"


def _yaml_lines(key: str, part: Mapping[str, Any], level: int) -> list[str]:
    indent = "  " * level
    if "default" not in part:
        inner = [_yaml_lines(name, child, level + 1) for name, child in part["properties"].items()]
        space = [""] if level == 0 else []
        return [*space, f"{indent}{key}:", *(line for lines in inner for line in lines)]
    if isinstance(part["default"], Mapping):
        rows = [f"{indent}  {name}: {show_yaml(row)}" for name, row in part["default"].items()]
        return [f"{indent}{key}:", *rows]
    return [f"{indent}{key}: {show_yaml(part['default'])}"]


def show_yaml(value: Any) -> str:
    """Return a value as YAML 1.1 and 1.2 both read it, on one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key}: {show_yaml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(show_yaml(item) for item in value) + "]"
    if isinstance(value, float) and "." not in repr(value):
        mantissa, _, exponent = f"{value:e}".partition("e")
        return f"{float(mantissa)}e{exponent}"
    return str(value)


def main() -> None:
    """Write config/README.md and config/config.yaml."""
    for name, text in (("README.md", generate_readme()), ("config.yaml", generate_config())):
        with atomic_path(CONFIG_FOLDER / name) as temporary:
            temporary.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
