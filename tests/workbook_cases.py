"""Small thickness workbooks, and the ways in which spreadsheets and people change them."""

import io
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

from foldshell.workbook.panels import ThicknessTable, make_panel_grid
from foldshell.workbook.styles import Line
from foldshell.workbook.write_thickness import write_thickness

LEAST, LARGEST = 0.04, 1.0
GRID = make_panel_grid(4, 5)  # 3 x 4 = 12 panels
THICKNESS = np.linspace(0.05, 0.25, 12)
SHEET_PART = "xl/worksheets/sheet2.xml"
SUMMARY = [
    Line("design", "a"),
    Line("iteration", 0),
    Line("verdict of analysis 00", "continue", judged=True),
    Line("volume of analysis 00", 12.5, "m3"),
]


def write_case(path: Path, **columns: object) -> Path:
    table = ThicknessTable(GRID, THICKNESS, **columns)  # type: ignore[arg-type]
    write_thickness(path, table, SUMMARY, LEAST, LARGEST)
    return path


def edit_with_openpyxl(path: Path, edit: Callable) -> Path:
    """Load, change and save as a person with a spreadsheet program would."""
    import openpyxl

    book = openpyxl.load_workbook(path)
    edit(book)
    book.save(path)
    return path


def rewrite_part(path: Path, part: str, change: Callable[[bytes], bytes]) -> Path:
    """Replace one part of the package."""
    with zipfile.ZipFile(path) as archive:
        parts = {info.filename: archive.read(info) for info in archive.infolist()}
    parts[part] = change(parts.get(part, b""))
    return write_parts(path, parts)


def write_parts(path: Path, parts: dict[str, bytes]) -> Path:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in parts.items():
            archive.writestr(name, data)
    path.write_bytes(buffer.getvalue())
    return path
