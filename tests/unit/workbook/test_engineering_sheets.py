"""Sheets of the engineering verdict: formulas say what the cached values are, totals close."""

import numpy as np
import openpyxl
import pytest

from foldshell.records.engineering import CombinationFactors, EngineeringArrays
from foldshell.workbook.engineering import write_engineering
from record_cases import make_check, make_engineering, make_steel

EDGES = np.array([[[3.0], [4.0], [10.0]], [[-1.0], [0.0], [20.0]]])


@pytest.fixture
def books(tmp_path):
    """The workbook with formulas, and with the values that they have."""
    checks = {
        "strength": make_check(0.5),
        "stability": make_check(4.0, 6.0, False, at_least=True, within_mesh_error=True),
        "peak": make_check(2.7, None, None),
    }
    panels = {
        "panel": (0, 1), "thickness_m": (0.1, 0.2), "area_m2": (3.0, 5.0), "nx_min": (-4.0, 1.0),
    }  # fmt: skip
    record = make_engineering(
        checks,
        panels=panels,
        reinforcement=make_steel(),
        loads={"SW": (0.0, 0.0, -25.0), "WX": (-2.0, -4.0, 0.0)},
        reactions={"first strip edge": {"ULS1": (3.0, 4.0, 10.0)},
                   "last strip edge": {"ULS1": (-1.0, 0.0, 20.0)}},
        combinations=CombinationFactors(
            strength={"ULS1": {"SW": 1.2, "WX": 1.0}}, characteristic={}, quasi_permanent={}
        ),
    )  # fmt: skip
    arrays = EngineeringArrays(
        vertex=np.array([7]), vertex_place=np.zeros((1, 3)), vertex_reaction=EDGES[:1],
        edge_reaction=EDGES, load_sum=np.array([[-2.0], [-4.0], [-30.0]]),
    )  # fmt: skip
    path = tmp_path / "engineering.xlsx"
    write_engineering(path, "a", record, arrays)
    return openpyxl.load_workbook(path), openpyxl.load_workbook(path, data_only=True)


def find_row(sheet, words, column):
    return next(row[0].row for row in sheet.iter_rows() if row[column].value == words)


def test_shares_are_value_over_limit_or_limit_over_value(books):
    formulas, values = (book["checks"] for book in books)
    rows = [row for row in range(6, 12) if formulas.cell(row, 1).value == "strength on strips"]
    first, second, third = rows
    assert formulas.cell(first, 5).value == f"=B{first}/C{first}"
    assert formulas.cell(second, 5).value == f"=C{second}/B{second}"
    assert [values.cell(row, 5).value for row in rows] == [0.5, 1.5, None]
    assert values.cell(second, 6).value == "no, within mesh error"
    assert values.cell(third, 6).value == "no limit, for information"


def test_reactions_and_loads_close(books):
    formulas, values = (book["reactions"] for book in books)
    row = find_row(values, "closing", 1)
    assert formulas.cell(row, 5).value == f"=E{row - 2}+E{row - 1}"
    assert formulas.cell(row - 2, 3).value == f"=SUM(C{row - 4}:C{row - 3})"
    assert [values.cell(row, column).value for column in (3, 4, 5)] == [0, 0, 0]
    edge = find_row(values, "first strip edge", 1)
    assert formulas.cell(edge, 6).value == f"=SQRT(C{edge}^2+D{edge}^2)"
    assert values.cell(edge, 6).value == 5


def test_the_resultant_of_a_combination_is_that_of_its_cases(books):
    formulas, values = (book["combinations"] for book in books)
    row = find_row(values, "ULS1", 0)
    assert formulas.cell(row, 7).value == f"=SUMPRODUCT(C{row}:D{row},C$5:D$5)"
    assert [values.cell(row, column).value for column in (5, 6, 7)] == [-2, -4, -30]


def test_volume_is_the_sum_of_area_times_thickness(books):
    formulas, values = (book["panels"] for book in books)
    row = find_row(values, "volume [m3]", 0)
    assert formulas.cell(row, 3).value == "=SUMPRODUCT(C3:C4,B3:B4)"
    assert values.cell(row, 3).value == pytest.approx(1.3)


def test_reinforcement_has_totals_shares_and_bars_with_formulas(books):
    """17050 kg over 86.5 m3, 880 + 890 kg by the schedule."""
    formulas, values = (book["reinforcement"] for book in books)
    row = {key: find_row(values, key, 0) for key in ("steel kg m3", "steel bars kg", "cost high")}
    assert formulas.cell(row["steel kg m3"], 2).value == "=B5/B4"
    assert (formulas.cell(4, 1).value, formulas.cell(5, 1).value) == ("concrete m3", "steel kg")
    assert values.cell(row["cost high"], 2).value == 74000.0
    share = find_row(values, "fit", 0)
    assert [values.cell(share, k).value for k in (2, 3)] == [0.625, 0.015]
    mass = formulas.cell(row["steel bars kg"], 2).value
    first, last = (int(part[1:]) for part in mass.removeprefix("=SUM(").rstrip(")").split(":"))
    column = openpyxl.utils.column_index_from_string(mass[5])
    assert [values.cell(k, column).value for k in (first, last)] == [880.0, 890.0]
    assert last == first + 1


def test_a_design_without_reinforcement_has_no_sheet_of_it(tmp_path):
    path = tmp_path / "engineering.xlsx"
    write_engineering(path, "a", make_engineering(panels={}), EngineeringArrays())
    assert "reinforcement" not in openpyxl.load_workbook(path).sheetnames
