"""Small pieces of HTML whose texts are escaped, and plain data that is safe inside a script."""

import html
import json
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

ESCAPES = {"<": "\\u003c", ">": "\\u003e", "&": "\\u0026", "\u2028": "\\u2028", "\u2029": "\\u2029"}
POLICY = (
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: "
    "'self' file:"
)
"""Forbids a page to ask any host for anything."""


@dataclass(frozen=True)
class Cell:
    """A table's cell: text or number, and a class (good, bad) that colours it."""

    value: Any
    kind: str = ""


def escape(text: Any) -> str:
    """Return a text that is safe between tags and inside quoted attributes."""
    return html.escape(str(text), quote=True)


def dump_json(data: Any) -> str:
    """Return JSON that may stand inside a script element; nan and inf are refused."""
    text = json.dumps(data, allow_nan=False, ensure_ascii=False, separators=(",", ":"))
    for character, replacement in ESCAPES.items():
        text = text.replace(character, replacement)
    return text


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


def make_table(header: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """Return a table; numbers stand at the right, `Cell` values are coloured."""
    rows = [list(row) for row in rows]
    numeric = [bool(rows) and all(_is_number(row[k]) for row in rows) for k in range(len(header))]
    head = "".join(
        f"<th{' class=number' if n else ''}>{escape(name)}</th>"
        for name, n in zip(header, numeric, strict=True)
    )
    body = "".join("<tr>" + "".join(map(_make_cell, row, numeric)) + "</tr>\n" for row in rows)
    return (
        f'<div class="scroll"><table><thead><tr>{head}</tr></thead>'
        f"<tbody>\n{body}</tbody></table></div>"
    )


def _is_number(value: Any) -> bool:
    value = value.value if isinstance(value, Cell) else value
    return value is None or (isinstance(value, int | float) and not isinstance(value, bool))


def _make_cell(value: Any, numeric: bool) -> str:
    kind = value.kind if isinstance(value, Cell) else ""
    value = value.value if isinstance(value, Cell) else value
    names = " ".join(filter(None, ["number" if numeric else "", kind]))
    return f"<td{f' class={chr(34)}{names}{chr(34)}' if names else ''}>" + (
        f"{escape(format_number(value))}</td>"
    )


def make_page(title: str, style: str, body: str) -> str:
    """Return a whole page that asks no host for anything."""
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{POLICY}">
<link rel="icon" href="data:,">
<title>{escape(title)}</title>
<style>
{style}
</style>
</head>
<body>
{body}
</body>
</html>
"""
