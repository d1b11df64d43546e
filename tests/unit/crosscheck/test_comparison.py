"""The comparison passes what agrees, fails what does not, and shows both in the workbook."""

import copy

import openpyxl
import pytest

from crosscheck.comparison import TOLERANCES, compare
from crosscheck.errors import CrosscheckError
from crosscheck.records import to_data
from crosscheck.values import Code, build_independent
from crosscheck.workbook import write_comparison
from foldshell.settings.crosscheck import Tolerance

RUN = {
    "S2": {
        "displacement_down_max_m": 0.1,
        "work_knm": 20.0,
        "utilization_p99": 0.7,
        "reaction_sum_kn": [-3.0, 0.0, 4.0],
        "load_sum_kn": [3.0, 0.0, -4.0],
    }
}


def build_codes(**changes):
    """An independent code at 2 and 3, and a primary at 4 and 8 that agrees but for `changes`."""
    independent = build_independent([2, 3], [RUN, RUN])
    values = copy.deepcopy(independent.values)
    for name, value in changes.items():
        values["S2"][name] = value
    return Code([4, 8], values, {}, 2.0), independent


def test_equal_values_pass_and_the_contract_keys_are_there():
    result = compare(*build_codes(), {})
    assert result.passed
    assert result.not_compared == []
    for entry in result.quantities.values():
        assert {"primary", "independent", "relative_difference", "tolerance", "pass"} <= set(
            to_data(entry)
        )
    assert "S2 reaction_z_kn" in result.quantities
    assert "S2 reaction_imbalance" in result.quantities


def test_limits_are_compared_and_mesh_errors_shown():
    """Primary 0.07 at 4 and 0.0925 at 8 is 0.1 at second order; alone it would be 7.5 % off."""
    result = compare(*build_codes(displacement_down_max_m=[0.07, 0.0925]), {})
    entry = result.quantities["S2 displacement_down_max_m"]
    assert entry.primary == pytest.approx(0.1)
    assert entry.primary_mesh_error == pytest.approx(0.075)
    assert entry.passed


@pytest.mark.parametrize(
    ("name", "value", "failed"),
    [
        ("displacement_down_max_m", [0.106, 0.106], "S2 displacement_down_max_m"),
        ("work_knm", [18.9, 18.9], "S2 work_knm"),
        ("utilization_p99", [0.77, 0.77], "S2 utilization_p99"),
        ("reaction_sum_kn", [[-3.0, 0, 4.0], [-3.0, 0, 4.0001]], "S2 reaction_z_kn"),
        ("load_sum_kn", [[3.0, 0, -4.0001]] * 2, "S2 reaction_imbalance"),
    ],
)
def test_a_difference_beyond_its_tolerance_fails(name, value, failed):
    result = compare(*build_codes(**{name: value}), {})
    assert not result.passed
    assert not result.quantities[failed].passed


def test_a_percentile_is_taken_from_the_finest_mesh():
    result = compare(*build_codes(utilization_p99=[0.6, 0.72]), {})
    entry = result.quantities["S2 utilization_p99"]
    assert entry.primary == 0.72
    assert entry.primary_order is None
    assert entry.primary_mesh_error == pytest.approx(0.04 / 0.76)  # 0.76 by order 2


def test_tolerances_can_be_set_and_have_defaults():
    codes = build_codes(work_knm=[21.5, 21.5])
    assert not compare(*codes, {}).passed
    assert compare(*codes, {"work": 0.1}).passed
    assert compare(*codes, {"work": 0.1}).quantities["S2 work_knm"].tolerance == 0.1
    assert TOLERANCES["work"] == 0.04


@pytest.mark.parametrize(
    ("tolerance", "words"),
    [({"works": 0.1}, "works"), ({"work": 0.0}, "work.*above 0"), ({"work": "5"}, "work")],
)
def test_a_tolerance_that_is_unknown_or_not_above_zero_is_refused(tolerance, words):
    with pytest.raises(CrosscheckError, match=words):
        compare(*build_codes(), tolerance)


def test_what_only_one_code_gives_is_listed_and_nothing_compared_is_no_pass():
    primary, independent = build_codes()
    less = Code([4, 8], {"S2": {"work_knm": [20.0, 20.0]}}, {}, 2.0)
    assert "S2 utilization_p99" in compare(less, independent, {}).not_compared
    assert not compare(Code([4, 8], {}, {}, 2.0), independent, {}).passed
    assert primary.limit("S2", "work_knm") == (20.0, 2.0)


def test_the_workbook_shows_every_quantity_and_marks_failures(tmp_path):
    result = compare(*build_codes(work_knm=[10.0, 10.0]), {})
    path = tmp_path / "comparison.xlsx"
    write_comparison(path, "arch_x", result)
    book = openpyxl.load_workbook(path)
    assert book.sheetnames == ["comparison", "meshes"]
    sheet = book["comparison"]
    assert sheet["A1"].value == "arch_x: cross-check failed"
    assert sheet.freeze_panes == "C4"
    assert [cell.value for cell in sheet[3]][3:7] == ["in unit", "in unit", "%", "%"]
    rows = {(row[0].value, row[1].value): row for row in sheet.iter_rows(min_row=4)}
    assert len(rows) == len(result.quantities)
    row = rows["S2", "work of the loads"]
    shown = ["kNm", 10, 20, pytest.approx(50.0), 4, "failed", 0, 0]
    assert [cell.value for cell in row[2:]] == shown
    assert {cell.fill.fgColor.rgb for cell in row} == {"FFFFC7CE"}
    for name, row in rows.items():
        assert (row[0].fill.fill_type is None) == (name[1] != "work of the loads")
    meshes = list(book["meshes"].iter_rows(min_row=4, values_only=True))
    assert len(meshes) == 3 * 4
    assert meshes[0][3:6] == ("primary", 4, 0.1)


def test_what_is_not_compared_is_told_in_the_workbook(tmp_path):
    primary, independent = build_codes()
    result = compare(Code([4, 8], {"S2 Th.II": {"work_knm": [1.0, 1.0]}}, {}, 2.0), primary, {})
    write_comparison(tmp_path / "c.xlsx", "x", result)
    texts = [row[0] for row in openpyxl.load_workbook(tmp_path / "c.xlsx")["comparison"].values]
    assert "not compared, given by one code only: S2 Th.II" in texts
    assert independent.values


def test_what_has_not_settled_is_told_in_the_workbook(tmp_path):
    primary, independent = build_codes()
    independent.values["S2"]["work_knm"][-1] = None
    result = compare(primary, independent, {})
    assert result.not_settled == ["S2 work_knm"] and not result.passed
    write_comparison(tmp_path / "c.xlsx", "x", result)
    texts = [row[0] for row in openpyxl.load_workbook(tmp_path / "c.xlsx")["comparison"].values]
    assert "not settled within the steps of the independent code: S2 work_knm" in texts


def test_the_same_comparison_gives_the_same_bytes(tmp_path):
    result = compare(*build_codes(), {})
    for name in ("a.xlsx", "b.xlsx"):
        write_comparison(tmp_path / name, "x", result)
    assert (tmp_path / "a.xlsx").read_bytes() == (tmp_path / "b.xlsx").read_bytes()


def test_tolerances_are_those_of_the_settings():
    """The independent code has them in its own words; the rule gives it the settings'."""
    named = vars(Tolerance())
    assert {name: TOLERANCES[name] for name in named} == named
