"""Claims on shells that stand, beside those on the paper's: made-up results that must turn them."""

from dataclasses import replace

import pytest

from claims_case import make_design_result
from foldshell.claims.design_result import Comparer
from foldshell.claims.reinforced import (
    REACHED,
    add_steel,
    compare_verdicts,
    judge_reinforced,
    replace_factor,
)
from foldshell.claims.reinforced_gather import stand
from foldshell.claims.reinforced_state import list_errors
from foldshell.claims.reinforced_words import write_reinforced_claims
from foldshell.claims.structure import judge_surfaces
from foldshell.records.reinforced_claims import ReinforcedRecord

COMPARER = Comparer()
ERRORS = dict.fromkeys(
    ("displacement", "utilization", "utilization_panel_mean_max", "utilization_variation",
     "steel_kg_m2"), 0.03,
)  # fmt: skip
LOCAL = {
    "utilization_reinforced_mean": 0.8, "utilization_reinforced_max": 0.98,
    "utilization_reinforced_variation": 0.2, "steel_kg_m2": 12.0,
}  # fmt: skip


def make_state(paper, **values):
    """Return the record of a design that stands, its measures those of `paper` but for `values`."""
    measures = replace(paper.values, depth=None, edge_strain_rms=None, **LOCAL | values)
    return ReinforcedRecord(
        design=paper.name, settings="own.yaml", measures=measures, mesh_errors=ERRORS,
        engineering="passes", engineering_reason="all checks are met", steel_kg_m3=150.0,
        governing_share={"strut": 0.3, "fit": 0.7}, over_one_share={"strut": 0.0, "fit": 0.0},
    )  # fmt: skip


def make_surfaces(*volumes):
    names = ("paraboloid", "arch", "hypar")
    return [
        make_design_result({"volume_per_area": v, "volume": 1000 * v}, surface=surface)
        for surface, v in zip(names, volumes, strict=True)
    ]


def judge(paper, reinforced, key, equal=(), flats=None):
    found = judge_reinforced(paper, reinforced, equal, flats or {}, COMPARER, 7.0)
    return next(one for one in found if one.id == key)


def standing(paper, volumes, steel=(12.0, 12.0, 12.0)):
    return [
        stand(one, make_state(one, volume_per_area=v, volume=1000 * v, steel_kg_m2=s))
        for one, v, s in zip(paper, volumes, steel, strict=True)
    ]


def test_a_claim_that_holds_survives_only_where_it_holds_again():
    """Order of the volumes kept, turned round, and within the uncertainty of 5 %."""
    paper = make_surfaces(0.08, 0.06, 0.05)
    kept = judge(paper, standing(paper, (0.16, 0.12, 0.1)), "C6")
    assert (kept.paper.verdict, kept.verdict, kept.survives) == ("holds", "holds", "survives")
    turned = judge(paper, standing(paper, (0.1, 0.12, 0.16)), "C6")
    assert (turned.verdict, turned.survives) == ("fails", "falls")
    assert set(turned.parts_survive.values()) == {"falls"}
    close = judge(paper, standing(paper, (0.101, 0.1, 0.099)), "C6")
    assert (close.verdict, close.survives) == ("cannot_be_told", "cannot be told")


def test_one_part_that_turns_makes_the_claim_mixed():
    paper = make_surfaces(0.08, 0.06, 0.05)
    found = judge(paper, standing(paper, (0.16, 0.08, 0.12)), "C6")
    assert found.verdict == "mixed" and found.survives == "falls"
    assert found.parts_survive == {
        "paraboloid above arch": "survives", "paraboloid above hypar": "survives",
        "arch above hypar": "falls",
    }  # fmt: skip


def test_a_claim_that_failed_may_come_to_hold():
    paper = make_surfaces(0.05, 0.06, 0.08)
    found = judge(paper, standing(paper, (0.16, 0.12, 0.1)), "C6")
    assert (found.paper.verdict, found.survives) == ("fails", "comes to hold")


def test_utilization_is_that_of_reinforced_concrete_before_that_of_points():
    """By points the lower sheet is used better; reinforced the higher one is."""
    paper = [
        make_design_result({"utilization_mean": mean, "displacement": d}, height_m=h)
        for h, mean, d in ((6.0, 0.6, 0.06), (10.0, 0.4, 0.04))
    ]
    after = [
        stand(one, make_state(one, utilization_reinforced_mean=mean))
        for one, mean in zip(paper, (0.5, 0.9), strict=True)
    ]
    found = judge(paper, after, "C4")
    assert found.paper.parts["better utilization"] == "holds"
    assert found.parts_survive == {"better utilization": "falls", "more deflection": "survives"}


def test_steel_stands_beside_each_finding_on_volume_and_enters_no_verdict():
    paper = make_surfaces(0.08, 0.06, 0.05)
    found = judge(paper, standing(paper, (0.16, 0.12, 0.1), (8.0, 9.0, 20.0)), "C6")
    parts = {part.part: part for part in found.numbers.parts}
    assert parts["paraboloid above hypar (steel)"].verdict == "fails"
    assert not parts["paraboloid above hypar (steel)"].asserted and found.verdict == "holds"
    claim = judge_surfaces(paper, COMPARER)
    assert len(add_steel(claim, paper, COMPARER).findings) == len(claim.findings)


def test_buckling_comes_first_where_its_factor_over_the_one_due_is_the_least():
    """Strength is reached at 1 / 0.98 of the loads; a factor of 5 of the 7 that are due comes
    before it, one of 35 does not."""
    paper = [make_design_result({"buckling_factor": 0.5, "utilization_panel_mean_max": 0.9})]
    for factor, verdict in ((6.9, "cannot_be_told"), (35.0, "fails"), (5.0, "holds")):
        after = [stand(one, make_state(one, buckling_factor=factor)) for one in paper]
        found = judge(paper, after, "C10")
        part = next(p for p in found.numbers.parts if p.part == "buckling before strength")
        assert part.verdict == verdict, factor
        bound = "buckling factor" in found.numbers.held_by
        assert bound == (factor / 7.0 < REACHED)
    assert replace_factor(paper[0], 7.0).values.buckling_factor == pytest.approx(0.5 / 7)


def test_panels_that_stay_above_one_are_those_of_the_reinforced_loop():
    paper = [make_design_result(support=support) for support in ("zigzag", "strip")]
    after = [
        stand(one, make_state(one, above_one=4, above_one_at_free_edge=edge))
        for one, edge in zip(paper, (4, 3), strict=True)
    ]
    found = judge(paper, after, "C11")
    assert found.paper.verdict == "fails" and found.verdict == "holds"
    assert found.survives == "comes to hold"


def test_geometry_is_that_of_the_folded_sheet_and_errors_are_its_own():
    paper = make_design_result({"depth": 1.9})
    after = stand(paper, make_state(paper))
    assert after.values.depth == 1.9
    assert after.errors["displacement"] == (0.03, 0.04)
    assert after.errors["buckling"] == paper.errors["buckling"]
    assert after.measure("utilization_variation") == 0.2
    errors = list_errors({"steel_kg_m2": None}, paper.errors)
    assert errors["steel_kg_m2"] == (None, 0.04)


@pytest.mark.parametrize(
    ("before", "after", "word"),
    [("holds", "holds", "survives"), ("holds", "mixed", "falls"), ("mixed", "mixed", "never held"),
     ("fails", "holds", "comes to hold"), ("holds", "cannot_be_told", "cannot be told")],
)  # fmt: skip
def test_what_becomes_of_a_verdict(before, after, word):
    assert compare_verdicts(before, after) == word


def test_the_page_says_both_verdicts_what_changed_and_why_a_shell_fails():
    paper = make_surfaces(0.08, 0.06, 0.05)
    states = [make_state(one) for one in paper]
    states[1] = replace(states[1], engineering="fails", engineering_reason="shear in panel 7")
    claims = judge_reinforced(paper, standing(paper, (0.1, 0.12, 0.16)), (), {}, COMPARER, 7.0)
    page = write_reinforced_claims(claims, states, "own.yaml")
    row = next(line for line in page.splitlines() if line.startswith("| C6 |"))
    assert row.endswith("| holds | - | fails | falls |")
    assert "| C6 | paraboloid above arch | holds | fails |" in page
    assert "1 fails, 2 passes" in page and "shear in panel 7" in page
    assert "fit, 70 %" in page
