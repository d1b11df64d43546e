"""The rule `filtered_dead_band`, what it counts as an end, and the state that a loop delivers."""

from dataclasses import replace

import numpy as np
import pytest

from foldshell.records.analysis import Criteria
from foldshell.records.arrays import list_arrays
from foldshell.settings.sizing import Sizing
from foldshell.sizing.case import open_case
from foldshell.sizing.constraints import Constraints, least_factor_due
from foldshell.sizing.criteria import IterationState, judge_iteration
from foldshell.sizing.delivery import choose_delivered, describe_delivered
from foldshell.sizing.filtered import filtered_dead_band, predict
from foldshell.sizing.loop import run_loop
from foldshell.sizing.rules import dead_band, start_state
from record_cases import make_analysis, make_criterion
from sizing_case import SPAN, given, write_small_mesh

RULE = Sizing(rule="filtered_dead_band", least_thickness=0.02)
T = np.full(3, 0.1)


def state(utilization, value, gradient, thinning=(2, 2, 2), **changes):
    """Return a state of three panels of 1 m2 under one constraint."""
    count = len(np.atleast_1d(value))
    held = Constraints(
        np.atleast_1d(value).astype(float), np.reshape(gradient, (count, 3)).astype(float),
        np.ones(3), np.array(thinning),
    )  # fmt: skip
    used = np.asarray(utilization, float)
    return replace(start_state(T, 0.1), utilization=used, constraints=held, **changes)


def test_away_from_limits_it_is_the_dead_band():
    """Nothing is predicted to pass 99 %: the very numbers of the dead band."""
    now = state([1.2, 0.8, 0.3], 0.5, [-1.0, -1.0, -1.0])
    assert (
        filtered_dead_band(now, RULE).thickness.tolist() == dead_band(now, RULE).thickness.tolist()
    )


def test_prediction_is_linear_where_g_grows_and_reciprocal_where_it_falls():
    """g = 0.5 + 2 (t1 - .1) + 3 .01 (1 / t2 - 10): by hand at t = .11, .08."""
    held = Constraints(np.array([0.5]), np.array([[2.0, -3.0]]), np.ones(2))
    found = predict(held, np.full(2, 0.1), np.array([0.11, 0.08]))
    assert found == pytest.approx([0.5 + 0.02 + 0.03 * 2.5])


def test_at_a_limit_only_the_panels_thin_that_do_least_for_it():
    """All want to thin. The third does nothing for the limit and thins by two steps (0.9^2); the
    first does most and stays; of the second as much thins as the limit allows."""
    new = filtered_dead_band(state([0.3] * 3, 0.98, [-9.0, -1.0, 0.0]), RULE).thickness
    assert new[0] == pytest.approx(0.1) and new[2] == pytest.approx(0.081)
    assert new[1] == pytest.approx(0.01 / (0.1 + 0.01), rel=1e-3)  # 0.98 + .01 (1/x - 10) = .99


def test_panels_that_bulge_keep_their_thickness_at_a_limit():
    new = filtered_dead_band(state([0.3] * 3, 0.985, [-9, 0, 0], (2, 0, 1)), RULE).thickness
    assert new[1:] == pytest.approx([0.1, 0.09])


def test_where_a_limit_is_passed_the_most_efficient_grow_by_one_step_at_most():
    new = filtered_dead_band(state([0.8] * 3, 1.02, [-9.0, -1.0, 0.0]), RULE).thickness
    assert 0.1 < new[0] < 0.11 and new[1:] == pytest.approx([0.1, 0.1])
    hopeless = filtered_dead_band(state([0.8] * 3, 2.0, [-9.0, 0.0, 0.0]), RULE).thickness
    assert 0.1 < hopeless[0] <= 0.11 and hopeless[1:] == pytest.approx([0.1, 0.1])


def test_overstressed_panels_grow_whatever_the_limits_say():
    new = filtered_dead_band(state([1.2, 0.8, 0.8], 0.995, [0.0, -1.0, 0.0]), RULE).thickness
    assert new == pytest.approx([0.11, 0.1, 0.1])


def test_analysis_without_predictions_is_refused():
    with pytest.raises(ValueError, match="made for another rule"):
        filtered_dead_band(replace(start_state(T, 0.1), utilization=T), RULE)


def iteration(**changes) -> IterationState:
    base = IterationState(
        iteration=8, state="ok", reason="", thickness=T, utilization=np.full(3, 0.2),
        displacement=0.98 * 28 / 240, span=28.0, volume=100.0, previous_volume=100.4,
        previous_thickness=1.1 * T, previous_stationary=2, buckling_factor=9.0,
    )  # fmt: skip
    return replace(base, **changes)


@pytest.mark.parametrize("rule", ["filtered_dead_band", "optimality"])
def test_displacement_at_its_limit_ends_a_loop(rule):
    """A share of 0.98: within 3 % of the limit, used to 0.2 only; third quiet iteration."""
    sizing = Sizing(rule=rule, volume_change_max_relative=0.03)
    found = judge_iteration(iteration(), sizing)
    assert found.verdict == "converged" and "displacement_vertical_m" in found.reason
    assert judge_iteration(iteration(previous_stationary=1), sizing).verdict == "continue"
    assert judge_iteration(iteration(displacement=0.96 * 28 / 240), sizing).verdict == "continue"
    assert judge_iteration(iteration(displacement=28 / 239), sizing).verdict == "continue"
    assert judge_iteration(iteration(utilization=np.full(3, 1.1)), sizing).verdict == "continue"


def test_buckling_at_its_limit_ends_a_loop_and_the_larger_limit_counts():
    sizing = replace(RULE, buckling_factor_min=6.0)
    assert least_factor_due(sizing) == 6.0 and least_factor_due(RULE) == 1.5
    low = iteration(displacement=0.01, buckling_factor=6.1)
    found = judge_iteration(low, sizing)
    assert found.verdict == "converged" and "buckling_factor 6.1" in found.reason
    assert judge_iteration(replace(low, buckling_factor=5.99), sizing).verdict == "continue"
    assert judge_iteration(replace(low, buckling_factor=6.2), sizing).verdict == "continue"


def test_the_dead_band_knows_no_such_end():
    assert (
        judge_iteration(iteration(), Sizing(volume_change_max_relative=0.03)).verdict == "continue"
    )


def test_one_quiet_iteration_is_too_few():
    """Table 3 is met, and the rule goes on: its volume may fall further for many iterations."""
    used = iteration(utilization=np.full(3, 0.9), previous_stationary=1)
    assert judge_iteration(used, RULE).verdict == "continue"
    assert judge_iteration(replace(used, previous_stationary=2), RULE).verdict == "converged"
    assert judge_iteration(used, Sizing()).verdict == "converged"


@pytest.mark.parametrize(("most", "analyses"), [(1, 1), (8, 8)])
def test_so_many_iterations_are_so_many_analyses(most, analyses):
    sizing = Sizing(iterations_max=most)
    verdicts = [judge_iteration(iteration(iteration=k), sizing).verdict for k in range(most)]
    assert verdicts.count("continue") == analyses - 1 and verdicts[-1] == "not_converged"


def met(value: bool = True, **open_names) -> Criteria:
    return Criteria(displacement_vertical_m=make_criterion(value), **open_names)


def test_the_lightest_state_within_limits_is_delivered():
    """Iteration 1 breaks a limit, 2 has no answer, 3 is the lightest that is sound though it is not
    used to the lower limit; a person changed panels before iteration 4 of the second loop."""
    unused = met(utilization_min=make_criterion(False))
    loop = [
        make_analysis(iteration=0, volume_m3=9.0, criteria=met()),
        make_analysis(iteration=1, volume_m3=5.0, criteria=met(False)),
        make_analysis(iteration=2, volume_m3=4.0, criteria=Criteria(), state="unstable"),
        make_analysis(iteration=3, volume_m3=6.0, criteria=unused),
        make_analysis(iteration=4, volume_m3=7.0, criteria=met(), verdict="not_converged"),
    ]
    assert choose_delivered(loop) == 3
    final = describe_delivered(loop, loop[3])
    assert (final.verdict, final.delivered_iteration, final.volume_m3) == ("not_converged", 3, 6.0)
    assert final.last.iteration == 4 and "iteration 3" in final.reason
    assert choose_delivered([*loop[:4], replace(loop[4], counted_from=4)]) == 4
    assert choose_delivered([*loop[:4], replace(loop[4], verdict="converged")]) == 4
    assert choose_delivered([replace(loop[1], iteration=0, verdict="unstable")]) == 0


def test_loop_in_memory_delivers_the_best_with_all_its_fields(tmp_path):
    """Four iterations are too few: each is lighter than the one before, so the last is handed on;
    with a displacement limit between the second and the third the second is."""
    mesh = write_small_mesh(tmp_path / "mesh.npz", "zigzag")
    free = {"least_thickness": 0.02, "iterations_max": 4, "utilization_min": 0.9}
    case = given("size", **free)
    first = run_loop(open_case(mesh, case), SPAN, case.sizing)
    down = [one.displacement_vertical_max_m for one in first.analyses]
    assert first.final.delivered_iteration == 3 and down == sorted(down)
    held = given("size", **free, displacement_limit_span_over=SPAN / (down[1] * 1.001))
    found = run_loop(open_case(mesh, held), SPAN, held.sizing)
    assert found.final.verdict == "not_converged" and found.final.delivered_iteration == 1
    assert found.final.volume_m3 == found.analyses[1].volume_m3
    assert {"displacement", "translations"} <= set(list_arrays(found.arrays))
