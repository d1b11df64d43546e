"""Buckling factors and second order on the small corrugated roof."""

import numpy as np
import pytest

from crosscheck import buckling
from crosscheck.analysis import analyse_model
from crosscheck.buckling import compute_buckling_factors
from crosscheck.comparison import compare
from crosscheck.model import read_model
from crosscheck.second_order import (
    NotSettled,
    apply_geometric,
    apply_own_geometric,
    assemble_geometric,
    compute_geometric_matrices,
    solve_second_order,
)
from crosscheck.stability import list_stability_values
from crosscheck.system import build_system, solve_facets, solve_loads
from crosscheck.values import Code, build_independent
from crosscheck_models import describe_model, describe_small_fold, write_model


@pytest.fixture(scope="module")
def analysis(tmp_path_factory):
    """The roof at 12 mm, with steep loads, so that second order shows."""
    data = describe_small_fold(0.012)
    for factors in data["combinations"].values():
        for case in factors:
            factors[case] *= 3.0
    path = tmp_path_factory.mktemp("model") / "model.json"
    return analyse_model(read_model(write_model(path, data)), 2)


def spread(matrices, f):
    """f Kg (F, 3, m^2, 9, 9) of u, v and w as the matrices of membrane and plate."""
    part = f * matrices
    membrane = np.zeros((*part.shape[:3], 9, 2, 9, 2))
    plate = np.zeros((*part.shape[:3], 9, 3, 9, 3))
    membrane[..., 0, :, 0] = membrane[..., 1, :, 1] = plate[..., 0, :, 0] = part
    shape = part.shape[:3]
    return membrane.reshape(*shape, 18, 18), plate.reshape(*shape, 27, 27)


@pytest.mark.parametrize("seed", [4, 7])
def test_the_factor_makes_the_stiffness_singular(analysis, seed):
    """K + f Kg factors just below the factor found and not just above it, to twice the tolerance.

    At a tolerance of 1e-3 the factors of these starts are 1e-4 to 2.3e-4 too high.
    """
    system = analysis.system
    found = compute_buckling_factors(system, analysis.response, seed)
    assert found.settled.all() and found.steps < buckling.STEPS
    matrices = compute_geometric_matrices(system, analysis.response.local[..., :1])[0]
    build_system(system.grid, system.section, spread(matrices, (1 - 2e-5) * found.factor[0]))
    with pytest.raises(ValueError, match="positive"):
        build_system(system.grid, system.section, spread(matrices, (1 + 2e-5) * found.factor[0]))


@pytest.mark.parametrize("seed", range(3))
def test_two_facets_have_the_factor_of_a_dense_solution(tmp_path, seed):
    """Few unknowns: the basis fills their space within the steps, and nothing spurious comes in."""
    vertices = [[0, 0, 0], [1, 0, 0.3], [1, 1, 0], [0, 1, 0.3]]
    data = describe_model(vertices, [[0, 1, 2], [0, 2, 3]], [[0, 1], [2, 3]], 0.01)
    analysis = analyse_model(read_model(write_model(tmp_path / "model.json", data)), 1)
    system, shape = analysis.system, analysis.system.grid.mesh.facet_nodes.shape
    matrices = compute_geometric_matrices(system, analysis.response.local)
    operators = assemble_geometric(system.grid, matrices)
    size = 3 * shape[0] * shape[1]
    unit = np.zeros((*shape, 5, size))
    unit[:, :, :3] = np.eye(size).reshape(*shape, 3, size)
    moved = solve_facets(system, unit).local
    found = compute_buckling_factors(system, analysis.response, seed)
    for case, factor in enumerate(found.factor):
        force = -apply_geometric(operators[case : case + 1], moved)[:, :, :3].reshape(size, size)
        assert factor == pytest.approx(1 / np.linalg.eigvals(force).real.max(), rel=1e-5)


def test_what_is_left_of_rounding_is_not_followed():
    """Two vectors of which one depends on the other: one direction stays."""
    scale = buckling._orthonormalise(np.array([[[4.0, 2.0], [2.0, 1.0]]]), np.array([5.0]))[0]
    gram = scale @ [[4.0, 2.0], [2.0, 1.0]] @ scale.T
    np.testing.assert_allclose(gram, np.diag([0.0, 1.0]), atol=1e-12)


def test_a_factor_that_does_not_settle_is_said_and_fails(analysis, monkeypatch):
    """When the steps run out there is no number, and the comparison names what is missing."""
    values = list_stability_values(analysis, False)
    primary = Code([4, 8], {c: {k: [e[k]] * 2 for k in e} for c, e in values.items()}, {}, 2.0)
    assert compare(primary, build_independent([1, 2], [values, values]), {}).passed
    monkeypatch.setattr(buckling, "STEPS", 4)
    found = compute_buckling_factors(analysis.system, analysis.response)
    assert not found.settled.any() and found.steps == 4
    early = list_stability_values(analysis, False)
    assert {entry["buckling_factor"] for entry in early.values()} == {None}
    result = compare(primary, build_independent([1, 2], [values, early]), {})
    assert not result.passed and not result.quantities
    assert result.not_settled == ["S2 buckling_factor", "D2 buckling_factor"]


def test_second_order_solves_its_equation(analysis):
    """(K + Kg(N(u))) u = F: one more solve with the forces of u changes nothing."""
    state = solve_second_order(analysis.system, analysis.forces, analysis.response)
    local = np.einsum("fij,frjc->fric", analysis.system.grid.axes, analysis.forces)
    matrices = compute_geometric_matrices(analysis.system, state.response.local)
    operators = assemble_geometric(analysis.system.grid, matrices)
    push = apply_geometric(operators, state.response.local)
    own = apply_own_geometric(analysis.system, state.response.local)
    assert np.abs(own - push).max() < 1e-10 * np.abs(push).max()
    push = push[:, :, :3]
    turned = np.einsum("fij,fric->frjc", analysis.system.grid.axes, local - push)
    again = solve_loads(analysis.system, turned).displacement
    assert np.abs(again - state.response.displacement).max() < 1e-5 * np.abs(again).max()
    first = np.abs(analysis.response.displacement).max()
    assert abs(np.abs(again).max() / first - 1) > 0.01


def test_geometric_forces_balance(analysis):
    """Kg does not see a translation: its forces sum to nothing."""
    matrices = compute_geometric_matrices(analysis.system, analysis.response.local)
    operators = assemble_geometric(analysis.system.grid, matrices)
    force = apply_geometric(operators, analysis.response.local)
    total = np.einsum("fij,fric->jc", analysis.system.grid.axes, force[:, :, :3])
    assert np.abs(total).max() < 1e-10 * np.abs(force).sum()


def test_values_are_listed_and_reactions_balance_in_second_order(analysis):
    values = list_stability_values(analysis, True)
    assert set(values) == {"S2", "D2", "S2 Th.II", "D2 Th.II"}
    assert min(values[name]["buckling_factor"] for name in ("S2", "D2")) > 1
    for name in ("S2 Th.II", "D2 Th.II"):
        unbalance = np.add(values[name]["reaction_sum_kn"], values[name]["load_sum_kn"])
        assert np.linalg.norm(unbalance) < 1e-6 * np.linalg.norm(values[name]["load_sum_kn"])
    assert set(list_stability_values(analysis, False)) == {"S2", "D2"}


def test_beyond_buckling_there_is_no_second_order_state(analysis):
    """At 1.2 times the buckling load the iteration finds nothing, and values are left out."""
    factor = compute_buckling_factors(analysis.system, analysis.response).factor[0]
    forces = 1.2 * factor * analysis.forces[..., :1]
    first = solve_loads(analysis.system, forces)
    beyond = compute_buckling_factors(analysis.system, first).factor[0]
    assert beyond == pytest.approx(1 / 1.2, rel=2e-5)
    with pytest.raises(NotSettled):
        solve_second_order(analysis.system, forces, first)
