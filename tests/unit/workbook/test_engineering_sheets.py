"""Sheets of the engineering verdict: formulas say what the cached values are, totals close."""

import numpy as np
import openpyxl
import pytest

from foldshell.records.engineering import CombinationFactors, EngineeringArrays
from foldshell.workbook.engineering import write_engineering
from record_cases import make_check, make_engineering

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
