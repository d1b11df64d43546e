"""Buckling factors and second order on the small corrugated roof."""

import numpy as np
import pytest

from crosscheck.analysis import analyse_model
from crosscheck.buckling import compute_buckling_factors
from crosscheck.model import read_model
from crosscheck.second_order import (
    NotSettled,
    apply_geometric,
    compute_geometric_matrices,
    solve_second_order,
)
from crosscheck.stability import list_stability_values
from crosscheck.system import build_system, solve_loads
from crosscheck_models import describe_small_fold, write_model


@pytest.fixture(scope="module")
def analysis(tmp_path_factory):
    """The roof at 12 mm, with steep loads, so that second order shows."""
    data = describe_small_fold(0.012)
    for factors in data["combinations"].values():
        for case in factors:
            factors[case] *= 3.0
    path = tmp_path_factory.mktemp("model") / "model.json"
    return analyse_model(read_model(write_model(path, data)), 2)


def test_the_factor_makes_the_stiffness_singular(analysis):
    """K + f Kg factors just below the factor found and not just above it."""
    factors = compute_buckling_factors(analysis.system, analysis.response)
    matrices = compute_geometric_matrices(analysis.system, analysis.response.local[..., :1])
    system = analysis.system

    def spread(f):
        part = f * matrices[:, :, :, 0]
        membrane = np.zeros((*part.shape[:3], 9, 2, 9, 2))
        plate = np.zeros((*part.shape[:3], 9, 3, 9, 3))
        membrane[..., 0, :, 0] = membrane[..., 1, :, 1] = plate[..., 0, :, 0] = part
        shape = part.shape[:3]
        return membrane.reshape(*shape, 18, 18), plate.reshape(*shape, 27, 27)

    build_system(system.grid, system.section, spread(0.99 * factors[0]))
    with pytest.raises(ValueError, match="positive"):
        build_system(system.grid, system.section, spread(1.01 * factors[0]))


def test_second_order_solves_its_equation(analysis):
    """(K + Kg(N(u))) u = F: one more solve with the forces of u changes nothing."""
    state = solve_second_order(analysis.system, analysis.forces, analysis.response)
    local = np.einsum("fij,frjc->fric", analysis.system.grid.axes, analysis.forces)
    matrices = compute_geometric_matrices(analysis.system, state.response.local)
    push = apply_geometric(analysis.system, matrices, state.response.local)[:, :, :3]
    turned = np.einsum("fij,fric->frjc", analysis.system.grid.axes, local - push)
    again = solve_loads(analysis.system, turned).displacement
    assert np.abs(again - state.response.displacement).max() < 1e-5 * np.abs(again).max()
    first = np.abs(analysis.response.displacement).max()
    assert abs(np.abs(again).max() / first - 1) > 0.01


def test_geometric_forces_balance(analysis):
    """Kg does not see a translation: its forces sum to nothing."""
    matrices = compute_geometric_matrices(analysis.system, analysis.response.local)
    force = apply_geometric(analysis.system, matrices, analysis.response.local)
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
    factor = compute_buckling_factors(analysis.system, analysis.response)[0]
    forces = 1.2 * factor * analysis.forces[..., :1]
    first = solve_loads(analysis.system, forces)
    assert compute_buckling_factors(analysis.system, first)[0] == pytest.approx(1 / 1.2, rel=2e-3)
    with pytest.raises(NotSettled):
        solve_second_order(analysis.system, forces, first)
