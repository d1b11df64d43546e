"""exports/index.html: the files of a design for other programs, and how to open them."""

from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import Any

STYLE = (
    "body{font:15px/1.5 system-ui,sans-serif;margin:2rem auto;max-width:70rem;padding:0 1rem;"
    "color:#222}table{border-collapse:collapse;width:100%}th,td{text-align:left;"
    "padding:.4rem .8rem;border-bottom:1px solid #ddd;vertical-align:top}"
    "th{background:#f4f4f4}code{background:#f4f4f4}"
    "a{color:#0b57a4}"
)


def write_index(folder: str | Path, design: str, records: Sequence[dict[str, Any]]) -> str:
    """Return the page: a row for each format whose files are there, or the command that makes them.

    `records` are those that jobs left in exports/records; `folder` is exports.
    """
    rows = []
    for record in records:
        links = []
        for name in record["files"]:
            path = Path(folder) / name
            if path.exists():
                size = path.stat().st_size / 1e6
                link = f'<a href="{escape(name)}">{escape(name)}</a>'
                links.append(f"{link} <small>{size:.2f} MB</small>")
        if links:
            words = (escape(record[key]) for key in ("format", "holds", "opens"))
            cells = [next(words), "<br>".join(links), *words]
            rows.append("<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>")
    head = "<tr><th>format</th><th>files</th><th>what they hold</th><th>how to open them</th></tr>"
    table = f"<table>{head}{''.join(rows)}</table>"
    none = "<p>There are none yet: <code>snakemake --cores 2 export</code> makes them.</p>"
    title = f"{escape(design)}: files for other programs"
    return (
        f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
        f"<style>{STYLE}</style></head><body><h1>{title}</h1>"
        '<p><a href="../page.html">page of the design</a></p>'
        f"{table if rows else none}</body></html>\n"
    )
