"""Print set-up of the workbooks: what a wide table and a long header need on paper."""

import re
import zipfile

import openpyxl

from foldshell.workbook.styles import (
    LINE_HEIGHT,
    LINE_WIDTH,
    Line,
    Styles,
    add_sheet,
    create_workbook,
    print_in_blocks,
    write_header,
    write_lines,
)


def read_sheet(path):
    """Return the XML of the first sheet."""
    with zipfile.ZipFile(path) as package:
        return package.read("xl/worksheets/sheet1.xml").decode()


def test_wide_sheet_prints_on_a3_in_blocks_that_fit(tmp_path):
    """40 columns of 20 characters: A3 at 70 % takes 278, less the first: 12 columns a block."""
    with create_workbook(tmp_path / "a.xlsx", "a") as (book, _styles):
        print_in_blocks(book.add_worksheet("wide"), [20.0] * 40)
    text = read_sheet(tmp_path / "a.xlsx")
    assert 'paperSize="8"' in text and 'scale="70"' in text and "fitToPage" not in text
    breaks = [int(number) for number in re.findall(r'<brk id="(\d+)"', text)]
    assert breaks == [13, 25, 37]


def test_header_is_as_high_as_its_lines(tmp_path):
    """22 bold characters in a column of 14 need two lines, nothing is clipped."""
    with create_workbook(tmp_path / "a.xlsx", "a") as (book, styles):
        assert isinstance(styles, Styles)
        columns = [("utilization_panel_mean", "-", "decimal", 14.0), ("panel", "-", "integer", 9.0)]
        write_header(book.add_worksheet("panels"), styles, 0, columns)
    height = float(re.search(r'<row r="1"[^>]* ht="([\d.]+)"', read_sheet(tmp_path / "a.xlsx"))[1])
    assert height >= 2 * 13.5


def test_a_long_reason_is_wrapped_and_has_the_room(tmp_path):
    """Running on, it would make the sheet so wide that nothing on its page could be read."""
    path = tmp_path / "a.xlsx"
    with create_workbook(path, "a") as (book, styles):
        sheet = add_sheet(book, "summary", landscape=False)
        write_lines(sheet, styles, 2, [Line("reason", "x " * 450), Line("state", "converged")])
    sheet = openpyxl.load_workbook(path)["summary"]
    assert sheet["B3"].alignment.wrap_text and not sheet["B4"].alignment.wrap_text
    assert sheet.row_dimensions[3].height >= 900 / LINE_WIDTH * LINE_HEIGHT
    assert sheet.row_dimensions[4].height in (None, 15)
