"""Which combinations the final state makes govern, and what its criteria allow."""

import pytest

from foldshell.records.analysis import Criteria
from foldshell.results.governing import choose_combinations, find_limits
from foldshell.settings.crosscheck import Crosscheck
from foldshell.settings.loads import Combinations
from record_cases import make_analysis, make_criterion

FACTORS = {"S1": 9.0, "S2": 5.0, "S5": 4.9, "S3": None, "D2": 1.0}


def choose(chosen=None, **changes):
    found = {"governing_combination": "S4", "displacement_combination": "D3",
             "buckling_factor": FACTORS}  # fmt: skip
    report = make_analysis(**found | changes)
    return choose_combinations(chosen or Crosscheck(), Combinations(), report)


def test_governing_are_those_of_panel_factor_and_displacement():
    """S5 has the least factor of the strength combinations; D2, less yet, is none of them."""
    assert choose() == {"strength": ["S4", "S5"], "deflection": ["D3"]}


def test_one_combination_that_governs_both_stands_once():
    assert choose(buckling_factor={"S4": 2.0, "S5": 3.0})["strength"] == ["S4"]


def test_named_ones_are_taken_as_they_are():
    found = choose(Crosscheck(strength=("S2", "S1"), deflection=("D1",)))
    assert found == {"strength": ["S2", "S1"], "deflection": ["D1"]}


def test_a_state_without_values_falls_back_on_the_first():
    nothing = {"governing_combination": None, "displacement_combination": None}
    found = choose(**nothing, buckling_factor={})
    assert found == {"strength": ["S1"], "deflection": ["D1"]}


@pytest.mark.parametrize("measure", ["utilization_panel_mean", "utilization_element_max"])
def test_limits_are_those_of_the_criteria(measure):
    """A limit on peaks is none on panel means."""
    down = make_criterion(limit=0.117)
    criteria = Criteria(displacement_vertical_m=down, **{measure: make_criterion(limit=0.9)})
    expected = {"displacement_down_max_m": 0.117}
    if measure == "utilization_panel_mean":
        expected["utilization_panel_mean_max"] = 0.9
    assert find_limits(make_analysis(criteria=criteria)) == expected
    assert find_limits(make_analysis()) == {}
