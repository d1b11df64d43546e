"""The columns of summary.csv as the report shows them: words, unit, kind, verdicts."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from foldshell.records.entry import Entry, entries, strip_null
from foldshell.records.summary import SummaryRow
from foldshell.report.checks import Check
from foldshell.report.markup import Cell
from foldshell.workbook.styles import GOOD_VERDICTS

JUDGED = ("state", "crosscheck", "engineering")
HIDDEN = ("design", "tags", "settings_hash")
DEFAULT_LINES = ("volume_per_area_m", "utilization_mean", "utilization_p99",
                 "displacement_vertical_max_m", "buckling_factor_min")  # fmt: skip
"""Columns that parallel lines begin with."""
NEITHER = ("", "not possible", "not_applicable")
"""Verdicts that are neither good nor bad."""


@dataclass(frozen=True)
class Column:
    """A column: key in summary.csv, words with unit, whether it holds numbers, their factor to
    the unit shown, and whether charts begin with it."""

    key: str
    words: str
    numeric: bool
    factor: float = 1.0
    chosen: bool = False


GOVERNING = Column(
    "governing_share", "governs by the paper's criteria [% of its limit]", True, chosen=True
)


def choose_columns(rows: Sequence[SummaryRow]) -> list[Column]:
    """Return the columns in which a design has a value, the governing check after the verdicts."""
    columns = [
        _make_column(about)
        for key, about in entries(SummaryRow).items()
        if key not in HIDDEN and any(getattr(row, key) not in (None, "") for row in rows)
    ]
    columns.sort(key=lambda column: column.key not in JUDGED)
    place = sum(column.key in JUDGED for column in columns)
    return [*columns[:place], GOVERNING, *columns[place:]]


def _make_column(about: Entry) -> Column:
    key, numeric = about.key, strip_null(about.type) in (int, float)
    return Column(key, about.shown_label, numeric, about.factor, key in DEFAULT_LINES)


def make_row(
    row: SummaryRow, columns: Sequence[Column], governing: Check | None
) -> dict[str, Cell]:
    """Return the cells of a design by column: numbers in the unit shown, verdicts with a class."""
    cells = {}
    for column in columns:
        value = getattr(row, column.key, None)
        if column.key == GOVERNING.key:
            known = governing is not None and governing.ratio is not None
            cells[column.key] = Cell(100 * governing.ratio if known else None)
        elif column.numeric:
            cells[column.key] = Cell(None if value is None else column.factor * value)
        else:
            text = value or ""
            kind = judge(text) if column.key in JUDGED else ""
            cells[column.key] = Cell(text.replace("_", " ") or None, kind)
    return cells


def judge(text: str) -> str:
    """Return the class of a verdict; to have none is neither good nor bad."""
    if text in NEITHER:
        return ""
    return "good" if text in GOOD_VERDICTS else "bad"


def count_verdicts(rows: Sequence[SummaryRow]) -> dict[str, list[tuple[str, int, str]]]:
    """Return how many designs have each verdict: of sizing, cross-check, engineering and model.

    A verdict is its words, the count, and good or bad; a kind that no design has is empty.
    """
    kinds = {"sizing": "state", "cross-check": "crosscheck", "engineering checks": "engineering"}
    found = {
        words: Counter(getattr(row, key, None) or "" for row in rows)
        for words, key in kinds.items()
    }
    doubtful = sum(row.model_warnings is not None for row in rows)
    model = [("with warnings", doubtful, "bad"), ("without warnings", len(rows) - doubtful, "")]
    return {
        words: [(text.replace("_", " "), count, judge(text))
                for text, count in counts.most_common() if text]
        for words, counts in found.items()
    } | {"model": [verdict for verdict in model if verdict[1]]}  # fmt: skip
