"""What is generated from the classes of settings: config.yaml, its README, the JSON Schemas.

`python -m foldshell.settings.documentation FOLDER` (with `scripts` on the path) writes config.yaml
and README.md to a folder of settings, and both schemas beside this module.
"""

import json
import sys
from collections.abc import Mapping
from pathlib import Path

from foldshell.files.whole import write_text_if_changed
from foldshell.settings.allowed import describe_allowed
from foldshell.settings.design import DesignColumns
from foldshell.settings.designs import NAME_ALLOWED, TAGS_ALLOWED
from foldshell.settings.field import Setting, list_groups, list_settings
from foldshell.settings.schema import describe_group, make_config_schema, make_designs_schema
from foldshell.settings.study import Settings

SCHEMAS = Path(__file__).parent
"""Where `config.schema.json` and `designs.schema.json` are: they come with the library."""

_TABLE_HEAD = "| {} | default | allowed | meaning |\n|---|---|---|---|\n"


def generate_readme() -> str:
    """Return the text of config/README.md: one table per group of settings, and the columns."""
    parts = [
        "<!-- Generated from the classes in scripts/foldshell/settings by\n"
        "     `python -m foldshell.settings.documentation config`; do not edit. -->\n\n"
        "# Settings\n\n"
        "`config.yaml` holds the settings, `designs.tsv` the designs. Both are checked before any "
        "job\nstarts; an unknown key, a wrong type or a value out of range stops the run with one "
        "sentence.\nA setting that is left out takes its default. Units stand in the names. A "
        "whole number may be\nwritten 15 or 15.0.\n",
        _TABLE_HEAD.format("setting") + "".join(map(_row, list_settings(Settings).values())),
    ]
    parts += [
        f"## `{name}`\n\n{describe_group(kind)}\n\n"
        + _TABLE_HEAD.format("setting")
        + "".join(_rows("", kind))
        for name, kind in list_groups(Settings).items()
    ]
    parts.append(_designs_section())
    return "\n".join(parts)


def _rows(prefix: str, kind: type) -> list[str]:
    rows = [_row(known, prefix) for known in list_settings(kind).values()]
    for name, nested in list_groups(kind).items():
        rows += _rows(f"{prefix}{name}.", nested)
    return rows


def _row(known: Setting, prefix: str = "") -> str:
    cells = [f"`{prefix}{known.key}`", _show(known.default), _describe(known), known.meaning]
    return f"| {' | '.join(cells)} |\n"


def _describe(known: Setting) -> str:
    """Say what is allowed, old words too."""
    old = [f"{old} is read as {new}" for old, new in known.former.items()]
    return "; ".join([describe_allowed(known), *old])


def _show(value: object) -> str:
    if isinstance(value, Mapping):
        return "<br>".join(
            f"{name}: " + " + ".join(f"{factor:g} {case}" for case, factor in factors.items())
            for name, factors in value.items()
        )
    return f"`{show_yaml(value)}`"


def _designs_section() -> str:
    rows = "".join(
        f"| `{known.key}` | {known.unit} | {_describe(known)} | {known.meaning} |\n"
        for known in list_settings(DesignColumns).values()
    )
    return (
        "## `designs.tsv`\n\n"
        "Columns with tabs between, one row per design, lines that begin with # are remarks. Only\n"
        "`design` is needed; a column left out, or an empty cell, takes its value from `defaults`."
        "\n\n| column | unit | allowed | meaning |\n|---|---|---|---|\n"
        f"| `design` |  | {NAME_ALLOWED} | Name of the design and of its folder in results/, "
        f"unique. |\n{rows}"
        f"| `tags` |  | {TAGS_ALLOWED} | Parts of the study, words with commas between; "
        "`snakemake tag_<tag>` runs those designs. |\n"
    )


def generate_config() -> str:
    """Return the text of config/config.yaml: every setting at its default."""
    lines = ["# Settings at their defaults; config/README.md says what each one means.", ""]
    return "\n".join(lines + _yaml_lines(Settings, 0)) + "\n"


def _yaml_lines(kind: type, level: int) -> list[str]:
    indent, lines = "  " * level, []
    for known in list_settings(kind).values():
        if isinstance(known.default, Mapping):
            rows = [f"{indent}  {name}: {show_yaml(row)}" for name, row in known.default.items()]
            lines += [f"{indent}{known.key}:", *rows]
        else:
            lines.append(f"{indent}{known.key}: {show_yaml(known.default)}")
    for name, nested in list_groups(kind).items():
        lines += [""] if level == 0 else []
        lines += [f"{indent}{name}:", *_yaml_lines(nested, level + 1)]
    return lines


def show_yaml(value: object) -> str:
    """Return a value as YAML 1.1 and 1.2 both read it, on one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key}: {show_yaml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(show_yaml(item) for item in value) + "]"
    if isinstance(value, float) and "." not in repr(value):
        mantissa, _, exponent = f"{value:e}".partition("e")
        return f"{float(mantissa)}e{exponent}"
    return str(value)


def generate_schemas() -> dict[str, str]:
    """Return the texts of both schemas by the names of their files."""
    schemas = {"config": make_config_schema(), "designs": make_designs_schema()}
    return {
        f"{name}.schema.json": json.dumps(schema, indent=1) + "\n"
        for name, schema in schemas.items()
    }


def main(folder: str | Path) -> None:
    """Write config.yaml and README.md to a folder, and the schemas beside this module."""
    texts = {"README.md": generate_readme(), "config.yaml": generate_config()}
    for name, text in texts.items():
        write_text_if_changed(Path(folder) / name, text)
    for name, text in generate_schemas().items():
        write_text_if_changed(SCHEMAS / name, text)


if __name__ == "__main__":
    main(sys.argv[1])
