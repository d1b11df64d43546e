"""C10 to C13 on designs made by hand."""

from dataclasses import replace

import pytest

from claims_case import make_design_result
from foldshell.claims import limits
from foldshell.claims.design_result import Comparer
from foldshell.records.measures import FlatEqualRecord

COMPARER = Comparer()


@pytest.mark.parametrize(
    ("states", "verdict"),
    [
        ([(0.4, 1.2)], "holds"),
        ([(0.95, 10.0)], "fails"),
        ([(0.4, 1.2), (0.95, 10.0)], "mixed"),
        ([(0.5, 2.0)], "cannot_be_told"),
    ],
)
def test_buckling_before_strength(states, verdict):
    """Strength is reached at 1 / 0.4 = 2.5 times the loads, buckling at 1.2 times."""
    designs = [
        make_design_result({"utilization_panel_mean_max": u, "buckling_factor": f}, strip=16 + k)
        for k, (u, f) in enumerate(states)
    ]
    assert limits.judge_buckling(designs, COMPARER).judge()[0] == verdict


@pytest.mark.parametrize(
    ("mean", "verdict"), [(0.3, "holds"), (0.8, "fails"), (0.6, "cannot_be_told")]
)
def test_low_utilization_stands_beside_the_reason(mean, verdict):
    """Low is below 0.6, the lower limit of Table 3."""
    claim = limits.judge_buckling([make_design_result({"utilization_mean": mean})], COMPARER)
    assert claim.judge()[1]["utilization is low"] == verdict
    assert claim.judge()[0] == "fails"


def test_what_holds_designs():
    bindings = limits.count_bindings(
        [
            make_design_result({"displacement": 0.11, "utilization_panel_mean_max": 0.7}),
            make_design_result({"panels_at_bound": 210, "utilization_panel_mean_max": 0.5}),
            make_design_result({"buckling_factor": 1.2}),
            make_design_result({"displacement": None, "state": "unstable"}),
            make_design_result({"buckling_factor": None, "utilization_panel_mean_max": 0.7}),
        ],
        COMPARER,
    )
    assert bindings == {
        "buckling factor": 1,
        "displacement": 1,
        "least thickness in every panel": 1,
        "none of these": 1,
        "unstable": 1,
        "utilization of a panel": 1,
    }


def _on_two_edges(*above):
    return [
        make_design_result(
            {"above_one": a, "above_one_at_free_edge": b}, support="strip", strip=16 + k
        )
        for k, (a, b) in enumerate(above)
    ]


@pytest.mark.parametrize(
    ("above", "verdict"),
    [
        (((4, 4), (3, 2), (0, 0)), "holds"),
        (((0, 0), (0, 0)), "fails"),
        (((4, 4), (0, 0), (0, 0)), "mixed"),
        (((4, 1), (3, 0)), "mixed"),
    ],
)
def test_free_edges(above, verdict):
    assert limits.judge_free_edges(_on_two_edges(*above)).judge()[0] == verdict


def test_points_above_one_are_said_beside_the_panels():
    designs = [make_design_result({"utilization_max": u}, support="strip", strip=16 + k)
               for k, u in enumerate((2.0, 0.9))]  # fmt: skip
    (note,) = limits.judge_free_edges(designs).notes
    assert "single points exceed 1 in 1 of 2 designs" in note


def test_free_edges_of_designs_held_all_round_say_nothing():
    claim = limits.judge_free_edges([make_design_result({"above_one": 5})])
    assert claim.judge()[0] == "cannot_be_told"


@pytest.mark.parametrize(
    ("edge", "inner", "verdict"),
    [
        (0.09, 0.05, "holds"),
        (0.05, 0.09, "fails"),
        (0.050, 0.049, "cannot_be_told"),
    ],
)
def test_deflection_along_free_edges(edge, inner, verdict):
    values = {"displacement_edge": edge, "displacement_inner": inner}
    designs = [make_design_result(values, support="zigzag")]
    assert limits.judge_deflected_edges(designs, COMPARER).judge()[0] == verdict


def _flat(displacement, first=None):
    values = make_design_result().values
    return FlatEqualRecord(
        flat="flat-sheet", thickness_m=0.05, volume_m3=80.0, area_m2=1600.0, sides_m=(40.0, 40.0),
        state="ok" if displacement else "unstable",
        displacement_first_order_m=first or displacement, errors={"displacement": (0.01, 0.0)},
        measures=replace(values, displacement=displacement, utilization_panel_mean_max=3.0),
    )  # fmt: skip


@pytest.mark.parametrize(
    ("flat", "verdict"),
    [(_flat(3.0), "holds"), (_flat(0.01), "fails"), (_flat(0.051), "cannot_be_told")],
)
def test_flat_sheet_of_equal_volume(flat, verdict):
    design = make_design_result()
    claim = limits.judge_folds([design], {design.name: flat}, COMPARER)
    assert claim.judge()[0] == verdict


def test_a_flat_sheet_that_buckles_does_not_stand():
    design = make_design_result()
    (finding,) = limits.judge_folds([design], {design.name: _flat(None, 2.0)}, COMPARER).findings
    assert finding.verdict == "holds" and finding.values == (2.0, 0.05)


def test_sized_flat_sheets_stand_beside_the_claim():
    designs = [
        make_design_result({"volume": v}, pattern=p) for p, v in (("flat", 700.0), ("miura", 80.0))
    ]
    claim = limits.judge_folds(designs, {designs[1].name: _flat(3.0)}, COMPARER)
    verdict, parts = claim.judge()
    assert verdict == "holds" and parts[limits.SIZED] == "holds"
    (sized,) = [finding for finding in claim.findings if finding.part == limits.SIZED]
    assert sized.values == (700.0, 80.0)
