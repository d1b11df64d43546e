"""Write `summary.xlsx`: one row per design below header and units, then overview and settings."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from foldshell.records.analysis import DECIDES
from foldshell.records.summary import SummaryRow
from foldshell.settings.stage import StageSettings, flatten
from foldshell.workbook.design import add_notes
from foldshell.workbook.styles import add_sheet, create_workbook, mark_above
from foldshell.workbook.tables import Column, write_records, write_table

_SOURCES = (
    "Tsiamis, Oliva, Calvano, Algorithmic Design and Analysis of Architectural Origami, "
    "Nexus Network Journal 20 (2018) 59-73, doi 10.1007/s00004-017-0361-9",
)

_ENDINGS = [Column("state", "", "text", 24.0), Column("designs", "-", "integer", 10.0)]


def write_summary(
    path: str | Path,
    rows: Sequence[SummaryRow],
    settings: StageSettings,
    study_hash: str,
) -> None:
    """Write the sheets summary (the rows), overview (endings and their number) and notes.

    What the loop holds against the limit of utilization by its measure is marked where it is above.
    `settings` are those of the stage `study`, `study_hash` the hash of all its designs.
    """
    with create_workbook(path, "Summary of the study") as (book, styles):
        sheet = add_sheet(book, "summary")
        keys = [about.key for about in write_records(sheet, styles, SummaryRow, rows)]
        last = max(len(rows), 1) + 1
        sheet.autofilter(1, 0, last, len(keys) - 1)
        decides = DECIDES[settings.sizing.measure]
        if decides in keys:
            place = 2, keys.index(decides), last, keys.index(decides)
            mark_above(sheet, styles, place, settings.sizing.utilization_max)
        overview = add_sheet(book, "overview", landscape=False)
        counts = Counter(row.state for row in rows)
        write_table(overview, styles, 0, _ENDINGS, sorted(counts.items()))
        notes = [*flatten(settings.to_plain()), ("study_hash", study_hash)]
        add_notes(book, styles, notes, {}, _SOURCES)
