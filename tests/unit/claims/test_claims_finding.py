"""Verdicts from differences, counts and parts."""

import pytest

from claims_case import make_design_result
from foldshell.claims.design_result import (
    Comparer,
    estimate_uncertainty,
    group_by_others,
    pair_neighbours,
    state_fact,
)
from foldshell.claims.finding import (
    combine_errors,
    judge_claim,
    judge_difference,
    judge_many,
    judge_part,
)


@pytest.mark.parametrize(
    ("greater", "lesser", "uncertainty", "verdict"),
    [
        (2.0, 1.0, 0.9, "holds"),
        (1.0, 2.0, 0.9, "fails"),
        (2.0, 1.0, 1.1, "cannot_be_told"),
        (1.0, 2.0, 1.0, "cannot_be_told"),
        (2.0, None, 0.1, "cannot_be_told"),
        (2.0, 1.0, None, "cannot_be_told"),
        (1.0, 1.0, 0.0, "cannot_be_told"),
    ],
)
def test_a_difference_within_its_uncertainty_cannot_be_told(greater, lesser, uncertainty, verdict):
    assert judge_difference(greater, lesser, uncertainty) == verdict


def test_at_least_as_great_holds_for_equal_numbers_that_are_certain():
    """Round-off between them does not count."""
    assert judge_difference(0.04, 0.04 * (1 - 1e-15), 0.0, strict=False) == "holds"
    assert judge_difference(0.04, 0.04, 0.001, strict=False) == "cannot_be_told"
    assert judge_difference(0.04, 0.05, 0.0, strict=False) == "fails"


def _findings(holds, fails, untold):
    facts = [state_fact("p", "a", "q", 1.0, 0.0, True)] * holds
    facts += [state_fact("p", "a", "q", 1.0, 0.0, False)] * fails
    unknown = make_design_result({"displacement": None})
    return facts + [Comparer().compare("p", unknown, unknown, "displacement")] * untold


@pytest.mark.parametrize(
    ("counts", "verdict"),
    [
        ((3, 0, 0), "holds"),
        ((0, 3, 0), "fails"),
        ((2, 1, 0), "mixed"),
        ((0, 0, 3), "cannot_be_told"),
        ((0, 0, 0), "cannot_be_told"),
        ((3, 0, 2), "holds"),
        ((2, 0, 2), "cannot_be_told"),
        ((0, 1, 4), "cannot_be_told"),
        ((1, 1, 9), "mixed"),
    ],
)
def test_verdict_of_a_part(counts, verdict):
    assert judge_part(_findings(*counts)) == verdict


@pytest.mark.parametrize(
    ("counts", "verdict"),
    [
        ((2, 2, 0), "holds"),
        ((1, 3, 0), "mixed"),
        ((0, 3, 0), "fails"),
        ((0, 0, 2), "cannot_be_told"),
    ],
)
def test_many_is_half(counts, verdict):
    assert judge_many(_findings(*counts)) == verdict


@pytest.mark.parametrize(
    ("parts", "verdict"),
    [
        (["holds", "holds"], "holds"),
        (["fails", "fails"], "fails"),
        (["holds", "fails"], "mixed"),
        (["holds", "mixed"], "mixed"),
        (["holds", "cannot_be_told"], "cannot_be_told"),
        (["fails", "cannot_be_told"], "fails"),
        (["cannot_be_told"], "cannot_be_told"),
        ([], "cannot_be_told"),
    ],
)
def test_a_claim_asserts_all_its_parts(parts, verdict):
    assert judge_claim(parts) == verdict


def test_errors_add_as_squares():
    assert combine_errors(0.03, 0.04) == pytest.approx(0.05)
    assert combine_errors(0.03, None) is None


def test_uncertainty_of_a_displacement_is_mesh_and_crosscheck():
    """sqrt(3^2 + 4^2) = 5 % of 50 mm."""
    assert estimate_uncertainty(make_design_result(), "displacement", 0.01) == pytest.approx(0.0025)


def test_uncertainty_of_a_volume_is_that_of_the_panels_not_at_a_bound():
    """Half of 210 panels free: half of sqrt(5^2 + 12^2) = 13 %."""
    half = make_design_result({"panels_at_bound": 105})
    assert estimate_uncertainty(half, "volume_per_area", 0.12) == pytest.approx(0.05 * 0.13 / 2)
    thin = make_design_result({"panels_at_bound": 210})
    assert estimate_uncertainty(thin, "volume_per_area", 0.12) == 0.0


def test_a_volume_that_has_not_settled_is_as_uncertain_as_its_last_change():
    """sqrt(5^2 + 12^2) = 13 %, though the loop asks for 1 %."""
    open_end = make_design_result({"volume_change": 0.12})
    assert estimate_uncertainty(open_end, "volume", 0.01) == pytest.approx(80 * 0.13)


def test_a_pair_adds_the_uncertainty_of_both():
    """50 and 54 mm: 2.5 and 2.7 mm, together 3.68 mm, less than the difference."""
    low, high = make_design_result(), make_design_result({"displacement": 0.054})
    found = Comparer().compare("p", high, low, "displacement")
    assert found.uncertainty == pytest.approx(1e-3 * (2.5**2 + 2.7**2) ** 0.5)
    assert found.verdict == "holds"
    nearer = make_design_result({"displacement": 0.0535})
    assert Comparer().compare("p", nearer, low, "displacement").verdict == "cannot_be_told"


def test_groups_differ_in_one_column_only():
    designs = [
        make_design_result(height_m=h, support=s) for h in (28.0, 6.0, 10.0) for s in ("all",)
    ]
    designs += [make_design_result(height_m=6.0, support="strip", surface="arch")]
    pairs = [(a.row.height_m, b.row.height_m) for a, b in
             pair_neighbours(designs, "height_m")]  # fmt: skip
    assert pairs == [(6.0, 10.0), (10.0, 28.0)]
    assert group_by_others(designs, "support") == []
