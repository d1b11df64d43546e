"""Fixed panels, bounds of their own, groups, thicknesses that can be built, and analysis alone."""

from dataclasses import replace

import numpy as np
import pytest
from test_filtered import iteration

from foldshell.records.analysis import Criteria
from foldshell.settings.sizing import Sizing
from foldshell.sizing.buildable import list_buildable, round_up
from foldshell.sizing.case import open_case
from foldshell.sizing.constraints import Constraints
from foldshell.sizing.criteria import judge_iteration
from foldshell.sizing.loop import run_loop
from foldshell.sizing.panel_limits import no_limits
from foldshell.sizing.step import propose_thickness
from record_cases import make_analysis, make_criterion
from sizing_case import PANELS, SPAN, given, write_small_mesh

T = np.full(4, 0.1)
MET = Criteria(displacement_vertical_m=make_criterion(True))


def limits(**arrays):
    found = no_limits(4)
    for name, values in arrays.items():
        getattr(found, name)[:] = values
    return found


def step(used, asked, sizing=None, thickness=T, constraints=None, memory=None, **analysis):
    record = make_analysis(**{"criteria": MET, "buckling_factor": {"S1": 9.0}} | analysis)
    return propose_thickness(
        record, thickness, used, memory, sizing or Sizing(), constraints, asked
    )


@pytest.mark.parametrize(
    "rule", ["dead_band", "fully_stressed", "optimality", "filtered_dead_band"]
)
def test_fixed_panels_and_own_bounds_hold_under_every_rule(rule):
    asked = limits(fixed=[True, False, False, False], least=[np.nan, 0.098, np.nan, np.nan],
                   largest=[np.nan, np.nan, 0.104, np.nan])  # fmt: skip
    held = Constraints(np.array([0.2]), -np.ones((1, 4)), np.ones(4), np.full(4, 2))
    for used in (np.full(4, 0.1), np.full(4, 2.0)):
        new = step(used, asked, Sizing(rule=rule), constraints=held).thickness
        assert new[0] == 0.1 and new[1] >= 0.098 and new[2] <= 0.104
    buckled = step(None, asked, Sizing(rule=rule), state="unstable").thickness
    assert buckled.tolist() == pytest.approx([0.1, 0.11, 0.104, 0.11])


def test_the_most_used_panel_speaks_for_its_group():
    asked = limits(group=[1, 1, 2, 2])
    new = step(np.array([1.2, 0.1, 0.3, 0.1]), asked)
    assert new.thickness == pytest.approx([0.11, 0.11, 0.09, 0.09])
    fixed = replace(asked, fixed=np.array([True, False, False, False]))
    assert step(np.array([0.5, 1.4, 0.3, 0.1]), fixed).thickness[:2].tolist() == [0.1, 0.1]
    assert step(np.array([0.5, 1.4, 0.3, 0.1]), fixed).note[0] == "fixed"


def test_groups_share_the_gradient_of_a_limit():
    """Two panels that are one count twice for the limit and for the volume: the pair thins, whose
    members do half of what the single ones do."""
    held = Constraints(np.array([0.985]), np.array([[-0.1, -0.1, -9.0, -9.0]]), np.ones(4),
                       np.ones(4, int))  # fmt: skip
    asked = limits(group=[1, 1, 0, 0])
    rule = Sizing(rule="filtered_dead_band")
    new = step(np.full(4, 0.3), asked, rule, constraints=held).thickness
    assert new[0] == new[1] == pytest.approx(0.09) and (new[2:] > 0.0995).all()


def test_buildable_thicknesses_are_multiples_or_a_list():
    assert list_buildable(Sizing()) is None
    found = list_buildable(Sizing(thickness_step=0.01, least_thickness=0.042))
    assert found[0] == 0.05 and found[-1] == 1.0 and len(found) == 96
    chosen = list_buildable(Sizing(thickness_list=(0.05, 0.08, 0.2)))
    assert round_up(np.array([0.05, 0.0501, 0.3]), chosen).tolist() == [0.05, 0.08, 0.2]


def test_steps_are_rounded_up_and_still_thin():
    """50 mm - 10 % is 45 mm: with steps of 10 mm that would stay at 50 for ever, so it is 40; 90 mm
    from 100; 110 mm from 105 by growing; a panel in its band stays."""
    sizing = Sizing(thickness_step=0.01)
    t = np.array([0.05, 0.1, 0.1, 0.12])
    new = step(np.array([0.3, 0.3, 1.2, 0.8]), None, sizing, t).thickness
    assert new == pytest.approx([0.04, 0.09, 0.11, 0.12])


def test_a_panel_between_two_thicknesses_comes_to_rest_at_the_larger():
    """It fails at 40 mm and idles at 60: after three turns it thins no more."""
    sizing = Sizing(thickness_list=(0.04, 0.06), largest_thickness=0.06, start_thickness=0.06)
    t, memory, seen = np.full(4, 0.06), None, []
    for _ in range(8):
        used = np.where(t > 0.05, 0.5, 1.1)
        new = step(used, None, sizing, t, memory=memory)
        t, memory = new.thickness, new.memory
        seen.append(float(t[0]))
    assert seen[-3:] == [0.06] * 3 and 0.04 in seen


def test_under_predicted_limits_the_harmless_go_first():
    """Only one of the two may go from 50 to 40 mm: 0.98 + c (1/.04 - 1/.05) <= .99 holds for
    c = .001 and not for c = .01."""
    sizing = Sizing(rule="filtered_dead_band", thickness_step=0.01)
    t = np.full(2, 0.05)
    held = Constraints(np.array([0.98]), np.array([[-0.01, -0.001]]) / t**2, np.ones(2),
                       np.ones(2, int))  # fmt: skip
    new = step(np.full(2, 0.3), None, sizing, t, held).thickness
    assert new.tolist() == [0.05, 0.04]


def test_fixed_panels_that_cannot_hold_are_named():
    asked = no_limits(3)
    asked.fixed[1] = True
    now = iteration(utilization=np.array([0.7, 1.3, 0.9]), limits=asked, displacement=0.01)
    found = judge_iteration(now, Sizing())
    assert found.verdict == "not_converged" and "fixed panels cannot hold: 1" in found.reason
    moving = replace(now, previous_volume=120.0)
    assert judge_iteration(moving, Sizing()).verdict == "continue"
    asked.fixed[:] = True
    first = replace(now, iteration=0, previous_volume=None, previous_thickness=None)
    assert "every panel is fixed" in judge_iteration(first, Sizing()).reason


def test_analysis_alone_judges_limits_and_ends(tmp_path):
    """Neither the lower limit of utilization nor changes of volume are asked for."""
    alone = Sizing(analyse_only=True)
    now = iteration(iteration=0, previous_volume=None, previous_thickness=None)
    found = judge_iteration(now, alone)
    assert found.verdict == "converged" and found.criteria.utilization_min is None
    beyond = judge_iteration(replace(now, utilization=np.full(3, 1.2)), alone)
    assert beyond.verdict == "not_converged" and "analysed as given" in beyond.reason
    buckled = replace(now, state="unstable", reason="buckled")
    assert judge_iteration(buckled, alone).verdict == "unstable"


def test_a_loop_keeps_what_is_asked_to_its_end(tmp_path):
    mesh = write_small_mesh(tmp_path / "mesh.npz", "zigzag")
    case = given("size", least_thickness=0.02, thickness_step=0.005, iterations_max=9)
    asked = no_limits(PANELS)
    asked.fixed[3], asked.group[:2], asked.least[5] = True, 4, 0.1
    found = run_loop(open_case(mesh, case), SPAN, case.sizing, asked)
    t = found.arrays.thickness
    assert t[3] == 0.15 and t[0] == t[1] and t[5] == 0.1 and t.min() < 0.1
    assert np.allclose(t / 0.005, np.round(t / 0.005), atol=1e-9)
    assert np.array_equal(found.arrays.panel_group, asked.group)
