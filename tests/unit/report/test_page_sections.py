"""Tables of the page of a design: shares of a file become per cent, once."""

from dataclasses import replace

import pytest

from foldshell.records.comparison import ShearShare, SupportReaction
from foldshell.records.entry import FACTORS, entries
from foldshell.records.summary import SummaryRow
from foldshell.report.sections import make_crosscheck, make_mesh_error
from foldshell.report.study_columns import choose_columns, make_row
from record_cases import make_comparison, make_convergence, make_quantity, make_summary


def read(table):
    """Return the rows of a table as dicts by header."""
    return [
        dict(zip(table.header, (cell.value for cell in row), strict=True)) for row in table.rows
    ]


def test_errors_of_the_mesh_are_per_cent():
    record = make_convergence({"S2": {"work_knm": 0.034}, "D1": {"displacement_max_m": -0.002}})
    work, displacement = read(make_mesh_error(record).table)
    assert work["S2 [%]"] == pytest.approx(3.4) and work["D1 [%]"] is None
    assert displacement["D1 [%]"] == pytest.approx(-0.2)


def test_difference_and_tolerance_of_both_codes_are_per_cent():
    quantity = make_quantity(relative_difference=0.072, tolerance=0.05)
    (row,) = read(make_crosscheck(make_comparison(False, {"S2 work_knm": quantity})).table)
    assert row["difference [%]"] == pytest.approx(7.2)
    assert row["tolerance [%]"] == pytest.approx(5.0)
    assert (row["primary"], row["independent"], row["within"]) == (0.1, 0.11, "no")


def test_thrusts_and_shear_stand_with_the_cross_check():
    reaction = SupportReaction(
        primary_kn=(3.0, 0.0, 4.0), independent_kn=(3.1, 0.0, 4.0), primary_thrust_kn=3.0,
        independent_thrust_kn=3.1, relative_difference=0.02, tolerance=0.04, passed=True,
    )  # fmt: skip
    share = ShearShare(
        combination="D2", share=0.043, share_meshes=(0.015, 0.033), value=0.1129, limit=0.1167,
        with_shear=0.1178, refined_with_shear=0.1193, turns=True, turns_refined=True,
    )  # fmt: skip
    comparison = make_comparison(
        True, {"D2 work_knm": make_quantity(True)}, reactions={"D2 first strip edge": reaction},
        shear={"displacement_down_max_m": share},
    )  # fmt: skip
    section = make_crosscheck(comparison)
    row = read(section.folded.table)[-1]
    assert row["quantity"] == "D2 first strip edge, thrust [kN]"
    assert (row["primary"], row["independent"]) == (3.0, 3.1)
    assert "adds 4.3 % to D2" in section.words
    assert "112.9 becomes 117.8, not within 116.7 (the verdict turns)." in section.words
    together = replace(share, with_shear=0.116, turns=False)
    section = make_crosscheck(replace(comparison, shear={"displacement_down_max_m": together}))
    assert "116, within 116.7 (the verdict turns with mesh error added)." in section.words
    assert make_crosscheck(make_comparison(True)).words == ""


def test_reactions_are_folded_away_and_rounding_is_zero():
    """1.9e-8 of 5239 kN is rounding, 0.01 kN is not; a row that fails is not hidden."""
    forces = {"z": (5239.0, 5239.0), "y": (-1.9e-8, 2.6e-9), "x": (0.01, 0.01)}
    rows = {
        f"S2 Th.II reaction_{axis}_kn": make_quantity(
            True, primary=one, independent=other, unit="kN"
        )
        for axis, (one, other) in forces.items()
    }
    section = make_crosscheck(make_comparison(True, {"S2 work_knm": make_quantity(True)} | rows))
    assert [row["quantity"] for row in read(section.table)] == ["S2 work [kNm]"]
    found = [(row["primary"], row["independent"]) for row in read(section.folded.table)]
    assert found == [(5239.0, 5239.0), (0.0, 0.0), (0.01, 0.01)]
    assert not section.folded.shown
    assert "Rows with Th.II are of second order" in section.words
    rows["S2 Th.II reaction_z_kn"] = make_quantity(False, unit="kN")
    assert make_crosscheck(make_comparison(False, rows)).folded.shown


def test_what_was_extrapolated_is_said_where_it_was():
    """An order of extrapolation in the record, and only then."""
    plain = {"S2 work_knm": make_quantity(True)}
    assert "extrapolated" not in make_crosscheck(make_comparison(True, plain)).words
    settled = {"S2 work_knm": replace(make_quantity(True), primary_order=2.0)}
    assert "extrapolated" in make_crosscheck(make_comparison(True, settled)).words


def test_columns_of_the_study_are_in_the_unit_of_their_header():
    row = make_summary(
        volume_per_area_m=0.08, displacement_vertical_max_m=0.05, mesh_error=0.021,
        buckling_mesh_error=0.17, edge_strain_max=0.012, planarity_max=0.004,
        edge_beam_thickness_m=0.3, edge_beam_depth_m=0.5, volume_m3=88.0,
    )  # fmt: skip
    columns = choose_columns([row])
    cells = make_row(row, columns, None)
    found = {column.words: cells[column.key].value for column in columns if column.numeric}
    expected = {
        "volume / area [mm]": 80, "vertical displacement, down [mm]": 50, "mesh error [%]": 2.1,
        "buckling mesh error [%]": 17, "largest strain of an edge [%]": 1.2,
        "planarity, largest [%]": 0.4, "edge beam thickness [mm]": 300,
        "edge beam depth [m]": 0.5, "volume [m³]": 88,
    }  # fmt: skip
    for words, value in expected.items():
        assert found[words] == pytest.approx(value), words


def test_factors_say_what_the_units_say():
    per_metre = {"mm": 1000.0}
    assert {pair: per_metre.get(pair[1], 100.0) for pair in FACTORS} == FACTORS
    shown = {(about.unit, about.shown) for about in entries(SummaryRow).values()}
    assert {pair for pair in shown if pair[0] != pair[1]} == set(FACTORS)
