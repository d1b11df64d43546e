"""The look of every workbook, defined once: named formats, print set-up, header and units rows."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from foldshell.files.whole import atomic_path
from foldshell.records.entry import COUNT, entries

if TYPE_CHECKING:
    import xlsxwriter
    from xlsxwriter.format import Format
    from xlsxwriter.worksheet import Worksheet

# A fixed date: the same values give the same bytes.
_CREATED = datetime(2000, 1, 1, tzinfo=UTC).replace(tzinfo=None)
_BASE = {"font_name": "Arial", "font_size": 10, "valign": "vcenter"}
_INK, _RULE = "#1F2937", "#9CA3AF"
A3, A3_CHARACTERS, BLOCK_SCALE = 8, 195, 70
"""Number of A3 among paper sizes, characters of 10 points across it (landscape, within its
margins), and the per cent at which wide sheets are printed."""
CELL_MARGIN = 0.8
"""Room beside the characters of a cell, in characters."""
LINE_HEIGHT, HEADER_SHARE = 13.5, 1.2
"""Height of a line in points, and the room that a bold character of a header takes."""
LINE_WIDTH, LONG = 44.0, 48
"""Width of the values of a summary sheet, and the characters from which a text is wrapped there."""
Options = dict[str, object]
"""Options of XlsxWriter."""
_FORMATS: dict[str, Options] = {
    "title": {"bold": True, "font_size": 14, "font_color": _INK},
    "label": {"font_color": _INK},
    "text": {"align": "left", "indent": 1},
    "wrap": {"text_wrap": True, "align": "left", "valign": "vcenter", "indent": 1},
    "header": {
        "bold": True,
        "bg_color": "#E5E7EB",
        "bottom": 1,
        "bottom_color": _RULE,
        "valign": "bottom",
        "align": "left",
        "indent": 1,
    },
    "header_number": {
        "bold": True,
        "bg_color": "#E5E7EB",
        "bottom": 1,
        "bottom_color": _RULE,
        "align": "right",
        "text_wrap": True,
    },
    "header_upright": {
        "bold": True,
        "bg_color": "#E5E7EB",
        "bottom": 1,
        "bottom_color": _RULE,
        "align": "center",
        "valign": "bottom",
        "rotation": 90,
    },
    "unit": {"italic": True, "font_color": "#6B7280", "align": "right"},
    "unit_text": {"italic": True, "font_color": "#6B7280", "align": "left", "indent": 1},
    "integer": {"num_format": "0", "align": "right"},
    "metre": {"num_format": "0.0000", "align": "right"},
    "decimal": {"num_format": "0.000", "align": "right"},
    "general": {"num_format": "0.0#####", "align": "right"},
    "scientific": {"num_format": "0.00E+00", "align": "right"},
    "percent": {"num_format": "0.0%", "align": "right"},
    "change": {"num_format": "+0.0%;-0.0%;0.0%", "align": "right"},
    # Blue on pale yellow: the usual mark of a cell that a person may type into.
    "input": {"num_format": "0.0000", "font_color": "#0000FF", "bg_color": "#FFF9DB"},
    "input_count": {"num_format": "0", "font_color": "#0000FF", "bg_color": "#FFF9DB"},
    "input_text": {"align": "center", "font_color": "#0000FF", "bg_color": "#FFF9DB"},
    "good": {
        "bold": True,
        "indent": 1,
        "align": "left",
        "font_color": "#166534",
        "bg_color": "#DCFCE7",
    },
    "bad": {
        "bold": True,
        "indent": 1,
        "align": "left",
        "font_color": "#9F1239",
        "bg_color": "#FFE4E6",
    },
    "plain": {"bold": True, "indent": 1, "align": "left"},
}
_CONDITIONAL = {"above": {"font_color": "#9F1239", "bg_color": "#FFE4E6"}}
GOOD_VERDICTS = ("converged", "at_minimum_thickness", "pass", "passes", "sized", "yes", "ok")
JUDGED = ("state", "verdict", "crosscheck", "engineering")
"""Keys whose values are good or bad endings."""
_OPEN_VERDICTS = ("continue", "not analysed yet", "not_applicable", "")


class Styles:
    """The named formats of one workbook; `styles["header"]` makes each on its first use.

    A name with `_left` behind it is the same format, aligned to the left.
    """

    def __init__(self, book: xlsxwriter.Workbook) -> None:
        self._book = book
        self._made: dict[str, Format] = {}

    def __getitem__(self, name: str) -> Format:
        if name not in self._made:
            base = name.removesuffix("_left")
            own = _CONDITIONAL.get(name) or {**_BASE, **_FORMATS[base]}
            left = {"align": "left", "indent": 1} if base != name else {}
            self._made[name] = self._book.add_format({**own, **left})
        return self._made[name]

    def choose_verdict(self, verdict: str) -> Format:
        """Return green for a good ending, red for a bad one, plain while it goes on.

        What stands behind a colon is the reason and does not count.
        """
        ending = verdict.partition(":")[0]
        if ending in GOOD_VERDICTS:
            return self["good"]
        return self["plain"] if ending in _OPEN_VERDICTS else self["bad"]


@contextmanager
def create_workbook(path: str | Path, title: str) -> Iterator[tuple[xlsxwriter.Workbook, Styles]]:
    """Yield a new workbook and its formats; `path` appears when the block has succeeded.

    Texts stay texts, also those that begin with "=" or look like numbers or links.
    """
    import xlsxwriter

    options = {
        "in_memory": True,
        "strings_to_formulas": False,
        "strings_to_numbers": False,
        "strings_to_urls": False,
        "default_format_properties": {"font_name": "Arial", "font_size": 10},
    }
    with atomic_path(path) as temporary:
        book = xlsxwriter.Workbook(temporary, options)
        book.set_properties({"title": title, "author": "foldshell", "created": _CREATED})
        try:
            yield book, Styles(book)
        except BaseException:
            book.fileclosed = True
            raise
        book.close()


def add_sheet(book: xlsxwriter.Workbook, name: str, landscape: bool = True) -> Worksheet:
    """Add a sheet that prints on A4, fitted to the width, with its name and page below."""
    sheet = book.add_worksheet(name)
    sheet.set_paper(9)
    if landscape:
        sheet.set_landscape()
    sheet.fit_to_pages(1, 0)
    sheet.set_margins(left=0.5, right=0.5, top=0.6, bottom=0.7)
    sheet.set_footer("&L&8&F&C&8&A&R&8&P / &N")
    sheet.hide_gridlines(2)
    return sheet


def print_in_blocks(sheet: Worksheet, widths: Sequence[float]) -> None:
    """Print a wide sheet on A3 in blocks of columns, `widths` in characters, each behind the first
    column, which is repeated."""
    sheet.set_paper(A3)
    sheet.repeat_columns(0)
    sheet.set_print_scale(BLOCK_SCALE)
    taken = [width + CELL_MARGIN for width in widths]
    room = A3_CHARACTERS * 100 / BLOCK_SCALE - taken[0]
    breaks, used = [], 0.0
    for column, width in enumerate(taken[1:], start=1):
        if used + width > room:
            breaks.append(column)
            used = 0.0
        used += width
    sheet.set_v_pagebreaks(breaks)


def write_value(sheet: Worksheet, row: int, column: int, value: Any, style: Format) -> None:
    """Write a number, truth value or text; None, or NaN for no result, leaves an empty cell."""
    if value is None or value != value:
        sheet.write_blank(row, column, None, style)
    elif isinstance(value, bool):
        sheet.write_string(row, column, "yes" if value else "no", style)
    elif isinstance(value, int | float):
        sheet.write_number(row, column, value, style)
    else:
        sheet.write_string(row, column, str(value), style)


def count_lines(text: str, width: float) -> int:
    """Return the lines of a wrapped text in a column `width` characters wide; not every program
    finds the height of a row out itself."""
    return max(math.ceil(1.1 * len(text) / width), 1)


@dataclass(frozen=True)
class Line:
    """A labelled value of a summary sheet; one that is `judged` is coloured by what it says."""

    words: str
    value: Any
    unit: str = ""
    judged: bool = False


def make_lines(record: Any, keys: Iterable[str] | None = None) -> list[Line]:
    """Return lines of a record, of all its fields or of the named ones, by the words and units
    that they have there; those of fields that are left out are left out."""
    known = entries(type(record))
    lines = []
    for key in known if keys is None else keys:
        about = known[key]
        value = getattr(record, about.attribute)
        if value is not None or not about.left_out:
            unit = about.unit if about.unit not in (COUNT, "-") else ""
            lines.append(Line(about.words, value, unit, key in JUDGED))
    return lines


def write_lines(sheet: Worksheet, styles: Styles, row: int, lines: Iterable[Line]) -> int:
    """Write label, value and unit in three columns, from `row` on; return the next free row.

    A long text is wrapped: running on, it would make the printed sheet as wide as itself.
    """
    for line in lines:
        number = isinstance(line.value, int | float) and not isinstance(line.value, bool)
        style = styles[f"{choose_style(line.value)}_left"]
        if line.judged:
            style = styles.choose_verdict(str(line.value or ""))
        elif isinstance(line.value, str) and len(line.value) > LONG:
            style = styles["wrap"]
            sheet.set_row(row, LINE_HEIGHT * count_lines(line.value, LINE_WIDTH))
        sheet.write_string(row, 0, line.words, styles["label"])
        write_value(sheet, row, 1, line.value, style)
        sheet.write_string(row, 2, line.unit if number else "", styles["unit_text"])
        row += 1
    return row


def choose_style(value: Any) -> str:
    """Return the name of the format that suits a value of unknown meaning."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return "text"
    if isinstance(value, int):
        return "integer"
    return "general" if value == 0 or 1e-4 <= abs(value) < 1e7 else "scientific"


def write_header(
    sheet: Worksheet,
    styles: Styles,
    row: int,
    columns: Sequence[tuple[str, str, str, float]],
    upright: bool = False,
) -> None:
    """Write a header row and a units row of (name, unit, format, width), frozen and repeated."""
    number_header = "header_upright" if upright else "header_number"
    if upright:
        sheet.set_row(row, 5.6 * max(len(name) for name, *_ in columns))
    else:
        lines = max(math.ceil(HEADER_SHARE * len(name) / width) for name, _, _, width in columns)
        sheet.set_row(row, LINE_HEIGHT * max(lines, 1) + 3)
    for index, (name, unit, style, width) in enumerate(columns):
        text = style in ("text", "wrap")
        sheet.set_column(index, index, width if text or not upright else 9.0)
        sheet.write_string(row, index, name, styles["header" if text else number_header])
        sheet.write_string(row + 1, index, unit, styles["unit_text" if text else "unit"])
    sheet.freeze_panes(row + 2, 1)
    sheet.repeat_rows(row, row + 1)


def mark_above(
    sheet: Worksheet, styles: Styles, area: tuple[int, int, int, int], limit: float
) -> None:
    """Colour the numbers of an area red that are above a limit."""
    rule = {"type": "cell", "criteria": ">", "value": limit, "format": styles["above"]}
    sheet.conditional_format(*area, rule)
