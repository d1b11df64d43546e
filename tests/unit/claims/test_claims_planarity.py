"""Correlation of planarity and utilization."""

from dataclasses import replace

import numpy as np
import pytest

from claims_case import make_design_result
from foldshell.claims.planarity import describe_planarity, judge_correlations
from foldshell.results.correlation import linear_correlation, rank_correlation


@pytest.mark.parametrize(
    ("ranks", "verdict"),
    [
        ([0.6, 0.8], "holds"),
        ([-0.6, -0.8], "holds"),
        ([-0.6, 0.8], "mixed"),
        ([0.1, -0.2], "fails"),
        ([0.1, 0.7], "mixed"),
        ([], "cannot_be_told"),
    ],
)
def test_verdict(ranks, verdict):
    assert judge_correlations(ranks) == verdict


def test_pearson_needs_a_line_and_spearman_an_order():
    x = np.linspace(1, 2, 30)
    assert rank_correlation(x, x**9) == pytest.approx(1)
    assert linear_correlation(x, 3 - 2 * x) == pytest.approx(-1)
    assert linear_correlation(x, x**9) < 0.95
    assert np.isnan(linear_correlation(x, np.ones(30)))


def test_designs_are_pooled_and_single():
    """Falling within each design, rising between them: pooled panels mislead."""
    falls = [
        replace(
            make_design_result(zigzag=15 + k),
            panels=np.stack([np.arange(20) + 100 * k, 100 * k - np.arange(20)]).astype(float),
        )
        for k in range(3)
    ]
    found = describe_planarity([*falls, make_design_result(pattern="smooth")])
    numbers = found.numbers
    assert found.verdict == "holds" and numbers.spearman_median == pytest.approx(-1)
    assert numbers.pooled.spearman > 0.5 and numbers.pooled.panels == 60
    assert numbers.designs_positive == 0 and len(found.designs) == 3


def test_no_design_at_all():
    assert describe_planarity([]).verdict == "cannot_be_told"
