"""What analyses share and take up again gives the same as doing it alone and anew."""

import numpy as np
import pytest

from foldshell.loads.cases import make_load_cases
from foldshell.settings.loads import Loads
from foldshell.settings.material import Material
from foldshell.shell.analysis import ShellAnalysis
from foldshell.shell.assembly import assemble_stiffness
from foldshell.shell.buckling import BucklingSearch, find_buckling_factors
from foldshell.shell.effort import COLD, FULL, START, TRACKED, WARM
from foldshell.shell.geometric import GeometricProducts
from foldshell.shell.linear_solver import factorise
from foldshell.shell.mesh_files import mesh_folded_sheet
from foldshell.shell.second_order import SecondOrderSearch, solve_second_order
from foldshell.shell.solution import Riders
from foldshell.sizing.case import make_case
from sizing_case import corrugated_sheet, given

CONCRETE = Material()
FACTORS = {"S1": {"SW": 1.4, "SDL": 1.4}, "S2": {"SW": 1.2, "SDL": 1.2, "LL": 1.6, "WX": 0.5}}


@pytest.fixture(scope="module")
def model():
    return make_case(mesh_folded_sheet(corrugated_sheet(), "strip", 2), given("analyse")).model


def analyse(model, thickness=0.04):
    cases = make_load_cases(Loads(), CONCRETE.unit_weight)
    return ShellAnalysis(model, model.to_elements(np.full(model.sized_panels, thickness)),
                         CONCRETE, cases, FACTORS)  # fmt: skip


def test_projected_products_are_vectors_times_products(model):
    """Of three cases and seven vectors, the last two of them new."""
    rng = np.random.default_rng(4)
    functions = model.mesh.order * (model.mesh.order + 1) // 2
    force = rng.standard_normal((len(model.mesh.elements), 3, functions, 3))
    products = GeometricProducts(model.operators, force, model.pattern.dofs)
    vectors = rng.standard_normal((7, model.pattern.size))
    applied = products(vectors.T)
    expected = np.stack([vectors @ one[:, 5:] for one in applied])
    found = products.project(vectors, slice(5, 7))
    assert found == pytest.approx(expected, rel=1e-10, abs=1e-10 * np.abs(expected).max())


@pytest.mark.parametrize("columns", range(1, 10))
def test_columns_that_fill_up_a_block_change_no_solution(model, columns):
    values = assemble_stiffness(
        model.operators, model.pattern, np.full(len(model.mesh.elements), 0.05), 31e6
    )
    factor = factorise(model.pattern, values)
    right = np.random.default_rng(5).standard_normal((model.pattern.size, columns))
    alone = np.hstack([factor.solve(one[:, None]) for one in right.T])
    found = factor.solve(right)
    assert found.shape == right.shape
    assert found == pytest.approx(alone, rel=1e-9, abs=1e-9 * np.abs(alone).max())


def test_riders_come_along_once():
    """K = 2: each has its own answer, and later calls are not changed."""
    calls, forces = [], np.array([[4.0, 6.0]])

    def solve(right):
        calls.append(right.shape[1])
        return right / 2

    riders = Riders(forces)
    along = riders.along(solve)
    assert along(np.array([[1.0]])).tolist() == [[0.5]]
    assert riders.answer.tolist() == [[2.0, 3.0]]
    assert along(np.array([[8.0, 2.0]])).tolist() == [[4.0, 1.0]]
    assert calls == [3, 2]


def search(mu, start=None):
    """Return a search for K = 1 and K_g = -mu."""

    class Diagonal:
        def mix(self, vectors, factors):
            return -mu[:, None] * vectors * factors

        def project(self, vectors, chosen):
            return -(vectors @ (mu[:, None] * vectors[chosen].T))[None]

    return BucklingSearch(lambda b: b, Diagonal(), np.ones((1, 1)), len(mu))


def test_a_search_that_goes_on_finds_a_mode_that_its_warm_modes_do_not_see():
    """The warm mode is exactly the second one; full effort adds random vectors to its space."""
    mu = np.array([0.6, 0.55, *np.linspace(0, 0.4, 60)])
    start = np.zeros((len(mu), 1))
    start[1] = 1.0
    going = search(mu)
    assert going.run(WARM, start).factors == pytest.approx([1 / 0.55])
    assert going.run(FULL, start).factors == pytest.approx([1 / 0.6], rel=1e-6)


def test_a_search_that_goes_on_solves_for_less_than_one_anew():
    mu = np.concatenate([[0.6, 0.58], np.linspace(0, 0.5, 300)])
    going, anew = search(mu), search(mu)
    rough = going.run(START)
    full, alone = going.run(FULL, rough.modes), anew.run(FULL, rough.modes)
    assert full.solves - rough.solves < alone.solves
    assert full.factors == pytest.approx(alone.factors, rel=1e-6)


@pytest.mark.parametrize(("level", "least", "error"), [(0.02, 2, 1e-3), (2.0, 3, 1e-4)])
def test_two_inverse_iterations_are_enough_while_factors_are_ample(level, least, error):
    """The start is a little off, across 99 modes: at a factor of 50 one step measures the change
    and takes it, at one of 0.5 the search goes on until the mode is known to 1 %."""
    mu = level * np.concatenate([[1.0], np.linspace(0.1, 0.95, 99)])
    start = np.full((len(mu), 1), 0.02)
    start[0] = 1.0
    found = find_buckling_factors(
        lambda b: b, lambda v: -(mu[:, None] * v)[None], np.ones((1, 1)), len(mu), start, TRACKED
    )
    assert found.converged
    assert found.solves == 2 if least == 2 else found.solves >= least
    assert found.factors[0] * level == pytest.approx(1, abs=error)
    assert found.factors[0] * level >= 1


def test_a_second_run_of_second_order_ends_where_a_single_one_does():
    """Three columns that need different numbers of iterations; rates that are known end sooner."""
    slopes = np.array([[0.05, 0.3, 0.7]])

    def correction(displacement, columns):
        return 0.9 * slopes[:, columns] * displacement + 0.02 * displacement**2

    first = np.ones((2, 3))
    alone = solve_second_order(first, correction, 1e-8)
    going = SecondOrderSearch(first, correction, correction(first, np.arange(3)))
    rough = going.run(1e-3, rates=slopes[0])
    assert rough.iterations < alone.iterations
    full = going.run(1e-8)
    assert np.array_equal(full.displacement, alone.displacement)
    assert full.iterations == alone.iterations
    assert np.array_equal(full.residual, alone.residual)


def test_an_analysis_that_goes_on_has_the_state_of_a_full_one(model):
    """Rough first, then full, against full at once: factors and displacements to 1e-6."""
    going = analyse(model)
    modes = going.run(COLD).buckling.modes
    found, alone = going.run(FULL, modes), analyse(model).run(FULL)
    assert found.buckling.factors == pytest.approx(alone.buckling.factors, rel=1e-6)
    scale = np.abs(alone.displacement).max()
    assert found.displacement == pytest.approx(alone.displacement, abs=1e-9 * scale)
    assert found.second_order.iterations == alone.second_order.iterations


def test_ample_factors_are_not_measured_where_one_is_low():
    """Only the least factor of all tells: beside one of 3, that of 50 is found as by WARM; beside
    one of 10 it is left after two steps."""
    spread = np.concatenate([[1.0], np.linspace(0.1, 0.95, 99)])
    start = np.full((len(spread), 2), 0.02)
    start[0] = 1.0

    def run(effort, *factors):
        mu = spread / np.array(factors)[:, None]
        return find_buckling_factors(
            lambda b: b, lambda v: -mu[:, :, None] * v, np.eye(2), len(spread), start, effort
        )

    low, known = run(TRACKED, 3.0, 50.0), run(WARM, 3.0, 50.0)
    assert np.array_equal(low.factors, known.factors) and low.solves == known.solves
    assert run(TRACKED, 10.0, 50.0).solves < run(WARM, 10.0, 50.0).solves
