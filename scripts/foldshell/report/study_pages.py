"""Pages over all designs: summary, claims, verification, settings and versions."""

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from foldshell.report.markdown import render_markdown
from foldshell.report.markup import escape, format_number, make_page, make_table
from foldshell.workbook.styles import GOOD_VERDICTS

FOLDER = Path(__file__).parent
JUDGED = ("state", "crosscheck")
"""Columns whose words are good or bad."""
COLUMNS: dict[str, tuple[str, float]] = {
    "state": ("verdict", 0),
    "surface": ("surface", 0),
    "span_m": ("span [m]", 1),
    "height_m": ("height [m]", 1),
    "zigzag": ("zig-zags", 1),
    "strip": ("strips", 1),
    "support": ("supported", 0),
    "volume_m3": ("volume [m³]", 1),
    "volume_per_area_m": ("volume / area [mm]", 1e3),
    "utilization_mean": ("utilization, mean [-]", 1),
    "utilization_p99": ("utilization, 99 % [-]", 1),
    "displacement_vertical_max_m": ("displacement, down [mm]", 1e3),
    "buckling_factor_min": ("buckling factor [-]", 1),
    "mesh_error": ("mesh error [%]", 100),
    "crosscheck": ("cross-check", 0),
    "iterations": ("iterations", 1),
    "reason": ("reason", 0),
}
"""Columns of the summary that the page shows: words, and the factor of numbers (0: text)."""


def write_summary_page(path: str | Path) -> str:
    """Return the page of summary.csv: a table that sorts by the column that is clicked."""
    with Path(path).open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    counts: dict[str, int] = {}
    for row in rows:
        counts[row["state"]] = counts.get(row["state"], 0) + 1
    words = ", ".join(f"{count} {state.replace('_', ' ')}" for state, count in counts.items())
    checked = sum(row["crosscheck"] == "pass" for row in rows)
    columns = {name: item for name, item in COLUMNS.items() if rows and name in rows[0]}
    head = "".join(
        f'<th{" class=number" if factor else ""}><button type="button">{escape(text)}</button></th>'
        for text, factor in (("design", 0), *columns.values())
    )
    body = "\n".join(_write_row(row, columns) for row in rows)
    lead = (
        f"{words}: {len(rows)} in all. The independent code agrees within its tolerances on "
        f"{checked}. A click on a heading sorts; outside the report names lead to pages."
    )
    table = (
        f'<div class="scroll"><table id="summary"><thead><tr>{head}</tr></thead>'
        f"<tbody>\n{body}\n</tbody></table></div>"
    )
    script = f"<script>\n{_read('summary.js')}\n</script>"
    return write_study_page("Summary", f"<p>{escape(lead)}</p>{table}{script}")


def _write_row(row: Mapping[str, str], columns: Mapping[str, tuple[str, float]]) -> str:
    name = escape(row["design"])
    cells = [f'<td><a href="../{name}/page.html">{name}</a></td>']
    for key, (_, factor) in columns.items():
        text = row[key]
        if factor and text:
            value = factor * float(text)
            cells.append(f'<td class="number" data-value="{value!r}">{format_number(value)}</td>')
        else:
            kind = _judge(text) if key in JUDGED else "number" if factor else ""
            cells.append(f'<td class="{kind}">{escape(text.replace("_", " ") or "–")}</td>')
    return f"<tr>{''.join(cells)}</tr>"


def _judge(text: str) -> str:
    """Return the class of a verdict; to have none is neither good nor bad."""
    if text in ("", "not possible"):
        return ""
    return "good" if text in GOOD_VERDICTS else "bad"


def write_markdown_page(title: str, text: str) -> str:
    """Return the page of a Markdown text, whose first heading gives way to the title."""
    first, _, rest = text.partition("\n")
    return write_study_page(title, render_markdown(rest if first.startswith("# ") else text))


def write_settings_page(
    settings: Mapping[str, Any], settings_hash: str, versions: Mapping[str, str]
) -> str:
    """Return the page of the settings by group, and of the versions they were used with."""
    parts = [f"<p>Hash of all settings that change results: <code>{settings_hash}</code>. Units: "
             "m, kN, kPa, rad.</p>"]  # fmt: skip
    for group, values in settings.items():
        rows = [(".".join(path), _plain(value)) for path, value in _flatten(values)]
        parts.append(f"<h2>{escape(group)}</h2>{make_table(('setting', 'value'), rows)}")
    rows = sorted(versions.items())
    parts.append(f"<h2>Versions</h2>{make_table(('program', 'version'), rows)}")
    return write_study_page("Settings and versions", "\n".join(parts))


def write_study_page(title: str, body: str) -> str:
    """Return a page with the style of a design's page."""
    content = f"<header><h1>{escape(title)}</h1></header>\n<main>\n{body}\n</main>"
    return make_page(title, _read("page.css"), content)


def _flatten(values: Any, path: tuple[str, ...] = ()) -> Sequence[tuple[tuple[str, ...], Any]]:
    if not isinstance(values, Mapping):
        return [(path, values)]
    return [item for key, value in values.items() for item in _flatten(value, (*path, str(key)))]


def _plain(value: Any) -> str:
    return ", ".join(map(str, value)) if isinstance(value, list | tuple) else str(value)


def _read(name: str) -> str:
    return (FOLDER / name).read_text(encoding="utf-8")
