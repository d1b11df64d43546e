"""Loads, stresses, criteria and reactions against hand calculations."""

from dataclasses import replace

import numpy as np
import pytest

from foldshell.checks.strength import (
    CRITERIA,
    principal_stresses,
    utilization_drucker_prager,
    utilization_rankine,
    utilization_von_mises,
)
from foldshell.checks.utilization import area_percentile, compute_utilization, panel_utilization
from foldshell.loads.cases import LOAD_CASES, combination_matrix, make_load_cases, surface_loads
from foldshell.settings.analysis import Analysis
from foldshell.settings.loads import Loads
from foldshell.settings.material import Material, age_material
from foldshell.shell.analysis import ShellModel, analyse_shell, build_model
from foldshell.shell.geometric import apply_geometric
from foldshell.shell.mesh import build_mesh
from foldshell.shell.nodal_loads import nodal_forces
from foldshell.shell.results import reaction_imbalance, support_reactions
from foldshell.shell.stiffness import build_operators
from foldshell.shell.stress import (
    cell_points,
    evaluate,
    internal_forces,
    membrane_forces,
    sample_points,
    stress_resultants,
    surface_stresses,
)
from shell_cases import dense_stiffness, folded_strip, skewed_patch

CONCRETE = Material("C25/30", 31e6, 0.2, 25.0, 16_700.0, 1_670.0)


def test_surface_loads_are_those_of_table_2():
    """Tsiamis et al. 2018, Table 2; SDL acts against the normal, half of the wind on all."""
    normal = np.array([[0, 0, 1.0], [0.6, 0, 0.8]])
    found = surface_loads(normal, np.array([0.1, 0.2]), make_load_cases(Loads(), 25.0))
    assert found[:, :, 0].tolist() == [[0, 0, -2.5], [0, 0, -5.0]]
    assert found[1, :, 1] == pytest.approx([-0.3, 0, -0.4])
    assert found[:, 2, 2].tolist() == [-1.0, -1.0]
    assert found[:, 0, 3].tolist() == found[:, 1, 4].tolist() == [0.85, 0.85]
    basis = Loads(area_basis="plan_abs")
    plan = surface_loads(normal, np.array([0.1, 0.2]), make_load_cases(basis, 25.0))
    assert plan[:, 2, 2] == pytest.approx([-1.0, -0.8])
    assert plan[:, 0, 3] == pytest.approx([0.85, 0.68])
    assert plan[:, :, :2].tolist() == found[:, :, :2].tolist()


@pytest.mark.parametrize("order", [2, 3, 5])
def test_nodal_forces_sum_to_load_times_area_and_keep_its_centre(order):
    mesh, _ = skewed_patch(1, order)
    operators = build_operators(mesh, 0.2)
    area = operators.geometry.area
    surface = np.zeros((len(area), 3, 1))
    surface[:, 2, 0] = 3.0
    force = nodal_forces(operators, surface)[: 3 * len(mesh.nodes), 0].reshape(-1, 3)
    assert force.sum(axis=0) == pytest.approx([0, 0, 3 * area.sum()], abs=1e-11)
    centroid = mesh.nodes[mesh.corners].mean(axis=1)
    assert force[:, 2] @ mesh.nodes == pytest.approx(3 * area @ centroid, rel=1e-11)


def test_combinations_superpose_by_name():
    matrix = combination_matrix({"S2": {"SW": 1.2, "LL": 1.6}, "D1": {"SDL": 1.0}})
    assert matrix.tolist() == [[1.2, 0], [0, 1.0], [1.6, 0], [0, 0], [0, 0]]
    assert LOAD_CASES == ("SW", "SDL", "LL", "WX", "WY")


def test_internal_forces_equal_stiffness_times_displacement():
    mesh = folded_strip(3, 2)
    operators = build_operators(mesh, 0.2)
    displacement = np.random.default_rng(0).standard_normal((mesh.dof_count, 2))
    thickness = np.full(len(mesh.elements), 0.15)
    found = internal_forces(operators, stress_resultants(operators, displacement, thickness, 5.0))
    exact = dense_stiffness(operators, 0.15, 5.0) @ displacement
    assert found == pytest.approx(exact, abs=1e-11 * np.abs(exact).max())


def test_membrane_forces_are_those_of_the_full_recovery():
    mesh = folded_strip(3, 2)
    operators = build_operators(mesh, 0.2)
    displacement = np.random.default_rng(0).standard_normal((mesh.dof_count, 2))
    thickness = np.full(len(mesh.elements), 0.15)
    one = membrane_forces(operators, displacement, thickness, 5.0)
    two = stress_resultants(operators, displacement, thickness, 5.0).force
    assert (one == two).all()


def test_stress_through_the_thickness():
    """N = 6, M = 0.5, t = 0.1: N/t = 60 and 6 M/t^2 = 300, top in compression for M > 0."""
    force, moment = np.full((1, 1, 1, 3), 6.0), np.full((1, 1, 1, 3), 0.5)
    found = surface_stresses(force, moment, np.array([0.1]))
    assert found[:, 0, 0, 0, 0] == pytest.approx([-240, 60, 360])


@pytest.mark.parametrize("cells", [1, 2, 4])
def test_cell_points_are_centroids_of_equal_triangles(cells):
    points = cell_points(cells)
    assert len(points) == cells**2
    assert points.mean(axis=0) == pytest.approx([1 / 3, 1 / 3])
    assert len(np.unique(points.round(12), axis=0)) == len(points)


@pytest.mark.parametrize("cells", [1, 2, 3, 4])
def test_sample_points_tile_their_cells(cells):
    """All samples are the centroids of one finer grid, and average to their cell's centroid."""
    points = sample_points(cells)
    assert points.shape == (cells**2, (12 // cells) ** 2, 2)
    assert points.mean(axis=1) == pytest.approx(cell_points(cells), abs=1e-12)
    fine = cell_points(12)
    found = points.reshape(-1, 2)
    assert found[np.lexsort(found.round(9).T)] == pytest.approx(fine[np.lexsort(fine.round(9).T)])


def test_criteria_in_uniaxial_and_shear_states():
    """Von Mises: |s| / f and sqrt(3) t / f. Rankine and Drucker-Prager: 1 at both strengths."""
    state = np.array([[16_700, 0, 0], [-16_700, 0, 0], [1_670, 0, 0], [0, 0, 1_000.0]])
    mises = utilization_von_mises(state, CONCRETE)
    assert mises == pytest.approx([1, 1, 0.1, np.sqrt(3) * 1_000 / 16_700])
    rankine = utilization_rankine(state, CONCRETE)
    assert rankine == pytest.approx([10, 1, 1, 1_000 / 1_670])
    prager = utilization_drucker_prager(state, CONCRETE)
    assert prager[1:3] == pytest.approx([1, 1])
    assert set(CRITERIA) == {"von_mises", "rankine", "drucker_prager"}


def test_criteria_do_not_depend_on_axes():
    angle = 0.7
    c, s = np.cos(angle), np.sin(angle)
    state = np.array([3.0, -5.0, 2.0]) * 1e3
    tensor = np.array([[state[0], state[2]], [state[2], state[1]]])
    turn = np.array([[c, s], [-s, c]])
    turned = turn @ tensor @ turn.T
    other = np.array([turned[0, 0], turned[1, 1], turned[0, 1]])
    for criterion in CRITERIA.values():
        assert criterion(other, CONCRETE) == pytest.approx(criterion(state, CONCRETE))
    high, low = principal_stresses(state)
    assert (high, low) == pytest.approx(tuple(np.linalg.eigvalsh(tensor)[::-1]))


def test_creep_divides_the_modulus_alone():
    """Effective modulus E / (1 + phi): deflections under fixed loads grow by 1 + phi."""
    aged = age_material(CONCRETE, 1.5)
    assert aged.youngs_modulus == pytest.approx(31e6 / 2.5)
    assert replace(aged, youngs_modulus=CONCRETE.youngs_modulus) == CONCRETE
    assert age_material(CONCRETE, 0.0) == CONCRETE


def square_model(subdivisions: int = 4):
    """Return a plate of two panels 1 m x 1 m each, pinned on two opposite edges."""
    points = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0.0]])
    facets = np.array([[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]])
    mesh = build_mesh(points, facets, np.array([0, 0, 1, 1]), subdivisions)
    held = np.flatnonzero(np.isclose(mesh.nodes[:, 0], 0) | np.isclose(mesh.nodes[:, 0], 2))
    return build_model(mesh, held, 0.2)


def test_area_percentile_weighs_by_area():
    model = square_model()
    cell = np.zeros((4, 16))
    cell[0, 0] = 5.0  # one cell of 1/64 of the area: above 98.4 % of it
    assert area_percentile(model, cell, 99) == 5.0
    assert area_percentile(model, cell, 98) == 0.0


def test_panel_measures():
    model = square_model()
    cell = np.zeros((4, 16))
    cell[2] = 1.0
    cell[3, 4] = 8.0
    assert panel_utilization(model, cell, "panel_mean") == pytest.approx([0, 0.5 + 0.25])
    assert panel_utilization(model, cell, "element_max").tolist() == [0, 8]


@pytest.mark.parametrize("second_order", [False, True])
def test_reactions_balance_the_loads(second_order):
    model = square_model()
    thickness = np.full(4, 0.1)
    combinations = {"S2": {"SW": 1.2, "SDL": 1.2, "LL": 1.6, "WX": 0.5}}
    options = Analysis(second_order=second_order)
    result = analyse_shell(
        model,
        thickness,
        CONCRETE,
        make_load_cases(Loads(), CONCRETE.unit_weight),
        combinations,
        options,
    )
    reactions = support_reactions(model, result, thickness, CONCRETE)
    expected = 2.0 * np.array([-0.5 * 0.85, 0, 1.2 * 25 * 0.1 + 1.2 * 0.5 + 1.6])
    assert reactions.sum(axis=0)[:, 0] == pytest.approx(expected, rel=1e-9, abs=1e-9)
    assert reaction_imbalance(model, result, reactions) < 1e-9


def test_utilization_takes_the_governing_combination():
    model = square_model()
    thickness = np.full(4, 0.1)
    combinations = {"S1": {"SW": 1.4}, "S2": {"SW": 2.8}}
    result = analyse_shell(
        model,
        thickness,
        CONCRETE,
        make_load_cases(Loads(), CONCRETE.unit_weight),
        combinations,
        Analysis(second_order=False),
    )
    used = compute_utilization(model, result.displacement, thickness, CONCRETE)
    assert used.combination[1] == pytest.approx(2 * used.combination[0])
    assert (used.governing == 1).all()
    assert (used.point == used.combination[1]).all()
    assert used.cell == pytest.approx(used.point.mean(axis=2))


@pytest.mark.parametrize("criterion", sorted(CRITERIA))
def test_utilization_of_both_outer_surfaces_is_that_of_all_three(criterion):
    """Every criterion is convex and the middle surface is the mean of the outer ones."""
    model = square_model()
    material = replace(CONCRETE, criterion=criterion)
    thickness = np.array([0.05, 0.1, 0.2, 0.4])
    moved = 1e-3 * np.random.default_rng(5).standard_normal((model.mesh.dof_count, 3))
    resultants = stress_resultants(model.operators, moved, thickness, material.youngs_modulus)
    points = sample_points(model.mesh.cells)
    force, moment = (
        evaluate(model.operators, values, points.reshape(-1, 2))
        for values in (resultants.force, resultants.moment)
    )
    three = CRITERIA[criterion](surface_stresses(force, moment, thickness), material)
    expected = np.moveaxis(three.max(axis=0), -1, 0)
    found = compute_utilization(model, moved, thickness, material).combination
    assert found.reshape(expected.shape) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("percent", [50.0, 90.0, 99.0, 100.0])
def test_the_percentile_sorts_only_the_largest_values(percent):
    """Against the sum of areas over all values in order, with elements of unlike size."""
    nodes = np.array([[0, 0, 0], [5, 0, 0], [5, 1, 0], [0, 0.2, 0]])
    mesh = build_mesh(nodes, np.array([[0, 1, 2], [0, 2, 3]]), subdivisions=8)
    operators = build_operators(mesh, 0.2)
    model = ShellModel(mesh, operators, None, np.arange(3))
    point = np.random.default_rng(2).random((len(mesh.elements), 5))
    order = np.argsort(point.ravel())
    share = np.cumsum(np.repeat(operators.geometry.area, 5)[order])
    expected = point.ravel()[order][np.searchsorted(share, percent / 100 * share[-1] * (1 - 1e-12))]
    assert area_percentile(model, point, percent) == expected


def test_reactions_come_from_the_elements_at_supports_alone():
    """The others add nothing: the same by the resultants of all elements."""
    model = square_model(8)
    thickness = np.linspace(0.05, 0.2, len(model.mesh.elements))
    result = analyse_shell(
        model, thickness, CONCRETE, make_load_cases(Loads(), CONCRETE.unit_weight),
        {"S2": {"SW": 1.2, "LL": 1.6, "WX": 0.5}},
    )  # fmt: skip
    whole = stress_resultants(
        model.operators, result.displacement, thickness, CONCRETE.youngs_modulus
    )
    force = internal_forces(model.operators, whole) - result.loads
    force += apply_geometric(model.operators, whole.force, result.displacement)
    expected = force[: 3 * len(model.mesh.nodes)].reshape(-1, 3, 1)[model.supported_nodes]
    assert len(model.beside_supports[0]) < len(model.mesh.elements)
    scale = np.abs(expected).max()
    found = support_reactions(model, result, thickness, CONCRETE)
    assert found == pytest.approx(expected, abs=1e-12 * scale)
