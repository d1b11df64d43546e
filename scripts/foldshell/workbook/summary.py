"""Write `summary.xlsx`: one row per design below header and units, then overview and settings."""

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from foldshell.workbook.design import add_notes
from foldshell.workbook.styles import add_sheet, create_workbook, mark_above
from foldshell.workbook.tables import Row, make_columns, write_table

_SOURCES = (
    "Tsiamis, Oliva, Calvano, Algorithmic Design and Analysis of Architectural Origami, "
    "Nexus Network Journal 20 (2018) 59-73, doi 10.1007/s00004-017-0361-9",
)


def write_summary(
    path: str | Path,
    keys: Sequence[str],
    rows: Sequence[Row],
    settings: Mapping[str, Any],
    utilization_max: float = 1.0,
) -> None:
    """Write the sheets summary (the rows), overview (endings and their number) and notes."""
    with create_workbook(path, "Summary of the study") as (book, styles):
        sheet = add_sheet(book, "summary")
        first = write_table(sheet, styles, 0, make_columns(keys), rows, upright=True)
        last = first + max(len(rows), 1) - 1
        sheet.autofilter(1, 0, last, len(keys) - 1)
        for key in ("utilization_max", "utilization_p99"):
            column = list(keys).index(key)
            mark_above(sheet, styles, (first, column, last, column), utilization_max)
        overview = add_sheet(book, "overview", landscape=False)
        counts = Counter(str(row.get("state")) for row in rows)
        endings = [{"state": name, "designs": count} for name, count in sorted(counts.items())]
        write_table(overview, styles, 0, make_columns(("state", "designs")), endings)
        add_notes(book, styles, settings, {}, _SOURCES)
