"""The plain path and the fast one solve the same equations, on the demo's own final state."""

import json

import numpy as np
import pytest

import compare
from crosscheck.analysis import analyse_model
from crosscheck.buckling import compute_buckling_factors
from crosscheck.errors import CrosscheckError, MechanismError
from crosscheck.model import read_model
from crosscheck.plain import find_plain_factors, find_plain_state
from crosscheck.records import MULTIFRONTAL, SCIPY, Comparison, Limit, list_fields, to_data
from crosscheck.second_order import solve_second_order
from crosscheck.stability import FIRST_ORDER, Method, analyse_mesh
from crosscheck.system import Response
from crosscheck.verdict import leave_out
from crosscheck_models import DATA, describe_primary, describe_small_fold, write_model

DEMO = DATA / "demo_model.json"
"""What rule `neutral_model` wrote of the demo: 9 x 8 lines, all edges held, 20 to 24 mm."""


@pytest.fixture(scope="module")
def both():
    model = read_model(DEMO)
    return [analyse_model(model, 1, solver=solver) for solver in (MULTIFRONTAL, SCIPY)]


def difference(first, second):
    """Largest difference of two arrays, relative to the largest value of the second."""
    return np.abs(first - second).max() / np.abs(second).max()


def test_displacements_and_reactions_are_equal(both):
    """Two factorisations of one matrix: equal to conditioning times rounding, asked for is 1e-8."""
    fast, plain = (analysis.response for analysis in both)
    assert difference(fast.displacement, plain.displacement) < 1e-8
    assert difference(fast.local, plain.local) < 1e-8
    assert difference(fast.reactions, plain.reactions) < 1e-8


@pytest.mark.parametrize("subdivisions", [1, pytest.param(2, marks=pytest.mark.slow)])
def test_buckling_factors_are_equal(subdivisions):
    """Block Lanczos as the study runs it, bound 2e-6, against ARPACK to rounding: 1e-6."""
    fast, plain = (
        analyse_model(read_model(DEMO), subdivisions, solver=solver)
        for solver in (MULTIFRONTAL, SCIPY)
    )
    found = compute_buckling_factors(fast.system, fast.response)
    factors = find_plain_factors(plain.system, plain.response)
    assert found.settled.all()
    np.testing.assert_allclose(found.factor, factors, rtol=1e-6)
    assert factors[0] != pytest.approx(factors[1], rel=0.1)  # not one number for all


@pytest.mark.parametrize("scale", [1.0, 100.0])
def test_second_order_states_are_equal(both, scale):
    """Anderson's mixing and a new factor in each step, both to 1e-10: one state.

    Under a hundred times the loads, a fifth of the buckling load, second order shows.
    """
    fast, plain = both
    first = [_scale(analysis.response, scale) for analysis in both]
    state = solve_second_order(fast.system, scale * fast.forces, first[0], 1e-10).response
    for case in range(2):
        one = [case]
        start = first[1].pick_cases(one)
        own = find_plain_state(plain.system, scale * plain.forces[..., one], start)
        assert difference(state.displacement[..., one], own.displacement) < 1e-8
        assert difference(state.reactions[..., one], own.reactions) < 1e-8
        grown = difference(own.displacement, start.displacement)
        assert grown > (1e-1 if scale > 1 else 1e-4)


def _scale(response, scale):
    return Response(*(scale * values for values in vars(response).values()))


def test_every_value_of_a_mesh_is_alike():
    """What is compared with the other code, as both paths list it, at the study's tolerances."""
    model = read_model(DEMO)
    fast, plain = (
        analyse_mesh(model, 1, Method(shear=True, solver=solver))
        for solver in (MULTIFRONTAL, SCIPY)
    )
    kinds = ("", " Th.II", " with shear")
    assert fast.keys() == plain.keys() == {name + kind for name in ("S2", "D2") for kind in kinds}
    for combination, values in fast.items():
        assert values.keys() == plain[combination].keys()
        near = 1e-3 if "shear" in combination else 1e-5  # an iteration against a new factor
        for name, value in values.items():
            found = _flatten(value), _flatten(plain[combination][name])
            np.testing.assert_allclose(*found, rtol=0, atol=near * np.abs(found[0]).max())


def _flatten(value):
    return np.ravel(list(value.values()) if isinstance(value, dict) else value)


def test_a_shell_that_can_move_is_refused(tmp_path):
    data = describe_small_fold()
    data["supported_edges"] = [[0, 1]]
    for vertex in data["vertices_m"]:
        vertex[2] = 0.0
    model = read_model(write_model(tmp_path / "model.json", data))
    with pytest.raises(MechanismError, match="supports"):
        analyse_model(model, 1, solver=SCIPY)


@pytest.mark.parametrize("solver", [MULTIFRONTAL, SCIPY])
def test_the_comparison_says_which_path_ran(tmp_path, solver):
    model = read_model(write_model(tmp_path / "model.json", describe_small_fold()))
    runs = [analyse_mesh(model, m, FIRST_ORDER) for m in (1, 2)]
    (tmp_path / "primary.json").write_text(json.dumps(describe_primary(runs, [1, 2])))
    files = [tmp_path / name for name in ("model.json", "primary.json", "c.json", "c.xlsx")]
    compare.main(*files, subdivisions=[1, 2], stability=False, solver=solver)
    result = json.loads(files[2].read_text())
    assert result["pass"] and result["solver"] == solver
    assert result["quantities"]["S2 work_knm"]["relative_difference"] < 1e-8
    _check_keys(result, Comparison, extra={"design"})
    _check_keys(result["quantities"]["S2 work_knm"], Limit)


def _check_keys(data, record, extra=frozenset()):
    """The file holds the fields of the record, those with a default where they say something."""
    names = {said.name or name for name, _, said in list_fields(record)}
    assert set(data) - extra <= names
    optional = {"reason", "first", "reinforcement"}
    assert names - optional <= set(data)
    for _, _, said in list_fields(record):
        assert said.meaning


def test_another_solver_is_refused():
    with pytest.raises(CrosscheckError, match=r"'mumps'.*multifrontal and scipy"):
        analyse_model(read_model(DEMO), 1, solver="mumps")


def test_a_record_under_the_names_of_the_file():
    empty = leave_out(None, "a mechanism", SCIPY)
    data = to_data(empty)
    assert data["pass"] is None and data["reason"] == "a mechanism"
    assert "first" not in data and "passed" not in data
