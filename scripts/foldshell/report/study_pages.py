"""Pages over all designs: summary, claims, verification, settings and versions."""

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from foldshell.report.markdown import render_markdown
from foldshell.report.markup import Cell, Table, make_table, render
from foldshell.workbook.styles import GOOD_VERDICTS

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
    "edge_strain_max": ("largest strain of an edge, folding [%]", 100),
    "planarity_max": ("planarity, largest [%]", 100),
    "iterations": ("iterations", 1),
    "reason": ("reason", 0),
}
"""Columns of the summary that the page shows: words, and the factor of numbers (0: text)."""


def read_rows(path: str | Path) -> list[dict[str, str]]:
    """Read the rows of summary.csv."""
    with Path(path).open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def write_summary_page(path: str | Path) -> str:
    """Return the page of summary.csv: a table that sorts by the column that is clicked."""
    rows = read_rows(path)
    counts: dict[str, int] = {}
    for row in rows:
        counts[row["state"]] = counts.get(row["state"], 0) + 1
    columns = {name: item for name, item in COLUMNS.items() if rows and name in rows[0]}
    return render(
        "summary.html",
        title="Summary",
        counts=", ".join(f"{n} {state.replace('_', ' ')}" for state, n in counts.items()),
        checked=sum(row["crosscheck"] == "pass" for row in rows),
        columns=list(columns.values()),
        rows=[(row["design"], _make_cells(row, columns)) for row in rows],
    )


def _make_cells(row: Mapping[str, str], columns: Mapping[str, tuple[str, float]]) -> list[Cell]:
    """Return a number, or a text with its class, for each column."""
    cells = []
    for key, (_, factor) in columns.items():
        text = row[key]
        if factor and text:
            cells.append(Cell(factor * float(text)))
        else:
            kind = _judge(text) if key in JUDGED else "number" if factor else ""
            cells.append(Cell(text.replace("_", " ") or "–", kind))
    return cells


def _judge(text: str) -> str:
    """Return the class of a verdict; to have none is neither good nor bad."""
    if text in ("", "not possible"):
        return ""
    return "good" if text in GOOD_VERDICTS else "bad"


def write_markdown_page(title: str, text: str) -> str:
    """Return the page of a Markdown text, whose first heading gives way to the title."""
    first, _, rest = text.partition("\n")
    words = render_markdown(rest if first.startswith("# ") else text)
    return render("text.html", title=title, text=words)


def write_settings_page(
    settings: Mapping[str, Any], study_hash: str, versions: Mapping[str, str]
) -> str:
    """Return the page of the settings by group, and of the versions they were used with."""
    groups = list_settings(settings)
    groups.append(("Versions", make_table(("program", "version"), sorted(versions.items()))))
    return render("settings.html", title="Settings and versions", digest=study_hash, groups=groups)


def list_settings(settings: Mapping[str, Any]) -> list[tuple[str, Table]]:
    """Return the settings of each group by their dotted names."""
    header = ("setting", "value")
    return [
        (name, make_table(header, [(".".join(path), _plain(v)) for path, v in _flatten(values)]))
        for name, values in settings.items()
    ]


def _flatten(values: Any, path: tuple[str, ...] = ()) -> Sequence[tuple[tuple[str, ...], Any]]:
    if not isinstance(values, Mapping):
        return [(path, values)]
    return [item for key, value in values.items() for item in _flatten(value, (*path, str(key)))]


def _plain(value: Any) -> str:
    return ", ".join(map(str, value)) if isinstance(value, list | tuple) else str(value)
