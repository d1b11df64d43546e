"""The engineering verdict on a page: checks with their share, reactions with their thrust."""

from foldshell.report.engineering import make_engineering as make_sections
from foldshell.report.engineering import tabulate_reactions
from record_cases import make_check, make_engineering


def cells(row):
    return [cell.value for cell in row]


def test_displacements_are_shown_in_mm_and_say_where(tmp_path):
    check = make_check(0.12, 0.1, False, unit="m", words="sway", within_mesh_error=True)
    record = make_engineering({"sway": check}, verdict="fails", reason="sway: 0.12 above 0.1 m")
    verdict = make_sections(record)[0]
    assert verdict.box.kind == "bad" and verdict.box.head == "fails"
    (row,) = verdict.table.rows
    assert cells(row) == [
        "sway [mm]", 120.0, 100.0, "120 %", "no",
        "combination ULS1, panel 3, within the mesh error",
    ]  # fmt: skip
    assert "von Mises: largest panel mean 0.8, largest strip 1.4" in verdict.note


def test_reactions_have_thrust_and_a_sum():
    reactions = {"a": {"ULS1": (3.0, 4.0, 10.0)}, "b": {"ULS1": (-3.0, 0.0, 5.0)}}
    table = tabulate_reactions(make_engineering(reactions=reactions))
    assert [cells(row)[1:] for row in table.rows] == [
        ["a", 3.0, 4.0, 10.0, 5.0], ["b", -3.0, 0.0, 5.0, 3.0], ["sum", 0.0, 4.0, 15.0, 4.0],
    ]  # fmt: skip


def test_without_a_verdict_nothing_stands_on_the_page():
    assert make_sections(None) == []
