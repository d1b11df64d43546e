"""Limits of time for queues: never below what was measured, and rising with size and work."""

import pytest

from foldshell.engine.minutes import LEAST, SAFETY, SECONDS_AND_PER_NODE, estimate_minutes

MEASURED = {"fold": 0.1, "mesh": 0.04, "analyse": 1.88, "draw": 2.6, "page": 0.25}
"""Longest processor time (s) of the nine designs of 15 x 16 polylines, 22,776 nodes, two-core
machine."""


@pytest.mark.parametrize("rule", MEASURED)
def test_the_limit_is_above_what_was_measured(rule):
    base, each = SECONDS_AND_PER_NODE[rule]
    assert MEASURED[rule] < base + each * 22_776
    assert 60 * estimate_minutes(rule, 22_776) > SAFETY * MEASURED[rule]


def test_every_rule_has_longer_for_a_larger_mesh_and_for_more_work():
    for rule in SECONDS_AND_PER_NODE:
        assert estimate_minutes(rule, 10) == LEAST
        assert estimate_minutes(rule, 10**9) > estimate_minutes(rule, 10**8) > LEAST
        assert estimate_minutes(rule, 10**8, 40) > 30 * estimate_minutes(rule, 10**8)
