"""The script summary: one row per design, whatever became of it."""

import csv

import openpyxl
import pytest

import summary
from foldshell.files.errors import InputError
from foldshell.records.analysis import write_analysis
from foldshell.records.entry import entries
from foldshell.records.files import write_record
from foldshell.records.summary import SummaryRow
from foldshell.settings.make import make_settings
from foldshell.settings.stages import stage_parameters
from record_cases import (
    USED,
    make_analysis,
    make_check,
    make_comparison,
    make_convergence,
    make_engineering,
    make_quality,
    make_steel,
)

SETTINGS = stage_parameters(make_settings({}), "study")
CONTRACT = [
    "design",
    "tags",
    "pattern",
    "surface",
    "span_m",
    "height_m",
    "zigzag",
    "strip",
    "support",
    "fold_mode",
    "state",
    "iterations",
    "volume_m3",
    "volume_per_area_m",
    "utilization_max",
    "utilization_p99",
    "utilization_mean",
    "displacement_vertical_max_m",
    "buckling_factor_min",
    "mesh_subdivisions",
    "mesh_error",
    "crosscheck",
    "settings_hash",
]


def make_design(name):
    return {
        "design": name,
        "tags": "table1,supports",
        "pattern": "miura",
        "surface": "arch",
        "span_m": 28.0,
        "height_m": 10.0,
        "zigzag": 15,
        "strip": 16,
        "support": "all",
        "fold_mode": "elastic",
        "mesh_subdivisions": 4,
    }


LAST = USED | {
    "reason": "all criteria are met", "utilization_max": 0.95, "utilization_p99": 0.9,
    "utilization_mean": 0.31, "utilization_panel_mean_max": 0.87,
    "displacement_vertical_max_m": 0.0312, "area_m2": 1100.0,
    "buckling_factor": {"S1": 30.0, "S2": 21.5, "S3": None}, "seconds": 1.23,
    "settings_hash": "0123456789ab",
}  # fmt: skip


def write_results(folder, iterations=3, verdict="converged", state="ok", **last):
    write_record(folder / "folded/quality.json", make_quality(state=state, reason="too steep"))
    for number in range(iterations):
        ends = number == iterations - 1
        record = make_analysis(**LAST | {
            "iteration": number, "verdict": verdict if ends else "continue",
            "volume_m3": 90.0 - number,
        } | (last if ends else {}))  # fmt: skip
        write_analysis(folder / f"sizing/{number:02d}/analysis.json", record)


def run(tmp_path, names):
    paths = tmp_path / "summary.csv", tmp_path / "summary.xlsx"
    summary.main([make_design(name) for name in names], tmp_path / "results", SETTINGS, *paths)
    with paths[0].open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def test_columns_begin_as_in_the_contract():
    assert list(entries(SummaryRow))[: len(CONTRACT)] == CONTRACT
    assert set(entries(SummaryRow)) > {
        "utilization_panel_mean_max", "governing_combination", "edited_panels", "engineering",
        "engineering_reason", "utilization_strip_max", "steel_kg_m2",
        "displacement_horizontal_max_m",
    }  # fmt: skip


def test_every_column_is_that_of_the_file_it_comes_from(tmp_path):
    """Each number of each file differs from every other, so that no column can hold another's."""
    folder = tmp_path / "results/a"
    edge = {"edge_beam_volume_m3": 7.7, "edge_beam_utilization_max": 0.66}
    warnings = ("3 of 210 panels are thick", "another sentence")
    write_results(
        folder, iterations=3, mesh_subdivisions=6, governing_combination="S1",
        edited_panels=(3, 8), model_warnings=warnings, **edge,
    )  # fmt: skip
    quality = make_quality(edge_strain_max=0.0123, planarity_max=0.0045)
    write_record(folder / "folded/quality.json", quality)
    convergence = make_convergence(mesh_error=0.021, buckling_mesh_error=0.17)
    write_record(folder / "mesh_convergence.json", convergence)
    write_record(folder / "crosscheck/comparison.json", make_comparison(True))
    sway = {"displacement_horizontal": make_check(value=0.057)}
    used = {"von_mises": (0.81, 1.46), "rankine": (2.9, 6.3)}
    engineering = make_engineering(
        sway, used, verdict="fails", reason="tension", reinforcement=make_steel()
    )
    write_record(folder / "checks/engineering.json", engineering)
    design = make_design("a") | {"edge_beam_depth_m": 0.41, "edge_beam_thickness_m": 0.23}
    design |= {"folded": "roof.obj", "file_unit": "mm", "strip_grading": 0.3}
    design |= {"span_x_m": 31.0, "span_y_m": 29.0, "loads": "mine", "settings": "own.yaml"}
    design |= {"outline": "a.csv", "openings": "b.csv"}
    design |= {"opening_angle_deg": 150.0, "take_up": 0.7}
    design |= {"sector_angle_deg": 55.0, "rest_fold_angle_deg": 31.0}
    paths = tmp_path / "summary.csv", tmp_path / "summary.xlsx"
    summary.main([design], tmp_path / "results", SETTINGS, *paths)
    with paths[0].open(encoding="utf-8", newline="") as stream:
        (row,) = csv.DictReader(stream)
    from_table = {key: str(value) for key, value in design.items() if key != "mesh_subdivisions"}
    last = {
        "utilization_max": "0.95", "utilization_p99": "0.9", "utilization_mean": "0.31",
        "utilization_panel_mean_max": "0.87", "displacement_vertical_max_m": "0.0312",
        "governing_combination": "S1", "volume_m3": "88.0", "mesh_subdivisions": "6",
        "settings_hash": "0123456789ab", "edge_beam_volume_m3": "7.7",
        "edge_beam_utilization_max": "0.66", "state": "converged",
        "reason": "all criteria are met",
    }  # fmt: skip
    made = {
        "volume_per_area_m": "0.08", "buckling_factor_min": "21.5", "iterations": "3",
        "model_warnings": "; ".join(warnings), "edited_panels": "2",
    }  # fmt: skip
    others = {
        "edge_strain_max": "0.0123", "planarity_max": "0.0045", "mesh_error": "0.021",
        "buckling_mesh_error": "0.17", "crosscheck": "pass",
    }  # fmt: skip
    others |= {
        "engineering": "fails", "engineering_reason": "tension", "steel_kg_m2": "15.5",
        "reinforcement": "bars", "steel_kg_m3": "197.0", "steel_over_share": "0.035",
        "steel_governing": "fit in 62 % of the panels", "co2_kg_m2": "38.0",
        "co2_low_kg_m2": "26.0", "co2_high_kg_m2": "54.0", "cost_m2": "61.0",
        "displacement_horizontal_max_m": "0.057", "utilization_strip_max": "1.46",
        "rankine_panel_mean_max": "2.9", "rankine_strip_max": "6.3",
    }  # fmt: skip
    assert row == from_table | last | made | others
    numbers = [text for text in row.values() if text.replace(".", "").isdigit()]
    assert len(set(numbers)) >= len(numbers) - 1  # a panel count, too, is 3 or so


def test_a_converged_design(tmp_path):
    folder = tmp_path / "results/a"
    write_results(folder)
    convergence = make_convergence(mesh_error=0.021, buckling_mesh_error=0.17)
    write_record(folder / "mesh_convergence.json", convergence)
    write_record(folder / "crosscheck/comparison.json", make_comparison(True))
    (row,) = run(tmp_path, ["a"])
    assert row["state"] == "converged" and row["iterations"] == "3"
    assert float(row["volume_m3"]) == 88.0
    assert float(row["volume_per_area_m"]) == 88.0 / 1100.0
    assert float(row["buckling_factor_min"]) == 21.5
    assert float(row["mesh_error"]) == 0.021 and float(row["buckling_mesh_error"]) == 0.17
    assert row["crosscheck"] == "pass" and row["mesh_subdivisions"] == "4"
    assert row["settings_hash"] == "0123456789ab"
    assert row["tags"] == "table1,supports" and row["span_m"] == "28.0"


def test_each_ending_has_its_row(tmp_path):
    results = tmp_path / "results"
    write_results(results / "fine")
    write_results(results / "open", verdict="not_converged")
    write_results(results / "crumpled", state="crumpled")
    write_results(results / "cut", iterations=2, verdict="continue")
    write_results(results / "spoilt")
    (results / "spoilt/sizing/01/analysis.json").write_text('{"verdict": "conv')
    write_record(results / "fine/crosscheck/comparison.json", make_comparison(False))
    nothing = make_comparison(None, reason="a mechanism")
    write_record(results / "open/crosscheck/comparison.json", nothing)
    rows = {
        row["design"]: row
        for row in run(tmp_path, [*sorted(p.name for p in results.iterdir()), "none"])
    }
    states = {name: row["state"] for name, row in rows.items()}
    assert states == {
        "fine": "converged",
        "open": "not_converged",
        "crumpled": "crumpled",
        "cut": "failed",
        "spoilt": "failed",
        "none": "failed",
    }
    assert rows["fine"]["crosscheck"] == "fail" and rows["cut"]["crosscheck"] == ""
    assert rows["open"]["crosscheck"] == "not possible"
    assert rows["crumpled"]["reason"] == "too steep"
    assert rows["cut"]["reason"] == "sizing/02/analysis.json is missing"
    assert rows["cut"]["volume_m3"] == "89.0"
    assert rows["spoilt"]["reason"] == "sizing/01/analysis.json is damaged"
    assert "quality.json is missing" in rows["none"]["reason"]


def test_leftovers_of_an_older_run_do_not_mix_in(tmp_path):
    """Iterations past the verdict stem from before an edit."""
    folder = tmp_path / "results/a"
    write_results(folder, iterations=6, verdict="not_converged")
    write_results(folder, iterations=3)
    (row,) = run(tmp_path, ["a"])
    assert (row["state"], row["iterations"], row["volume_m3"]) == ("converged", "3", "88.0")


def test_the_same_results_give_the_same_bytes(tmp_path):
    write_results(tmp_path / "results/a")
    run(tmp_path, ["a", "b"])
    before = [(tmp_path / name).read_bytes() for name in ("summary.csv", "summary.xlsx")]
    write_results(tmp_path / "results/a")
    run(tmp_path, ["a", "b"])
    after = [(tmp_path / name).read_bytes() for name in ("summary.csv", "summary.xlsx")]
    assert before == after
    assert b"seconds" not in before[0]


def test_workbook_has_the_same_rows_below_a_units_row(tmp_path):
    write_results(tmp_path / "results/a")
    rows = run(tmp_path, ["a", "b"])
    sheet = openpyxl.load_workbook(tmp_path / "summary.xlsx").worksheets[0]
    values = list(sheet.iter_rows(values_only=True))
    assert list(values[0]) == list(rows[0]) and values[1][4] == "m"
    for shown, row in zip(values[2:], rows, strict=True):
        for value, text in zip(shown, row.values(), strict=True):
            same = float(text) == value if isinstance(value, float) else text == str(value or "")
            assert same or float(text) == value


def test_no_design_at_all(tmp_path):
    with pytest.raises(InputError, match="at least one"):
        summary.main([], tmp_path, SETTINGS, tmp_path / "a.csv", tmp_path / "a.xlsx")
