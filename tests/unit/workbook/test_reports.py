"""history, design and summary workbooks: content, units, charts, same bytes."""

import csv
import dataclasses
import time
import zipfile

import numpy as np
import openpyxl
import pytest

from foldshell.records.analysis import Criteria
from foldshell.records.entry import entries
from foldshell.records.history import HistoryRow
from foldshell.records.summary import SummaryRow
from foldshell.records.table import write_rows
from foldshell.results.history import make_history
from foldshell.settings.make import make_settings
from foldshell.settings.stage import read_stage
from foldshell.settings.stages import STAGES, stage_parameters
from foldshell.workbook.design import DesignReport, write_design
from foldshell.workbook.history import write_history
from foldshell.workbook.panels import make_panel_grid
from foldshell.workbook.styles import Line, make_lines
from foldshell.workbook.summary import write_summary
from foldshell.workbook.tables import make_column
from record_cases import USED, make_analysis, make_criterion, make_summary

GRID = make_panel_grid(4, 5)


HISTORY_KEYS = tuple(key for key, about in entries(HistoryRow).items() if not about.left_out)
SUMMARY_KEYS = tuple(entries(SummaryRow))
LINES = [Line("design", "a"), Line("verdict", "converged", judged=True)]


STUDY = read_stage(stage_parameters(make_settings({}), "study"), *STAGES["study"])


def make_iteration(iteration: int, **changes):
    volume = 100.0 - 7.0 * iteration
    return make_analysis(iteration=iteration, volume_m3=volume, **USED | changes)


@pytest.fixture
def rows():
    edit = {"edited": True, "edited_panels": (3, 5)}
    analyses = [make_iteration(0), make_iteration(1, **edit),
                make_iteration(2, verdict="converged")]  # fmt: skip
    thicknesses = [np.full(12, 0.15), np.linspace(0.1, 0.2, 12), np.full(12, 0.1)]
    return make_history(analyses, thicknesses, 28 / 240)


def test_history_rows(rows):
    assert [row.volume_change_m3 for row in rows] == [None, -7.0, -7.0]
    assert {row.buckling_factor_min for row in rows} == {10.5}
    assert {row.second_order_iterations for row in rows} == {8}
    assert [row.edited for row in rows] == [None, "edited", None]
    assert [row.edited_panels for row in rows] == [None, 2, None]
    assert rows[1].thickness_mean_m == pytest.approx(0.15)


def test_history_without_results_has_empty_cells():
    """An unstable analysis has neither volume nor factors: its row is still there."""
    bare = make_analysis(verdict="unstable", reason="mechanism", buckling_factor={"S1": None})
    (row,) = make_history([bare])
    assert row.utilization_max is None and row.buckling_factor_min is None
    assert row.verdict == "unstable"


def test_history_csv_keeps_all_digits(tmp_path, rows):
    write_rows(tmp_path / "history.csv", HistoryRow, rows)
    with (tmp_path / "history.csv").open(encoding="utf-8", newline="") as stream:
        read = list(csv.DictReader(stream))
    assert [float(row["displacement_limit_m"]) for row in read] == [28 / 240] * 3
    assert read[0]["volume_change_m3"] == "" and read[2]["verdict"] == "converged"


def test_history_workbook_charts_leave_header_and_units_out(tmp_path, rows):
    """Data begin in row 3; a chart that began in row 2 would plot the unit."""
    path = tmp_path / "history.xlsx"
    write_history(path, rows, LINES)
    book = openpyxl.load_workbook(path)
    assert book.sheetnames == ["summary", "history", "charts"]
    values = list(book["history"].iter_rows(values_only=True))
    assert values[0] == HISTORY_KEYS and values[1][4] == "m3" and len(values) == 5
    with zipfile.ZipFile(path) as archive:
        charts = [
            archive.read(name).decode() for name in archive.namelist() if "charts/chart" in name
        ]
    assert len(charts) == 4
    for chart in charts:
        assert "history!$A$3:$A$5" in chart and "$2" not in chart
        assert '<c:smooth val="1"/>' not in chart


def test_the_utilization_chart_draws_the_edge_beam(tmp_path):
    """The series must point at the column of the edge beam, which stands after `reason`."""
    used = {"edge_beam_utilization_max": 1.6, "edge_beam_utilization_panel_mean_max": 1.3}
    path = tmp_path / "history.xlsx"
    write_history(path, make_history([make_iteration(0, **used), make_iteration(1, **used)]), [])
    sheet = openpyxl.load_workbook(path)["history"]
    column = [cell.value for cell in sheet[1]].index("edge_beam_utilization_panel_mean_max")
    letter = sheet.cell(1, column + 1).column_letter
    with zipfile.ZipFile(path) as archive:
        chart = archive.read("xl/charts/chart2.xml").decode()
    assert f"history!${letter}$3:${letter}$4" in chart and chart.count("<c:ser>") == 4


def test_one_iteration_still_gives_a_workbook(tmp_path, rows):
    write_history(tmp_path / "history.xlsx", rows[:1], [])
    assert openpyxl.load_workbook(tmp_path / "history.xlsx")["history"].max_row == 3


def make_report(rows):
    settings = make_settings({})
    return DesignReport(
        title="Design a",
        verdict=[*LINES, Line("volume", 86.0, "m3")],
        criteria=Criteria(
            utilization_panel_mean=make_criterion(value=0.9),
            volume_change_m3=make_criterion(False, None, 10.0),
        ),
        grid=GRID,
        thickness=np.linspace(0.05, 0.2, 12),
        utilization=np.linspace(0.2, 1.1, 12),
        thickness_class=np.arange(12) % 3 + 1,
        history=rows,
        loads=[Line("live", 1.0, "kN/m2")],
        combinations=settings.combinations,
        settings=STUDY,
        versions={"foldshell": "0.1.0"},
        sources=("=HYPERLINK()",),
    )


def test_design_workbook(tmp_path, rows):
    path = tmp_path / "design.xlsx"
    write_design(path, make_report(rows))
    book = openpyxl.load_workbook(path)
    assert book.sheetnames == ["summary", "panels", "history", "charts", "loads", "notes"]
    panels = list(book["panels"].iter_rows(values_only=True))
    assert panels[0] == (
        "panel",
        "zigzag",
        "strip",
        "thickness_m",
        "utilization_panel_mean",
        "class",
    )
    assert panels[1] == ("-", "-", "-", "m", "-", "-")
    assert panels[13] == (11, 2, 3, 0.2, 1.1, 3)
    loads = {row[0]: row for row in book["loads"].iter_rows(values_only=True)}
    assert loads["S2"][2:7] == (1.2, 1.2, 1.6, 0.5, None)
    assert loads["live"][1:3] == (1, "kN/m2")
    notes = {row[0]: row[1] for row in book["notes"].iter_rows(values_only=True)}
    assert notes["material.youngs_modulus"] == 31e6
    assert notes["version of foldshell"] == "0.1.0" and notes["source"] == "=HYPERLINK()"
    cells = {cell.data_type for row in book["notes"].iter_rows() for cell in row}
    assert "f" not in cells


def test_panels_without_a_result_have_empty_cells(tmp_path, rows):
    """An unstable analysis has no utilization; NaN stands for it."""
    report = dataclasses.replace(make_report(rows), utilization=np.full(12, np.nan))
    write_design(tmp_path / "design.xlsx", report)
    assert openpyxl.load_workbook(tmp_path / "design.xlsx")["panels"]["E3"].value is None


def test_summary_workbook(tmp_path):
    rows = [
        make_summary(volume_m3=86.0, crosscheck="pass", utilization_panel_mean_max=0.95),
        make_summary(design="b", state="failed", reason="sizing/00/analysis.json is missing"),
    ]
    path = tmp_path / "summary.xlsx"
    write_summary(path, rows, STUDY, "0123456789ab")
    book = openpyxl.load_workbook(path)
    assert book.sheetnames == ["summary", "overview", "notes"]
    values = list(book["summary"].iter_rows(values_only=True))
    assert values[0] == SUMMARY_KEYS
    units = dict(zip(SUMMARY_KEYS, values[1], strict=True))
    assert units["span_m"] == "m" and units["volume_per_area_m"] == "m3/m2"
    assert values[3][0] == "b" and values[3][10] == "failed"
    overview = list(book["overview"].iter_rows(min_row=3, values_only=True))
    assert overview == [("converged", 1), ("failed", 1)]


def test_same_values_give_the_same_bytes(tmp_path, rows):
    def write(folder):
        write_history(folder / "history.xlsx", rows, LINES)
        write_design(folder / "design.xlsx", make_report(rows))
        write_summary(folder / "summary.xlsx", [make_summary()], STUDY, "0123456789ab")
        return [path.read_bytes() for path in sorted(folder.iterdir())]

    first, second = tmp_path / "first", tmp_path / "second"
    first.mkdir()
    second.mkdir()
    before = write(first)
    time.sleep(2.1)  # a zip entry's time has steps of two seconds
    assert write(second) == before


def test_infinite_values_leave_no_file(tmp_path, rows):
    rows[0] = dataclasses.replace(rows[0], volume_m3=float("inf"))
    with pytest.raises(TypeError):
        write_history(tmp_path / "history.xlsx", rows, [])
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("key", "unit", "style"),
    [
        ("volume_m3", "m3", "decimal"),
        ("span_m", "m", "general"),
        ("displacement_vertical_max_m", "m", "metre"),
        ("volume_per_area_m", "m3/m2", "decimal"),
        ("utilization_max", "-", "decimal"),
        ("mesh_error", "-", "percent"),
        ("panels_above_one", "-", "integer"),
        ("settings_hash", "", "text"),
        ("reason", "", "wrap"),
    ],
)
def test_columns_have_unit_and_format_of_their_field(key, unit, style):
    known = {**entries(HistoryRow), **entries(SummaryRow)}
    column = make_column(known[key])
    assert (column.key, column.unit, column.style) == (key, unit, style)


def test_lines_have_words_and_unit_of_their_field():
    """A field that is left out where it has no value has no line."""
    keys = ("volume_m3", "utilization_max", "edge_beam_volume_m3", "dofs", "verdict")
    assert make_lines(make_analysis(utilization_max=0.5), keys) == [
        Line("volume", 100.0, "m3"),
        Line("utilization, largest of all points", 0.5),
        Line("unknowns", 1234),
        Line("verdict", "continue", judged=True),
    ]


def test_only_what_decides_is_marked_above_its_limit(tmp_path, rows):
    """The peak of an element and the 99 % value have no limit; the measure of the loop has one."""
    write_history(tmp_path / "history.xlsx", rows, [])
    write_summary(tmp_path / "summary.xlsx", [make_summary()], STUDY, "0123456789ab")
    for name, keys in (("history", HISTORY_KEYS), ("summary", SUMMARY_KEYS)):
        sheet = openpyxl.load_workbook(tmp_path / f"{name}.xlsx")[name]
        (area,) = sheet.conditional_formatting
        column = sheet.cell(1, keys.index("utilization_panel_mean_max") + 1).column_letter
        assert str(area.sqref).startswith(f"{column}3")
