"""explore.xlsx: all candidates of an exploration, the best of them, and how it was searched."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.records.candidate import CandidateRecord, list_measures
from foldshell.records.entry import entries
from foldshell.settings.exploration import Exploration
from foldshell.settings.stage import flatten, to_plain
from foldshell.workbook.design import add_notes
from foldshell.workbook.styles import add_sheet, create_workbook
from foldshell.workbook.tables import Column, make_column, write_table


def write_explored_workbook(
    path: str | Path,
    exploration: Exploration,
    records: Sequence[CandidateRecord],
    best: Sequence[CandidateRecord],
) -> None:
    """Write the sheets best, candidates (one row each) and notes."""
    about = entries(CandidateRecord)
    names = exploration.columns
    columns = [Column("candidate", "", "text", 11.0)]
    columns += [_column(exploration, name) for name in names]
    judged = exploration.needs_engineering
    measures = list_measures(judged)
    columns += [make_column(about[name]) for name in measures]
    columns += [Column("state", "", "text", 16.0), Column("feasible", "", "text", 9.0)]
    columns += [Column("broken", "", "text", 24.0), Column("reason", "", "wrap", 50.0)]
    if judged:
        columns += [Column("engineering", "", "text", 12.0)]
        columns += [Column("engineering reason", "", "wrap", 50.0)]
    with create_workbook(path, f"Exploration {exploration.name}") as (book, styles):
        for title, rows in (("best", best), ("candidates", records)):
            sheet = add_sheet(book, title)
            cells = [_cells(record, names, measures, judged) for record in rows]
            write_table(sheet, styles, 0, columns, cells, upright=True)
            sheet.autofilter(1, 0, max(len(rows), 1) + 1, len(columns) - 1)
        notes = [("exploration", exploration.name), ("aims", ", ".join(exploration.aims))]
        notes += [
            (f"base.{name}", value) for name, value in exploration.base.items() if value != ""
        ]
        for variable in exploration.variables:
            said = variable.choices or (variable.low, variable.high)
            notes.append((f"variables.{variable.name}", " to ".join(map(str, said))))
        notes += flatten({"limits": to_plain(exploration.limits)})
        notes += flatten({"search": to_plain(exploration.search)})
        add_notes(book, styles, notes, {}, ())


def _column(exploration: Exploration, name: str) -> Column:
    variable = next((v for v in exploration.variables if v.name == name), None)
    if variable is None or variable.choices:
        return Column(name, "", "text", 11.0)
    unit = "deg" if name.endswith("_deg") else "m" if name.endswith("_m") else "-"
    return Column(name, unit, "integer" if variable.whole else "decimal", 10.0)


def _cells(
    record: CandidateRecord, names: Sequence[str], measures: Sequence[str], judged: bool
) -> list[object]:
    values = [record.value_of(name) for name in names]
    numbers = [getattr(record, name) for name in measures]
    ends = [record.state, "yes" if record.feasible else "no", ", ".join(record.broken)]
    more = [record.engineering or "", record.engineering_reason or ""] if judged else []
    return [record.candidate, *values, *numbers, *ends, record.reason, *more]
