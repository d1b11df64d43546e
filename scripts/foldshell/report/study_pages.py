"""Pages over all designs: summary, claims, verification, settings and versions."""

from collections.abc import Mapping
from pathlib import Path

from foldshell.records.entry import Entry, entries, strip_null
from foldshell.records.summary import SummaryRow
from foldshell.records.table import read_rows
from foldshell.report.markdown import render_markdown
from foldshell.report.markup import Cell, Table, make_table, render
from foldshell.report.study_columns import judge
from foldshell.settings.stage import StageSettings, flatten

JUDGED = ("state", "crosscheck")
"""Columns whose words are good or bad."""
COLUMNS = (
    "state",
    "surface",
    "span_m",
    "height_m",
    "zigzag",
    "strip",
    "support",
    "volume_m3",
    "volume_per_area_m",
    "utilization_panel_mean_max",
    "utilization_p99",
    "utilization_mean",
    "displacement_vertical_max_m",
    "buckling_factor_min",
    "mesh_error",
    "crosscheck",
    "edge_strain_max",
    "planarity_max",
    "iterations",
    "edited_panels",
    "model_warnings",
    "reason",
)
"""Columns of the summary that the page shows."""


def write_summary_page(path: str | Path) -> str:
    """Return the page of summary.csv: a table that sorts by the column that is clicked.

    Raises `InputError` for a damaged table.
    """
    rows = read_rows(path, SummaryRow)
    counts: dict[str, int] = {}
    for row in rows:
        counts[row.state] = counts.get(row.state, 0) + 1
    columns = [entries(SummaryRow)[key] for key in COLUMNS]
    return render(
        "summary.html",
        title="Summary",
        counts=", ".join(f"{n} {state.replace('_', ' ')}" for state, n in counts.items()),
        checked=sum(row.crosscheck == "pass" for row in rows),
        columns=[(about.shown_label, _is_number(about)) for about in columns],
        rows=[(row.design, [_make_cell(row, about) for about in columns]) for row in rows],
    )


def _is_number(about: Entry) -> bool:
    return strip_null(about.type) in (int, float)


def _make_cell(row: SummaryRow, about: Entry) -> Cell:
    """Return a number in the unit of the page, or a text with its class."""
    value = getattr(row, about.attribute)
    if value is not None and _is_number(about):
        return Cell(about.factor * value)
    text = str(value or "")
    kind = judge(text) if about.key in JUDGED else "number" if _is_number(about) else ""
    return Cell(text.replace("_", " ") or "–", kind)


def write_markdown_page(title: str, text: str) -> str:
    """Return the page of a Markdown text, whose first heading gives way to the title."""
    first, _, rest = text.partition("\n")
    words = render_markdown(rest if first.startswith("# ") else text)
    return render("text.html", title=title, text=words)


def write_settings_page(
    settings: StageSettings, study_hash: str, versions: Mapping[str, str]
) -> str:
    """Return the page of the settings by group, and of the versions they were used with."""
    groups = list_settings(settings)
    groups.append(("Versions", make_table(("program", "version"), sorted(versions.items()))))
    return render("settings.html", title="Settings and versions", digest=study_hash, groups=groups)


def list_settings(settings: StageSettings) -> list[tuple[str, Table]]:
    """Return the settings of each group by their dotted names."""
    groups = settings.to_plain().items()
    return [(name, make_table(("setting", "value"), _list_texts(group))) for name, group in groups]


def _list_texts(group: Mapping[str, object]) -> list[tuple[str, str]]:
    return [(name, str(value)) for name, value in flatten(group)]
