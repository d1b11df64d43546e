"""Analyses inside a loop spend little; what they decide and deliver is that of full ones."""

from dataclasses import replace

import numpy as np
import pytest

from foldshell.shell.buckling import find_buckling_factors
from foldshell.shell.effort import COLD, FULL, START, TRACKED, USUAL, WARM
from foldshell.shell.mesh_files import mesh_folded_sheet
from foldshell.sizing import accuracy, iteration
from foldshell.sizing.case import make_case
from foldshell.sizing.iteration import IterationTask
from foldshell.sizing.loop import run_loop
from foldshell.sizing.rounding import round_thickness
from foldshell.sizing.step import take_step
from sizing_case import PANELS, SPAN, corrugated_sheet, given

LOOPS = (
    ("strip", {"start_thickness": 0.03, "least_thickness": 0.005, "buckling_factor_min": 2.5}),
    ("all", {}),
    ("zigzag", {"start_thickness": 0.06, "least_thickness": 0.01}),
    ("strip", {"start_thickness": 0.03, "least_thickness": 0.005}),
    ("strip", {"rule": "fully_stressed", "iterations_max": 8}),
    ("strip", {"step": 0.2, "start_thickness": 0.1, "measure": "element_max"}),
)


def small_case(support="all", imperfection=0.0, **sizing):
    mesh = mesh_folded_sheet(corrugated_sheet(), support, 2)
    case = make_case(mesh, given("analyse", **sizing))
    return replace(case, options=case.options.changed(imperfection=imperfection))


def settings_of_loop(**sizing):
    return given("size", **sizing).sizing


def run_cold(case, sizing):
    """Return thickness, record and arrays of every analysis, each of them cold and full."""
    thickness = round_thickness(np.full(PANELS, sizing.start_thickness))
    steps, last, arrays, memory = [], None, None, None
    while last is None or last.goes_on:
        if last:
            step = take_step(last, arrays, memory, sizing)
            thickness, memory = step.thickness, step.memory
        forgotten = replace(arrays, buckling_modes=None) if arrays else None
        last, arrays = case.run(IterationTask(len(steps), SPAN, thickness, last, forgotten))
        steps.append((thickness, last, arrays))
    return steps


@pytest.mark.parametrize(("support", "sizing"), LOOPS)
def test_a_loop_takes_the_steps_of_cold_full_analyses_and_delivers_their_state(support, sizing):
    """Thickness to the last bit in every step; utilization and factors of the end to 1e-6."""
    case, settings = small_case(support, **sizing), settings_of_loop(**sizing)
    cold = run_cold(case, settings)
    seen, analyse = [], iteration.AnalysisCase.run_in_loop

    def watch(self, task):
        seen.append(task.thickness)
        return analyse(self, task)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(iteration.AnalysisCase, "run_in_loop", watch)
        found = run_loop(case, SPAN, settings)
    assert [record.verdict for record in found.analyses] == [one[1].verdict for one in cold]
    assert np.array_equal(seen, [one[0] for one in cold])
    _, record, arrays = cold[found.final.delivered_iteration]
    assert found.arrays.utilization_panel_mean == pytest.approx(
        arrays.utilization_panel_mean, rel=1e-6
    )
    assert list(found.final.buckling_factor.values()) == pytest.approx(
        list(record.buckling_factor.values()), rel=1e-6
    )


def test_a_loop_spends_less_than_full_analyses(monkeypatch):
    """Most analyses begin from warm modes alone; the first and the last have random vectors."""
    spent, run = [], iteration.ShellAnalysis.run

    def watch(self, effort, modes=None):
        spent.append(effort)
        return run(self, effort, modes)

    monkeypatch.setattr(iteration.ShellAnalysis, "run", watch)
    found = run_loop(small_case(), SPAN, settings_of_loop())
    assert spent[0] is COLD
    assert spent[-1] is FULL
    assert spent.count(TRACKED) > len(found.analyses) / 2


def analysed(case, thickness=0.1, **changes):
    task = IterationTask(0, SPAN, round_thickness(np.full(PANELS, thickness)))
    record, arrays = case.run_in_loop(task)
    return replace(record, **changes), arrays


@pytest.mark.parametrize(
    ("change", "thickness", "edited", "effort"),
    [
        ({}, 0.095, False, TRACKED),
        ({}, 0.095, True, START),
        ({}, 0.05, False, START),
        ({}, 0.13, False, START),
        ({"state": "unstable"}, 0.095, False, START),
        ({"buckling_factor_bound": 2.1}, 0.095, False, START),
        ({"buckling_factor_bound": 2.4}, 0.095, False, TRACKED),
        ({"buckling_factor_bound": None}, 0.095, False, START),
    ],
)
def test_random_vectors_come_in_where_a_mode_could_hide(change, thickness, edited, effort):
    """The bound of 2.1 falls below 2 by the cube of 0.95, that of 2.4 does not."""
    case = small_case()
    record, arrays = analysed(case, **change)
    new = np.full(PANELS, thickness)
    assert accuracy.choose_effort(case.sizing, new, record, arrays, edited) is effort
    assert accuracy.choose_effort(case.sizing, new, None, None, edited) is COLD


def test_rules_that_take_more_than_comparisons_get_all_digits():
    case = small_case(rule="optimality")
    chosen = accuracy.choose_effort(case.sizing, np.ones(PANELS), None, None, False)
    assert chosen is USUAL
    assert chosen.second_order_tolerance == 0


def test_a_rule_that_takes_digits_of_factors_has_them_followed_closely():
    """`stress_ratio` limits its long steps by the least factor itself."""
    case = small_case(rule="stress_ratio")
    record, arrays = analysed(case)
    chosen = accuracy.choose_effort(case.sizing, np.full(PANELS, 0.095), record, arrays, False)
    assert chosen == replace(WARM, second_order_tolerance=0.0)
    assert accuracy.choose_effort(case.sizing, arrays.thickness, None, None, False).ample == np.inf


def test_limits_of_a_person_move_what_is_far_above_them():
    """A factor of 6 to be kept doubles 2 / 1.5 times: 8 is looked at with care, 16 is ample."""
    case = small_case(buckling_factor_min=6.0)
    record, arrays = analysed(case)
    chosen = accuracy.choose_effort(case.sizing, np.full(PANELS, 0.095), record, arrays, False)
    assert chosen.ample == pytest.approx(16.0)
    assert accuracy.is_doubtful(case.sizing, 7.9)


def test_an_imperfect_shell_is_analysed_in_full_in_every_step(monkeypatch):
    """The lowest mode is part of its shape: every utilization hangs on the digits of that."""
    spent, run = [], iteration.ShellAnalysis.run

    def watch(self, effort, modes=None):
        spent.append(effort)
        return run(self, effort, modes)

    monkeypatch.setattr(iteration.ShellAnalysis, "run", watch)
    settings = settings_of_loop(iterations_max=3)
    run_loop(small_case(imperfection=0.02, iterations_max=3), SPAN, settings)
    assert len(spent) >= 3
    assert set(spent) == {FULL}


def test_the_bound_of_hidden_factors_falls_with_the_cube_until_random_vectors_come_in():
    case = small_case()
    record, arrays = analysed(case)
    assert record.buckling_factor_bound == record.least_factor
    thickness = round_thickness(arrays.thickness * np.linspace(0.9, 1, PANELS))
    task = IterationTask(1, SPAN, thickness, record, arrays)
    after, _ = case.run_in_loop(task)
    assert after.buckling_factor_bound == pytest.approx(record.least_factor * 0.729, rel=1e-9)
    assert after.buckling_factor_bound < after.least_factor


def test_modes_that_see_nothing_of_the_lowest_one_do_not_hide_it_below_a_factor_of_two():
    """K = 1 and K_g = -mu: the warm mode is the second one, exactly orthogonal to the lowest."""
    mu = np.array([0.6, 0.55, *np.linspace(0, 0.4, 60)])
    start = np.zeros((len(mu), 1))
    start[1] = 1.0
    arguments = (lambda b: b, lambda v: -(mu[:, None] * v)[None], np.ones((1, 1)), len(mu), start)
    assert find_buckling_factors(*arguments, WARM).factors == pytest.approx([1 / 0.55])
    assert find_buckling_factors(*arguments, START).factors == pytest.approx([1 / 0.6], rel=1e-3)
    assert accuracy.is_doubtful(given("analyse").sizing, 1 / 0.55)


def test_wrong_modes_of_the_analysis_before_are_found_out():
    """Modes that are orthogonal to the true ones give too high a factor, which the bound exposes:
    the next analysis looks with random vectors and finds the least factor."""
    case = small_case("strip", least_thickness=0.005)
    thickness = np.full(PANELS, 0.02)
    record, arrays = case.run(IterationTask(0, SPAN, thickness))
    noise = np.random.default_rng(1).standard_normal(arrays.buckling_modes.shape)
    blind = replace(arrays, buckling_modes=noise.astype(np.float32))
    task = IterationTask(
        1, SPAN, round_thickness(0.95 * thickness), replace(record, verdict="continue"), blind
    )
    found, _ = case.run_in_loop(task)
    full, _ = case.run(task)
    assert full.least_factor < 2
    assert found.least_factor == pytest.approx(full.least_factor, rel=1e-3)


def test_close_comparisons_are_made_with_full_second_order():
    """A utilization within 3e-4 of a limit is found to the tolerance of the settings."""
    case = small_case("strip", start_thickness=0.03, least_thickness=0.005)
    task = IterationTask(0, SPAN, np.full(PANELS, 0.04))
    rough, arrays = case.run_in_loop(task)
    exact, full = case.run(task)
    assert rough.second_order_iterations < exact.second_order_iterations
    limit = float(full.utilization_panel_mean[0]) * (1 + 1e-4)
    close = replace(case, sizing=case.sizing.changed(utilization_max=limit))
    record, arrays = close.run_in_loop(task)
    assert record.second_order_iterations == exact.second_order_iterations
    assert np.array_equal(arrays.utilization_panel_mean, full.utilization_panel_mean)
