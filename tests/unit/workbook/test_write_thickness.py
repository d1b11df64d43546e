"""The thickness workbook: exact round trip, same bytes, what an engineer looks for."""

import time

import numpy as np
import openpyxl
import pytest

from foldshell.sizing.rounding import round_thickness
from foldshell.workbook.panels import ThicknessTable, make_panel_grid
from foldshell.workbook.read_thickness import read_thickness
from foldshell.workbook.write_thickness import write_thickness
from workbook_cases import GRID, LARGEST, LEAST, SUMMARY, THICKNESS, write_case


def test_panel_ids_run_along_strips():
    """Panel p = i (strip_count - 1) + j between zig-zags i, i+1 and strips j, j+1."""
    grid = make_panel_grid(4, 5)
    assert grid.panel.size == 12
    assert (grid.panel == grid.zigzag_index * 4 + grid.strip_index).all()
    assert (grid.zigzag_index.max(), grid.strip_index.max()) == (2, 3)


def test_rounding_keeps_12_digits_and_changes_nothing_twice():
    values = np.random.default_rng(1).uniform(LEAST, LARGEST, 10_000)
    rounded = round_thickness(values)
    assert np.abs(rounded / values - 1).max() < 5.1e-12
    assert (round_thickness(rounded) == rounded).all()
    assert round_thickness(0.15) == 0.15


def test_round_trip_is_exact(tmp_path):
    """10,000 random doubles: what is read is bit for bit what was rounded before its use.

    Without the rounding the 16 printed digits change 46 % of doubles in the last place.
    """
    grid = make_panel_grid(101, 91)
    values = np.random.default_rng(2).uniform(LEAST, LARGEST, grid.zigzag_index.size)
    path = tmp_path / "thickness.xlsx"
    write_thickness(path, ThicknessTable(grid, values), SUMMARY, LEAST, LARGEST)
    read = read_thickness(path, grid, LEAST, LARGEST)
    assert (read == round_thickness(values)).all()
    assert not (read == values).all()


def test_other_libraries_read_the_same(tmp_path):
    """openpyxl and python-calamine as oracles of the reader and the writer."""
    import python_calamine

    path = write_case(tmp_path / "thickness.xlsx")
    sheet = openpyxl.load_workbook(path)["thickness"]
    by_openpyxl = [row[3] for row in sheet.iter_rows(min_row=3, values_only=True)]
    rows = python_calamine.CalamineWorkbook.from_path(path).get_sheet_by_name("thickness")
    by_calamine = [row[3] for row in rows.to_python()[2:]]
    ours = read_thickness(path, GRID, LEAST, LARGEST).tolist()
    assert ours == by_openpyxl == by_calamine == round_thickness(THICKNESS).tolist()


def test_same_values_give_the_same_bytes(tmp_path):
    first = write_case(tmp_path / "a.xlsx").read_bytes()
    time.sleep(2.1)  # a zip entry's time has steps of two seconds
    assert write_case(tmp_path / "b.xlsx").read_bytes() == first
    assert b"openpyxl" not in first


def test_sheets_headers_units_and_results(tmp_path):
    path = write_case(
        tmp_path / "thickness.xlsx",
        previous=THICKNESS * 1.1,
        utilization=np.linspace(0.2, 1.3, 12),
        change=np.full(12, -0.1),
        note=("=1+1",) + ("",) * 11,
    )
    book = openpyxl.load_workbook(path)
    assert book.sheetnames == ["summary", "thickness"]
    sheet = book["thickness"]
    rows = list(sheet.iter_rows(values_only=True))
    assert rows[0] == (
        "panel",
        "zigzag",
        "strip",
        "thickness",
        "fixed",
        "least",
        "largest",
        "group",
        "previous",
        "utilization",
        "change",
        "note",
    )
    assert rows[1][:11] == ("-", "-", "-", "m", "-", "m", "m", "-", "m", "-", "-")
    assert rows[2][0:3] == (0, 0, 0) and rows[13][0:3] == (11, 2, 3)
    assert sheet["L3"].data_type == "s" and sheet["L3"].value == "=1+1"  # text stays text
    assert sheet.freeze_panes == "B3"
    assert sheet.print_title_rows == "$1:$2"
    assert (sheet.page_setup.orientation, sheet.page_setup.paperSize) == ("landscape", 9)
    assert sheet.page_setup.fitToWidth in (None, 1) and sheet.page_setup.fitToHeight == 0


def test_input_cells_are_marked_and_validated(tmp_path):
    path = write_case(tmp_path / "thickness.xlsx", utilization=np.ones(12))
    sheet = openpyxl.load_workbook(path)["thickness"]
    assert sheet["D3"].font.color.rgb == "FF0000FF" and sheet["A3"].font.color.rgb != "FF0000FF"
    rule, *prompts = sheet.data_validations.dataValidation
    assert [one.promptTitle for one in prompts] == ["fixed", "least", "largest", "group"]
    assert (str(rule.sqref), rule.type) == ("D3:D14", "decimal")
    assert (float(rule.formula1), float(rule.formula2)) == (LEAST, LARGEST)
    assert "0.04 to 1" in rule.prompt and rule.showErrorMessage
    ((area, (condition,)),) = [
        (str(key.sqref), value) for key, value in sheet.conditional_formatting._cf_rules.items()
    ]
    assert area == "J3:J14" and condition.operator == "greaterThan"
    assert float(condition.formula[0]) == 1.0


def test_summary_shows_label_value_and_unit(tmp_path):
    sheet = openpyxl.load_workbook(write_case(tmp_path / "t.xlsx"))["summary"]
    shown = {row[0]: row[1:3] for row in sheet.iter_rows(min_row=3, max_row=6, values_only=True)}
    assert shown["design"][0] == "a" and shown["volume of analysis 00"] == (12.5, "m3")


@pytest.mark.parametrize(
    "spoilt", [np.full(12, 0.039), np.full(12, 1.1), np.full(12, np.nan), np.full(11, 0.1)]
)
def test_values_outside_the_bounds_are_not_written(tmp_path, spoilt):
    path = write_case(tmp_path / "thickness.xlsx")
    before = path.read_bytes()
    with pytest.raises(ValueError, match="one thickness per panel"):
        write_thickness(path, ThicknessTable(GRID, spoilt), SUMMARY, LEAST, LARGEST)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]
