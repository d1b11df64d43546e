"""Candidates: the loop of the workflow in memory, whatever becomes of a design, and its slopes."""

import base64
import struct
from dataclasses import replace

import numpy as np
import pytest

from foldshell.explore.evaluate import evaluate, screen
from foldshell.explore.folded import fold_candidate, make_design
from foldshell.explore.tables import (
    describe_search,
    read_candidate,
    tabulate,
    write_candidates,
)
from foldshell.settings.design import Design
from foldshell.settings.exploration import Exploration, Search, SearchLimits, Variable
from foldshell.settings.make import make_settings
from foldshell.settings.stage import read_stage
from foldshell.settings.stages import SEARCHED, search_parameters

SIZING = {"least_thickness_mm": 8, "start_thickness_mm": 60, "utilization_min": 0.2}
SETTINGS = make_settings({"sizing": SIZING})
STAGE = read_stage(search_parameters(SETTINGS), *SEARCHED)
VARIABLES = (Variable("sector_angle_deg", 50.0, 70.0), Variable("strip_grading", -0.5, 0.5))


def exploration(rule="dead_band", **limits):
    limits = {"buckling_factor_min": 2.0, "plan_coverage_min": 0.5} | limits
    row = make_design_row()
    return Exploration("t", row, VARIABLES, ("volume_m3",), SearchLimits(**limits),
                       Search(rule=rule, subdivisions=1))  # fmt: skip


def make_design_row(**changed):
    plain = Design(name="base", **vars(SETTINGS.defaults)).to_row()
    row = {key: value for key, value in plain.items() if key not in ("design", "tags")}
    return row | {"span_m": 12.0, "height_m": 4.0, "zigzag": 7, "strip": 8, "support": "strip",
                  "sector_angle_deg": 60.0, "rest_fold_angle_deg": 40.0,
                  "strip_grading": 0.1} | changed  # fmt: skip


def test_a_candidate_is_sized_with_all_that_is_said_of_it():
    record = evaluate("01-00", {"design": "x", **make_design_row()}, STAGE, exploration())
    assert record.state == "sized" and record.volume_m3 > 0 and record.iterations > 3
    assert record.panels == 42 and record.rest_fold_angle_deg == pytest.approx(40.0)
    folded = fold_candidate(make_design(make_design_row()), STAGE)
    vertices = folded.arrays.vertices
    assert record.area_m2 == pytest.approx(_area(vertices[folded.arrays.facets]), rel=1e-12)
    assert record.cheap_m3 == screen({"design": "x", **make_design_row()}, STAGE,
                                     exploration()).cheap_m3  # fmt: skip
    raw = base64.b64decode(record.geometry)
    count, panels, strips = struct.unpack_from("<III", raw)
    low, size = np.split(np.array(struct.unpack_from("<6f", raw, 12)), 2)
    packed = np.frombuffer(raw, "<u2", 3 * count, 36).reshape(-1, 3)
    assert strips == 8 and len(raw) == 36 + 6 * count
    assert (count, panels) == (len(vertices), 42)
    np.testing.assert_allclose(low + packed / 65535 * size, vertices, atol=2e-4)


def _area(corners):
    sides = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return np.linalg.norm(np.cross(*sides), axis=1).sum() / 2


@pytest.mark.parametrize(
    ("changed", "limits", "state", "said"),
    [
        ({}, {"plan_coverage_min": 1.05}, "sized", "plan_coverage_min"),
        ({}, {"buckling_factor_min": 100.0}, "sized", "buckling_factor_min"),
        ({"sector_angle_deg": 30.0, "rest_fold_angle_deg": 0.0}, {}, "not_reached", ""),
        ({"sector_angle_deg": 6.0, "rest_fold_angle_deg": 85.0}, {}, "not_reached", ""),
        (
            {"sector_angle_deg": 88.0, "rest_fold_angle_deg": 85.0, "height_m": 12.0},
            {},
            "crumpled",
            "",
        ),
    ],
)
def test_what_fails_is_a_row_with_its_reason(changed, limits, state, said):
    row = {"design": "x", **make_design_row(**changed)}
    record = evaluate("01-00", row, STAGE, exploration(**limits))
    assert not record.feasible and record.reason
    assert record.state == state
    assert said in record.broken or not said


def test_tables_go_both_ways_and_name_units(tmp_path):
    rows = [{"design": "01-00", **make_design_row(strip_grading=0.25)}]
    write_candidates(tmp_path / "c.tsv", rows)
    row = read_candidate(tmp_path / "c.tsv", "01-00")
    assert row["strip_grading"] == 0.25 and row["zigzag"] == 7
    record = evaluate("01-00", row, STAGE, exploration())
    header, line = tabulate(exploration(), [record])
    told = dict(zip(header, line, strict=True))
    assert told["volume_m3"] == record.volume_m3 and told["sector_angle_deg"] == pytest.approx(60.0)


def judge(pattern, limits=(), **columns):
    """Size a small shell by measure reinforced, with all that is said of steel."""
    priced = {"concrete_m3": 300.0, "steel_kg": 2.0, "crease_m": 5.0}
    loop = SIZING | {"least_thickness_mm": 45}
    stage = read_stage(search_parameters(make_settings({"sizing": loop, "prices": priced})),
                       *SEARCHED)  # fmt: skip
    given = exploration("filtered_dead_band", **dict(limits))
    given = replace(given, aims=("engineering_volume_m3", "cost"),
                    search=given.search.changed(measure="reinforced"))  # fmt: skip
    row = given.make_row("01-00", make_design_row(pattern=pattern, support="all") | columns)
    return evaluate("01-00", row, stage, given)


def test_steel_carbon_and_cost_of_a_candidate():
    """Sums by hand, with the factors of the settings: 7850 kg/m3, 240 kg/m3, 1.2 kg/kg."""
    record = judge("miura", {"verdicts": "both"})
    assert record.state == "sized" and record.steel_kg > 0
    density = record.steel_kg / 7850
    assert record.engineering_volume_m3 == pytest.approx(record.volume_m3 + density, rel=1e-12)
    assert record.co2_kg == pytest.approx(240 * record.volume_m3 + 1.2 * record.steel_kg, rel=1e-9)
    cost = 300 * record.volume_m3 + 2 * record.steel_kg + 5 * record.crease_length_m
    assert record.cost == pytest.approx(cost, rel=1e-6)
    assert record.feasible == (record.engineering == "passes" and not record.broken)


def test_a_design_that_fails_the_engineering_verdict_is_excluded_by_it():
    """A dome of 40 mm without room for its bars, sized by the paper's measure."""
    given = replace(exploration(verdicts="both"), aims=("steel_kg",))
    record = evaluate("01-00", given.make_row("01-00", make_design_row()), STAGE, given)
    assert record.state == "sized" and record.engineering == "fails"
    assert record.broken == ("engineering",) and not record.feasible
    assert record.engineering_reason and record.engineering_volume_m3 is None
    said = describe_search(given, [record])
    assert said == "t: no candidate keeps all limits: engineering excluded most, 1 of 1"


@pytest.mark.parametrize(("pattern", "panels"), [("accordion", 42), ("smooth", 42)])
def test_other_patterns_and_plans_are_candidates(pattern, panels):
    """Of 7 x 8 lines on 12.73 m x 11.31 m, 1.125 to 1; an accordion does not reach a dome."""
    given = exploration(plan_coverage_min=0.0)
    values = {"pattern": pattern, "support": "all", "span_ratio": 1.125, "height_m": 3.0}
    row = given.make_row("01-00", make_design_row() | values)
    assert row["strip_grading"] == 0 and row["sector_angle_deg"] == 0
    folded = fold_candidate(make_design(row), STAGE)
    sides = [12 * 1.125**0.5, 12 / 1.125**0.5]
    np.testing.assert_allclose(make_design(row).sides, sides, rtol=1e-5)
    if pattern == "smooth":
        np.testing.assert_allclose(np.ptp(folded.arrays.vertices, axis=0)[:2], sides, rtol=0.01)
    record = evaluate("01-00", row, STAGE, given)
    assert record.panels == panels and record.volume_m3 > 0
    assert record.value_of("span_ratio") == pytest.approx(1.125, abs=1e-5)
    quads = struct.unpack_from("<III", base64.b64decode(record.geometry))
    assert quads == ((56, 42, 8) if pattern == "smooth" else (56, 84, 0))
