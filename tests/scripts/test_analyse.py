"""Entry script of rule analyse."""

import numpy as np
import pytest

import analyse
import resize
import start
from foldshell.files.errors import InputError
from foldshell.files.whole import hash_file, read_arrays, read_json, write_arrays
from foldshell.sizing.case import open_case
from sizing_case import PANELS, SPAN, STRIP, ZIGZAG, given, stage, write_small_mesh
from workbook_cases import edit_with_openpyxl

KEYS = """
    iteration verdict reason criteria utilization_max utilization_p99 utilization_panel_mean_max
    panels_above_one displacement_vertical_max_m volume_m3 area_m2 buckling_factor
    reaction_imbalance second_order_iterations dofs edited workbook_sha256 counted_from
    governing_combination
"""


@pytest.fixture(scope="module")
def mesh(tmp_path_factory):
    return write_small_mesh(tmp_path_factory.mktemp("mesh") / "mesh.npz")


def _start(folder, thickness=0.15):
    book = folder / "00/thickness.xlsx"
    start.main(
        book, folder / "00/written.json", design="small", zigzag=ZIGZAG, strip=STRIP,
        settings=stage("start", start_thickness=thickness), settings_hash="",
    )  # fmt: skip
    return book


def _analyse(mesh, book, iteration=0, previous=None, **sizing):
    files = book.parent / "analysis.json", book.parent / "analysis.npz"
    analyse.main(
        mesh, book, *files, design="small", iteration=iteration, span_m=SPAN, zigzag=ZIGZAG,
        strip=STRIP,
        settings=stage("analyse", **sizing), settings_hash="base", previous=previous,
    )  # fmt: skip
    return read_json(files[0]), read_arrays(files[1])


def _change_panel(book):
    book["thickness"]["D5"].value = 0.2


def test_report_keeps_the_contract(tmp_path, mesh, capsys):
    book = _start(tmp_path)
    report, arrays = _analyse(mesh, book)
    line = capsys.readouterr().err
    assert line.startswith("small iteration 00: volume") and line.count("\n") == 1
    assert set(KEYS.split()) <= set(report)
    assert report["verdict"] == "continue" and report["iteration"] == 0
    assert not report["edited"] and report["workbook_sha256"] == hash_file(book)
    # One thickness everywhere: volume is exactly area times thickness.
    assert report["volume_m3"] == pytest.approx(0.15 * report["area_m2"], rel=1e-12)
    assert report["reaction_imbalance"] < 1e-6  # the contract's limit of balance
    assert np.array_equal(arrays["thickness"], np.full(PANELS, 0.15))
    worst = arrays["utilization_panel_mean"].max()
    assert worst == report["utilization_panel_mean_max"]
    assert "displacement" not in arrays  # large fields only where the loop ends


def test_second_analysis_of_the_same_thickness_sees_no_change_of_volume(tmp_path, mesh):
    book = _start(tmp_path)
    _analyse(mesh, book)
    previous = tuple(str(book.parent / f"analysis.{kind}") for kind in ("json", "npz"))
    again = _start(tmp_path / "again")
    report, arrays = _analyse(mesh, again, 1, previous)
    assert report["criteria"]["volume_change_m3"]["value"] == 0
    assert report["verdict"] == "not_converged"  # too thick to be used, and nothing changed
    assert arrays["displacement"].shape[0] > 0


def test_a_change_by_a_person_starts_a_new_count_of_iterations(tmp_path, mesh):
    """Two iterations are allowed: the second analysis ends the loop, the same with a panel changed
    goes on, the third ends it again and says since when it counted."""
    few = {"iterations_max": 2}
    place = {"design": "small", "zigzag": ZIGZAG, "strip": STRIP}
    before = None
    reports, books = [], [_start(tmp_path)]
    for number in range(3):
        if number:
            folder = tmp_path / f"{number:02d}"
            names = ("thickness.xlsx", "memory.npz", "written.json")
            memory = before[0].parent / "memory.npz" if number > 1 else None
            resize.main(*before, *(folder / name for name in names), **place,
                        settings=stage("resize", **few), previous_memory=memory)  # fmt: skip
            books.append(folder / "thickness.xlsx")
        report, _ = _analyse(mesh, books[-1], number, before, **few)
        if number == 1:
            assert report["verdict"] == "not_converged"
            assert "2 iterations" in report["reason"] and report["counted_from"] == 0
            edit_with_openpyxl(books[-1], _change_panel)
            report, _ = _analyse(mesh, books[-1], number, before, **few)
        before = books[-1].parent / "analysis.json", books[-1].parent / "analysis.npz"
        reports.append(report)
    assert [report["verdict"] for report in reports] == ["continue", "continue", "not_converged"]
    assert [report["counted_from"] for report in reports] == [0, 1, 1]
    assert [report.get("edited_panels") for report in reports] == [None, [2], None]
    assert "since the edit of iteration 1" in reports[2]["reason"]


def test_a_workbook_saved_without_a_change_starts_no_new_count(tmp_path, mesh):
    book = _start(tmp_path)
    edit_with_openpyxl(book, lambda book: None)
    report, _ = _analyse(mesh, book)
    assert report["edited"] and report["edited_panels"] == [] and report["counted_from"] == 0


def test_thinnest_sheet_ends_at_its_bound(tmp_path, mesh):
    """The same 6 m sheet at its least thickness cannot reach 0.6: the third ending."""
    book = _start(tmp_path, 0.15)
    _analyse(mesh, book, least_thickness=0.15)
    previous = tuple(str(book.parent / f"analysis.{kind}") for kind in ("json", "npz"))
    report, _ = _analyse(mesh, _start(tmp_path / "b", 0.15), 1, previous, least_thickness=0.15)
    assert report["verdict"] == "at_minimum_thickness"


def test_damaged_workbook_leaves_no_result(tmp_path, mesh):
    book = _start(tmp_path)
    book.write_bytes(book.read_bytes()[:1000])
    with pytest.raises(InputError, match=r"thickness\.xlsx"):
        _analyse(mesh, book)
    assert not (tmp_path / "00/analysis.json").exists()
    # The edit is kept aside although it cannot be read.
    assert len(list((tmp_path / "00").glob("edited-*.xlsx"))) == 1


def test_a_process_that_goes_on_uses_a_new_mesh_of_the_same_name(tmp_path):
    """The case of the last analysis is remembered by contents, with its settings."""
    path = tmp_path / "mesh.npz"
    write_small_mesh(path)
    first, same = (open_case(path, given("analyse")) for _ in range(2))
    assert same is first
    changed = given("analyse").changed(given("analyse").loads.changed(live=2.0))
    other = open_case(path, changed)
    assert [case.cases[2].value for case in (other, first)] == [2.0, 1.0]
    arrays = read_arrays(path)
    write_arrays(path, arrays | {"nodes": 2 * arrays["nodes"]})
    larger = open_case(path, given("analyse"))
    areas = [case.model.operators.geometry.area for case in (first, larger)]
    np.testing.assert_allclose(areas[1], 4 * areas[0], rtol=1e-12)  # rounding
