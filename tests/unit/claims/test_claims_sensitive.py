"""How verdicts change with settings, and what is said of claims that no run covers."""

from claims_case import make_design_result
from foldshell.claims.design_result import Comparer
from foldshell.claims.sensitive import (
    describe_dependence,
    judge_equal_thickness,
    judge_variants,
)
from foldshell.claims.structure import judge_curvature, judge_surfaces
from foldshell.claims.study import list_runs

COMPARER = Comparer()


def _surfaces(dome, arch, saddle):
    values = {"paraboloid": dome, "arch": arch, "hypar": saddle}
    return [
        make_design_result({"volume_per_area": v, "volume": 1000 * v}, surface=s)
        for s, v in values.items()
    ]


VARIANTS = {
    "base": _surfaces(0.08, 0.06, 0.05),
    "start_60": _surfaces(0.09, 0.06, 0.05),
    "element_max": _surfaces(0.16, 0.05, 0.06),
}


def test_changes_of_the_claim_and_of_its_parts_are_named():
    found = judge_variants("C6", VARIANTS, COMPARER)
    assert found.verdicts["base"].verdict == "holds"
    assert found.changes == {"element_max": {"the claim": "mixed", "arch above hypar": "fails"}}
    words = describe_dependence(judge_surfaces(VARIANTS["base"], COMPARER), found, None, VARIANTS)
    assert "On the 3 designs run with other settings: holds" in words
    assert "for start_60; with element_max the claim: mixed, arch above hypar: fails." in words


def test_claims_that_the_runs_do_not_cover_tell_how_far_volumes_change():
    """90 / 80 m3 on one surface, 160 / 80 m3 for the other setting."""
    assert judge_variants("C4", VARIANTS, COMPARER) is None
    words = describe_dependence(judge_curvature([], COMPARER), None, None, VARIANTS)
    assert "No run with other settings answers this claim" in words
    assert "12.5 % with start_60" in words and "100 % with element_max" in words


def test_folding_knows_no_setting_of_the_loop():
    assert judge_variants("C1", VARIANTS, COMPARER) is None
    assert judge_equal_thickness("C6", VARIANTS["base"], COMPARER) is None


def test_equal_thickness_leaves_volumes_out():
    equal = [
        make_design_result({"volume_per_area": v, "displacement": w}, support=s)
        for s, v, w in (("strip", 0.15, 0.09), ("zigzag", 0.15, 0.05))
    ]
    parts = judge_equal_thickness("C7", equal, COMPARER).parts
    assert parts["more deflection"] == "holds" and "more volume" not in parts


def test_table_of_runs_has_the_volume_over_that_of_the_base():
    rows = {(row.design, row.variant): row for row in list_runs(VARIANTS)}
    assert len(rows) == 9
    name = VARIANTS["base"][0].name
    assert rows[name, "element_max"].volume_over_base == 2.0
    assert rows[name, "base"].volume_over_base == 1.0
