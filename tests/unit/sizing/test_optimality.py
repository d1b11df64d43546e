"""The rule `optimality`: its gradients and its separable problem."""

from dataclasses import replace

import numpy as np
import pytest

from foldshell.checks.measures import MEASURES, StressState
from foldshell.checks.strips import find_strips
from foldshell.checks.utilization import compute_utilization
from foldshell.loads.cases import combination_matrix, make_load_cases
from foldshell.records.analysis import Criteria
from foldshell.settings.analysis import Analysis
from foldshell.settings.loads import Combinations, Loads
from foldshell.settings.material import Material
from foldshell.settings.sizing import Sizing
from foldshell.shell.analysis import analyse_shell, build_model, place_on_model
from foldshell.shell.mesh_files import mesh_folded_sheet, mesh_from_arrays
from foldshell.sizing import linearise
from foldshell.sizing.adjoint import open_adjoint
from foldshell.sizing.constraints import Constraints
from foldshell.sizing.optimality import MARGIN, minimise_volume, optimality
from foldshell.sizing.rules import start_state
from foldshell.sizing.step import propose_thickness
from record_cases import make_analysis, make_criterion
from sizing_case import PANELS, corrugated_sheet

LIMITS = Sizing()


def test_one_constraint_gives_the_optimality_criterion():
    """min sum A t, sum c / t = 1: t_p = sqrt(c_p / A_p) sum_q sqrt(c_q A_q), by Lagrange."""
    c, area, t = np.array([0.01, 0.04, 0.02]), np.array([1.0, 2.0, 5.0]), np.full(3, 0.1)
    exact = np.sqrt(c / area) * np.sqrt(c * area).sum() / MARGIN
    constraints = Constraints(np.array([(c / t).sum()]), -(c / t**2)[None], area)
    found = minimise_volume(t, np.full(3, 1e-3), np.full(3, 10.0), constraints)
    assert found == pytest.approx(exact, rel=1e-4)  # L-BFGS-B stops at 1e-7 of the constraint


def test_rising_constraint_counts_against_a_panel():
    """A panel whose growth raises g stays at its lower bound; the other one carries."""
    t = np.full(2, 0.1)
    constraints = Constraints(np.array([1.0]), np.array([[2.0, -10.0]]), np.ones(2))
    found = minimise_volume(t, t * 0.7, t * 1.3, constraints)
    # at the bound: 1 + 2 (.07 - .1) + 10 .01 (1/x - 10) = margin
    exact = 1 / (10 + (MARGIN - 1 + 0.06) / 0.1)
    assert found[0] == pytest.approx(0.07) and found[1] == pytest.approx(exact, rel=1e-4)


def test_bounds_and_move_limits_hold_where_no_answer_exists():
    t = np.array([0.1, 0.2])
    hopeless = Constraints(np.array([5.0]), np.array([[-1.0, -1.0]]), np.ones(2))
    state = replace(start_state(t, 0.3), utilization=np.ones(2), constraints=hopeless, step_max=0.3)
    assert optimality(state, LIMITS).thickness == pytest.approx(1.3 * t)
    free = replace(state, constraints=Constraints(np.empty(0), np.empty((0, 2)), np.ones(2)))
    assert optimality(free, LIMITS).thickness == pytest.approx(0.7 * t)
    held = replace(free, may_thin=False)
    assert optimality(held, LIMITS).thickness == pytest.approx(t)


def test_move_limit_shrinks_where_a_panel_turns_back():
    empty = Constraints(np.empty(0), np.empty((0, 2)), np.ones(2))
    state = replace(
        start_state(np.full(2, 0.1), 0.2), constraints=empty, step_max=0.3,
        direction=np.array([1, -1]),
    )  # fmt: skip
    assert optimality(state, LIMITS).step == pytest.approx([0.12, 0.22])


def test_analysis_without_constraints_is_refused():
    state = start_state(np.full(2, 0.1), 0.3)
    with pytest.raises(ValueError, match="made for another rule"):
        optimality(state, LIMITS)


def test_displacement_is_left_to_the_constraints():
    """Where only the displacement is open dead_band grows all panels; this rule may thin some."""
    step = Sizing(rule="optimality")
    criteria = Criteria(displacement_vertical_m=make_criterion(False))
    analysis = make_analysis(buckling_factor={"S1": 9.0}, criteria=criteria)
    constraints = Constraints(np.array([1.2]), np.array([[-9.0, 0.0]]), np.ones(2))
    new = propose_thickness(
        analysis, np.full(2, 0.1), np.full(2, 0.5), None, step, constraints
    ).thickness
    assert new[0] > 0.1 and new[1] == pytest.approx(0.07)
    unstable = propose_thickness(
        make_analysis(state="unstable", reason="buckled"), np.full(2, 0.1), None, None, step
    )
    assert unstable.memory.step == pytest.approx([0.15, 0.15])


def build_case(second_order):
    """Return the corrugated sheet with an uneven thickness, and its analysis as a function."""
    material, plan = Material(), Combinations()
    cases = make_load_cases(Loads(), material.unit_weight)
    arrays = mesh_folded_sheet(corrugated_sheet(), "zigzag", 2)
    model = build_model(
        mesh_from_arrays(arrays), arrays["supported_nodes"], material.poissons_ratio
    )
    options = Analysis(second_order=second_order)

    def analyse(thickness):
        return analyse_shell(model, thickness[model.mesh.panel], material, cases, plan.all, options)

    thickness = 0.04 * (1 + 0.5 * np.random.default_rng(7).random(PANELS))
    return model, material, plan, thickness, analyse


def load_slope(model, material, plan):
    placed = place_on_model(model, make_load_cases(Loads(), material.unit_weight))
    return placed.weight @ combination_matrix(plan.all)


def compare_slopes(case, measure, size=1e-4):
    """Return values, change along a random direction, and central differences of all three."""
    model, material, plan, thickness, analyse = case
    rule = Sizing(measure=measure)
    strength, strips = len(plan.strength), find_strips(model.operators, 0.3)

    def respond(t):
        result = analyse(t)
        found = model, result.displacement[:, :strength], t[model.mesh.panel], material
        stress = StressState(*found, compute_utilization(*found), strips)
        panels = MEASURES[measure].panels(stress)
        down = -result.displacement[: 3 * len(model.mesh.nodes)][2::3, strength:]
        factors = np.empty(0) if result.buckling is None else result.buckling.factors
        return result, stress, panels, down.max() * 240 / 6.0, 1 / factors

    result, stress, *_ = respond(thickness)
    found = linearise.linearise_constraints(
        result, stress, load_slope(model, material, plan), rule, 6.0, 1.0
    )
    way = size * thickness * np.random.default_rng(3).standard_normal(PANELS)
    one, two = respond(thickness + way)[2:], respond(thickness - way)[2:]
    exact = [(a - b) / 2 for a, b in zip(one, two, strict=True)]
    return found.value, found.gradient @ way, exact


@pytest.fixture
def everything_counts(monkeypatch):
    monkeypatch.setattr(linearise, "ACTIVE", 0.0)
    monkeypatch.setattr(linearise, "FACTOR_ACTIVE", np.inf)


@pytest.mark.parametrize("measure", ["panel_mean", "element_max", "strip"])
def test_first_order_gradients_are_those_of_differences(everything_counts, measure):
    """Against central differences along a random direction: 1e-3 of the largest change is left
    to points at which the governing combination or surface changes within the step."""
    value, change, exact = compare_slopes(build_case(False), measure)
    assert change[:PANELS] == pytest.approx(exact[0], abs=1e-3 * np.abs(exact[0]).max())
    worst = PANELS + np.argmax(value[PANELS:])
    assert change[worst] == pytest.approx(exact[1], rel=1e-4)


def test_second_order_gradients_are_near_those_of_differences(everything_counts):
    """The tangent leaves out the second-order part of the stiffness: 3 %. The buckling factor is
    that of first-order forces, but found to 1e-5 of itself: 1 % of a difference of 1e-3."""
    value, change, exact = compare_slopes(build_case(True), "panel_mean", 1e-3)
    assert change[:PANELS] == pytest.approx(exact[0], abs=0.03 * np.abs(exact[0]).max())
    worst = PANELS + np.argmax(value[PANELS : -len(exact[2])])
    assert change[worst] == pytest.approx(exact[1], rel=0.03)
    assert change[-len(exact[2]) :] == pytest.approx(exact[2], rel=0.02)


def test_adjoint_solves_the_same_system():
    """K^-1 of the loads is the first-order displacement."""
    model, material, plan, thickness, analyse = build_case(False)
    result = analyse(thickness)
    slope = load_slope(model, material, plan)
    adjoint = open_adjoint(model, result, thickness[model.mesh.panel], material, slope)
    assert adjoint.solve(result.loads) == pytest.approx(result.first_order, rel=1e-9, abs=1e-12)
