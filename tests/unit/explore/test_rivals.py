"""What the best of an exploration is held against, and what it is sized for."""

from dataclasses import replace

import pytest

from foldshell.explore import rivals
from foldshell.explore.rivals import choose_rivals, describe_exploration, list_factors, resize
from foldshell.records.candidate import CandidateRecord
from foldshell.settings.exploration import Exploration, Search, SearchLimits, Variable
from foldshell.settings.sizing import Sizing
from foldshell.settings.stage import read_stage

BASE = {"pattern": "miura", "surface": "arch", "support": "strip", "zigzag": 15, "strip": 16,
        "edge_beam_depth_m": 0.0, "rest_fold_angle_deg": 0.0}  # fmt: skip
EXPLORATION = Exploration(
    "roof", BASE, (Variable("rest_fold_angle_deg", 30, 62),), ("volume_m3",),
    SearchLimits(buckling_factor_min=4.0), Search(rule="dead_band"),
)  # fmt: skip


def make_record(name, volume, factor=5.0, **columns):
    return CandidateRecord(
        candidate=name, columns=BASE | columns, state="sized", reason="", feasible=True, broken=(),
        mesh_subdivisions=2, volume_m3=volume, buckling_factor_min=factor,
    )  # fmt: skip


RECORDS = [
    make_record("00-00", 90.0), make_record("00-01", 80.0, zigzag=50),
    make_record("00-02", 70.0, edge_beam_depth_m=0.5),
    make_record("00-03", 60.0, pattern="smooth"),
    make_record("01-00", 50.0, 7.126, rest_fold_angle_deg=30.1), make_record("01-01", 55.0),
]  # fmt: skip


def test_rivals_are_the_best_the_base_in_the_table_and_the_smooth_shell():
    """A row with an edge beam is another roof; without the base the lightest density counts."""
    assert [r.candidate for r in choose_rivals(EXPLORATION, RECORDS)] == ["01-00", "00-00", "00-03"]
    others = [make_record("00-04", 85.0, zigzag=30), *RECORDS[1:]]
    assert [r.candidate for r in choose_rivals(EXPLORATION, others)] == ["01-00", "00-01", "00-03"]


def test_a_range_whose_end_decides_is_told():
    """30.1 of 30 to 62 degrees is within 2 % of the range; 31 is not."""

    class Settings:
        class sizing:
            least_thickness = 0.04

    assert describe_exploration(EXPLORATION, RECORDS, Settings)["bounds"] == [
        ["rest_fold_angle_deg", 30.0]
    ]
    inside = [make_record("01-00", 50.0, rest_fold_angle_deg=31.0)]
    assert describe_exploration(EXPLORATION, inside, Settings)["bounds"] == []


def test_factors_are_those_of_the_search_of_the_best_and_a_few_more():
    assert list_factors(EXPLORATION, choose_rivals(EXPLORATION, RECORDS)) == [4.0, 6.0, 7.13, 12.0]


def test_every_shell_is_sized_by_one_rule_for_one_factor(monkeypatch):
    """The smooth shell keeps 8 as it stands, so it is sized for 4 and for 12; one that does not
    come to an end is tried again for each."""
    asked = []

    def evaluate(name, row, settings, exploration):
        factor = exploration.limits.buckling_factor_min
        asked.append((name, factor, exploration.search.rule))
        assert settings.sizing.buckling_factor_min == pytest.approx(0.99 * factor)
        kept = 8.0 if name == "00-03" else factor
        state = "not_converged" if name == "00-00" else "sized"
        return replace(make_record(name, 10 * factor), buckling_factor_min=kept, state=state)

    monkeypatch.setattr(rivals, "evaluate", evaluate)
    rows = resize(EXPLORATION, RECORDS, read_stage({"sizing": {}}, Sizing))
    assert {rule for _, _, rule in asked} == {"optimality"}
    assert [factor for name, factor, _ in asked if name == "00-03"] == [4.0, 12.0]
    assert [factor for name, factor, _ in asked if name == "00-00"] == [4.0, 6.0, 7.13, 12.0]
    smooth = [row for row in rows if row.kind == "smooth"]
    asked.clear()
    given = replace(EXPLORATION, search=Search(rule="optimality"))
    resize(given, RECORDS, read_stage({"sizing": {}}, Sizing))
    assert 4.0 not in [factor for _, factor, _ in asked]
    assert [row.volume_m3 for row in smooth] == pytest.approx([40.0, 40.0, 40.0, 120.0])
    assert len(rows) == 12 and {row.kind for row in rows} == {"found", "table", "smooth"}
