"""Workbooks of plain tables, the same bytes for the same values."""

from collections.abc import Mapping, Sequence
from datetime import datetime
from pathlib import Path

from foldshell.files.whole import atomic_path

CREATED = datetime(2026, 1, 1)


def write_workbook(
    path: str | Path, tables: Mapping[str, Sequence[Sequence[object]]], title: str
) -> None:
    """Write one sheet for each table; its first row is a frozen head. None leaves a cell empty."""
    import xlsxwriter

    options = {"in_memory": True, "strings_to_formulas": False, "strings_to_urls": False}
    with atomic_path(path) as temporary:
        book = xlsxwriter.Workbook(str(temporary), options)
        book.set_properties({"title": title, "created": CREATED})
        head = book.add_format({"bold": True, "bottom": 1, "text_wrap": True, "valign": "top"})
        for name, rows in tables.items():
            page = book.add_worksheet(name)
            page.freeze_panes(1, 1)
            page.set_landscape()
            page.set_paper(9)
            page.fit_to_pages(1, 0)
            page.repeat_rows(0)
            for k, row in enumerate(rows):
                style = head if k == 0 else None
                for column, value in enumerate(row):
                    if value is not None and value != "":
                        page.write(k, column, value, style)
            if rows:
                page.autofit()
        book.close()
