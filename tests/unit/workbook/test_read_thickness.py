"""Edits by people and spreadsheets: harmless ones are read, the rest is refused by its cell."""

import datetime

import numpy as np
import pytest

from foldshell.files.errors import InputError
from foldshell.sizing.rounding import round_thickness
from foldshell.workbook.read_thickness import read_thickness
from workbook_cases import (
    GRID,
    LARGEST,
    LEAST,
    SHEET_PART,
    THICKNESS,
    edit_with_openpyxl,
    rewrite_part,
    write_case,
)


@pytest.fixture
def path(tmp_path):
    return write_case(tmp_path / "thickness.xlsx")


def read(path):
    return read_thickness(path, GRID, LEAST, LARGEST)


def set_cell(name, value, number_format=None):
    def edit(book):
        cell = book["thickness"][name]
        cell.value = value
        if number_format:
            cell.number_format = number_format

    return edit


def shuffle_rows(book):
    sheet = book["thickness"]
    rows = [[cell.value for cell in row] for row in sheet.iter_rows(min_row=3)]
    for target, row in zip(sheet.iter_rows(min_row=3), rows[::-1], strict=True):
        for cell, value in zip(target, row, strict=True):
            cell.value = value


def swap_columns(book):
    sheet = book["thickness"]
    for row in sheet.iter_rows(max_col=4):
        row[0].value, row[3].value = row[3].value, row[0].value


HARMLESS = {
    "saved": lambda book: None,
    "shuffled": shuffle_rows,
    "column inserted": lambda book: book["thickness"].insert_cols(2),
    "columns swapped": swap_columns,
    "indices deleted": lambda book: book["thickness"].delete_cols(2, 2),
    "rows above": lambda book: book["thickness"].insert_rows(1, 5),
    "title above": lambda book: (
        book["thickness"].insert_rows(1, 2),
        book["thickness"].__setitem__("A1", "thickness of my roof"),
    ),
    "blank rows between": lambda book: book["thickness"].insert_rows(6, 3),
    "remark beside": set_cell("K5", "checked by A. B."),
    "header in capitals": set_cell("D1", " Thickness "),
    "unit in brackets": set_cell("D2", "[m]"),
    "sheet added": lambda book: book.create_sheet("mine", 0),
    "summary deleted": lambda book: book.remove(book["summary"]),
    "other format": set_cell("D5", float(round_thickness(THICKNESS)[2]), "0.0 [Red]"),
    "panel as text": set_cell("A5", "2"),
    "stray blank": set_cell("M40", "  "),
}


@pytest.mark.parametrize("edit", HARMLESS.values(), ids=HARMLESS)
def test_harmless_edits_change_nothing(path, edit):
    assert (read(edit_with_openpyxl(path, edit)) == round_thickness(THICKNESS)).all()


@pytest.mark.parametrize(
    ("value", "expected"),
    [(0.125, 0.125), ("0.125", 0.125), (" .5 ", 0.5), ("1.25e-1", 0.125), (1, 1.0), (LEAST, LEAST)],
)
def test_numbers_and_dotted_text_are_read(path, value, expected):
    result = read(edit_with_openpyxl(path, set_cell("D5", value)))
    due = round_thickness(THICKNESS)
    due[2] = expected
    assert (result == due).all()


def test_fifteen_digits_of_a_spreadsheet_do_not_matter(path):
    """LibreOffice rounds each number to 15 digits on saving; 12 are kept here."""
    value = round_thickness(THICKNESS)[1]
    result = read(edit_with_openpyxl(path, set_cell("D4", float(f"{value * (1 + 3e-15):.15g}"))))
    assert result[1] == value


def test_formula_with_its_value_is_read(path):
    def change(data: bytes) -> bytes:
        return data.replace(b"<v>0.05</v>", b"<f>0.1/2</f><v>0.05</v>", 1)

    assert (read(rewrite_part(path, SHEET_PART, change)) == round_thickness(THICKNESS)).all()


REFUSED = {
    "decimal comma": (set_cell("D5", "0,125"), r"cell D5: '0,125'.*write 0\.125"),
    "unit": (set_cell("D5", "120 mm"), r"cell D5: '120 mm'.*write 0\.12 without a unit"),
    "word": (set_cell("D5", "thin"), "cell D5: 'thin': a number in m from 0.04 to 1"),
    "text nan": (set_cell("D5", "nan"), "cell D5: 'nan'"),
    "text inf": (set_cell("D5", "inf"), "cell D5: 'inf'"),
    "millimetres": (set_cell("D5", 120), r"cell D5: 120:.*looks like mm: write 0\.12"),
    "negative": (set_cell("D5", -0.12), "cell D5: -0.12"),
    "zero": (set_cell("D5", 0), "cell D5: 0:"),
    "too thin": (set_cell("D5", 0.0399), "cell D5: 0.0399: a number in m from 0.04"),
    "too thick": (set_cell("D5", 1.001), "cell D5: 1.001"),
    "boolean": (set_cell("D5", True), "cell D5: True"),
    "date": (set_cell("D5", datetime.date(2026, 3, 4)), "cell D5: a date"),
    "fraction typed": (set_cell("D5", 0.75, "d/m"), "cell D5: a date"),
    "time": (set_cell("D5", 0.125, "[hh]:mm"), "cell D5: a date"),
    "percent": (set_cell("D5", 0.12, "0.0%"), "cell D5: a percentage"),
    "error": (set_cell("D5", "#DIV/0!"), "cell D5: the error #DIV/0!"),
    "formula without value": (set_cell("D5", "=0.1+0.02"), "cell D5: a formula without a value"),
    "empty": (set_cell("D5", None), "row 5: the thickness of panel 2 is empty"),
    "row deleted": (lambda book: book["thickness"].delete_rows(5), "panel 2: the row is missing"),
    "rows deleted": (lambda book: book["thickness"].delete_rows(3, 12), "12 of 12 panels"),
    "panel twice": (set_cell("A6", 2), "cell A6: 2: the panel stands twice, first in A5"),
    "panel unknown": (set_cell("A14", 12), "cell A14: 12: unknown panel, 0 to 11"),
    "panel negative": (set_cell("A3", -1), "cell A3: -1: unknown panel"),
    "panel fraction": (set_cell("A5", 2.5), "cell A5: 2.5: unknown panel"),
    "panel boolean": (set_cell("A4", True), "cell A4: True: unknown panel"),
    "panel text": (set_cell("A5", "two"), "cell A5: 'two': unknown panel"),
    "panel empty": (set_cell("A5", None), "row 5: a thickness without a panel id"),
    "row added": (
        lambda book: book["thickness"].append([12, 3, 0, 0.1]),
        "cell A15: 12: unknown panel",
    ),
    "sum below": (lambda book: book["thickness"].append(["sum", None, None, 2]), "'sum'"),
    "panel column sorted alone": (
        lambda book: [book["thickness"].__setitem__(f"A{row}", 14 - row) for row in range(3, 15)],
        "cell B3: 0: zigzag of panel 11 is 2",
    ),
    "indices changed": (set_cell("C5", 3), "cell C5: 3: strip of panel 2 is 2"),
    "sheet renamed": (
        lambda book: setattr(book["thickness"], "title", "Thickness2"),
        "sheet 'thickness' is missing, the nearest is Thickness2",
    ),
    "sheet deleted": (lambda book: book.remove(book["thickness"]), "sheet 'thickness' is missing"),
    "header deleted": (lambda book: book["thickness"].delete_rows(1), "no header row"),
    "header renamed": (set_cell("D1", "t"), "no header row"),
    "header twice": (set_cell("F1", "thickness"), "cell F1: 'thickness': the column stands twice"),
    "units deleted": (lambda book: book["thickness"].delete_rows(2), "row of units is missing"),
    "unit changed": (set_cell("D2", "mm"), "cell D2: 'mm': the unit 'm' is due for thickness"),
    "unit emptied": (set_cell("D2", None), "row of units is missing"),
    "row of units moved": (lambda book: book["thickness"].insert_rows(2), "units is missing"),
}


@pytest.mark.parametrize(("edit", "named"), REFUSED.values(), ids=REFUSED)
def test_refused_with_sheet_cell_and_value(path, edit, named):
    with pytest.raises(InputError, match=named) as caught:
        read(edit_with_openpyxl(path, edit))
    message = str(caught.value)
    assert message.startswith(str(path)) and "\n" not in message and len(message) < 400


def test_large_tables_are_read_by_panel(tmp_path):
    """Shuffled text keeps its panel: the k-th value goes where the k-th id says."""
    path = edit_with_openpyxl(
        write_case(tmp_path / "thickness.xlsx"),
        lambda book: (shuffle_rows(book), set_cell("D3", 0.2)(book)),
    )
    due = round_thickness(THICKNESS)
    due[11] = 0.2
    assert np.array_equal(read(path), due)
