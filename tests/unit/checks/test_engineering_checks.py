"""Engineering checks by hand: required buckling factor, criteria by material, limits, verdicts."""

import numpy as np
import pytest

from foldshell.checks.materials import choose_strength_check
from foldshell.checks.stability import correct_factor, require_factor
from foldshell.checks.strength import utilization_capped_cone, utilization_tension
from foldshell.checks.verdict import Found, hold_against, judge_checks, unknown_check
from foldshell.settings.checks import Checks
from foldshell.settings.material import Material

CONCRETE = Material()
STEEL = Material(kind="steel", strength=355e3)


def test_the_factor_of_concrete_is_1_2_times_1_9_over_0_8_and_0_5():
    found = require_factor(Checks(), "concrete")
    assert found.product == pytest.approx(1.2 * 1.9 / 0.4) and found.value == 6.0


@pytest.mark.parametrize(
    ("changes", "kind", "product", "value"),
    [
        ({"buckling_cracking": 1.0}, "concrete", 2.85, 3.0),
        ({}, "user", 2.85, 3.0),
        ({}, "steel", 1.5, 1.5),
        ({"creep_coefficient": 3.0}, "concrete", 1.2 * 2.35 / 0.4, 7.5),
        ({"buckling_imperfection": 1.0, "buckling_partial_factor": 1.0}, "steel", 1.0, 1.0),
    ],
)
def test_each_term_of_the_factor_counts(changes, kind, product, value):
    found = require_factor(Checks().changed(**changes), kind)
    assert found.product == pytest.approx(product) and found.value == pytest.approx(value)


def test_mesh_error_takes_its_part_of_a_factor():
    """The error is relative to the limit: 2.63 with 17.4 % too much is 2.24."""
    assert correct_factor(2.63, 0.174) == pytest.approx(2.24, abs=0.001)
    assert correct_factor(2.63, None) == 2.63


def test_concrete_fails_by_tension_whatever_gamma_m():
    check = choose_strength_check(CONCRETE, 1.5)
    stress = np.array([1670.0, 0.0, 0.0])
    assert check.criterion(stress, check.material) == pytest.approx(1.0)
    assert check.criterion(np.array([-16700.0, -100.0, 0.0]), check.material) == pytest.approx(1.0)
    assert check.failure == "tension without reinforcement"


def test_steel_is_held_by_von_mises_over_gamma_m():
    """Pure shear yields at f / sqrt(3)."""
    check = choose_strength_check(STEEL, 1.1)
    shear = np.array([0.0, 0.0, 355e3 / 1.1 / np.sqrt(3)])
    assert check.criterion(shear, check.material) == pytest.approx(1.0)


def test_the_cone_of_a_user_is_capped_where_it_is_open():
    """Equal biaxial compression never reaches the cone; uniaxial strengths are both kept."""
    check = choose_strength_check(Material(kind="user", criterion="drucker_prager"), 1.0)
    assert check.criterion is utilization_capped_cone
    both = np.array([-16700.0, -16700.0, 0.0])
    assert check.criterion(both, check.material) == pytest.approx(1.0)
    for stress in ([-16700.0, 0.0, 0.0], [1670.0, 0.0, 0.0]):
        assert check.criterion(np.array(stress), check.material) == pytest.approx(1.0)


def test_tension_alone():
    assert utilization_tension(np.array([-5.0, -2.0, 0.0]), CONCRETE) == 0.0
    assert utilization_tension(np.array([0.0, 0.0, 1670.0]), CONCRETE) == pytest.approx(1.0)


def test_a_value_that_may_cross_its_limit_says_so():
    near = hold_against("a", Found(0.99, "ULS1", 3), 1.0, mesh_error=0.02)
    assert near.met and near.within_mesh_error and near.panel == 3
    assert not hold_against("a", Found(0.97), 1.0, mesh_error=0.02).within_mesh_error
    above = hold_against("a", Found(1.01), 1.0, mesh_error=0.02)
    assert above.met is False and above.within_mesh_error
    least = hold_against("a", Found(6.05), 6.0, at_least=True, mesh_error=0.02)
    assert least.met and least.within_mesh_error


def test_information_is_neither_met_nor_failed():
    check = hold_against("peak", Found(2.7), None)
    assert check.met is None
    assert judge_checks({"peak": check}, {}) == ("passes", "all checks are met")


def test_the_reason_begins_with_what_failed_and_names_its_place():
    checks = {
        "strength": hold_against("strength", Found(5.6, "ULS3", 104), 1.0),
        "stability": hold_against("buckling factor", Found(2.13, "ULS5", 7), 6.0, "", True),
        "sway": hold_against("sway", Found(0.05), 0.033, "m"),
        "long": unknown_check("long-term", 0.1, "m"),
        "near": hold_against("near", Found(0.99), 1.0, mesh_error=0.03),
    }
    verdict, reason = judge_checks(checks, {"strength": "tension without reinforcement"})
    assert verdict == "fails"
    assert reason == (
        "tension without reinforcement: 5.6 above 1 (ULS3, panel 104); "
        "buckling factor: 2.13 below 6 (ULS5, panel 7); sway: 0.05 above 0.033 m; "
        "long-term: not known; within the mesh error: near"
    )


def test_a_value_just_beyond_its_limit_is_shown_with_the_digits_that_tell():
    check = hold_against("factor", Found(1.4973), 1.5, at_least=True)
    assert judge_checks({"a": check}, {})[1] == "factor: 1.497 below 1.5"
