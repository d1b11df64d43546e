"""The solve, and values that must not depend on numbering or orientation."""

import numpy as np
import pytest
from scipy.sparse.linalg import splu

from crosscheck.analysis import analyse_model, list_values
from crosscheck.errors import CrosscheckError
from crosscheck.facet import condense_facets
from crosscheck.frontal import NotPositiveDefinite, factor_sum
from crosscheck.mesh import build_mesh
from crosscheck.model import read_model
from crosscheck.ordering import Spans, plan_elimination
from crosscheck.supports import hold_supports
from crosscheck.system import (
    compute_element_matrices,
    join_fields,
    turn_stiffness,
)
from crosscheck_models import assemble_skeleton, describe_small_fold, write_model


@pytest.fixture
def model(tmp_path):
    return read_model(write_model(tmp_path / "model.json", describe_small_fold()))


def test_fronts_and_superlu_solve_alike(model):
    """Same sum of matrices, two factorisations: equal to the conditioning (1e-8 of the answer)."""
    system = analyse_model(model, 2).system
    fields = [
        condense_facets(part, system.grid.mesh.reference)[0]
        for part in compute_element_matrices(system.grid, system.section)
    ]
    outline = turn_stiffness(join_fields(*fields), system.grid.turn)
    matrix = assemble_skeleton(outline, system.grid.equations, system.grid.size)
    load = np.random.default_rng(1).normal(size=(system.grid.size, 3))
    lower = splu(
        matrix,
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    first, second = system.factor.solve(load), lower.solve(load)
    assert np.abs(first - second).max() < 1e-7 * np.abs(second).max()
    alone = system.factor.solve(load[:, 0])
    assert np.abs(alone - first[:, 0]).max() < 1e-9 * np.abs(first).max()


def test_an_indefinite_sum_is_refused():
    matrices = np.array([np.diag([1.0, 1.0]), np.diag([1.0, -2.0])])
    place = np.array([[0, 1], [0, 1]])
    plan = plan_elimination(place, place, np.zeros((2, 3)))
    with pytest.raises(NotPositiveDefinite):
        factor_sum(matrices[plan.facets], plan, place, Spans(np.arange(2), np.ones(2, int)))


def test_a_shell_that_can_move_is_refused(tmp_path):
    data = describe_small_fold()
    data["supported_edges"] = [[0, 1]]
    for vertex in data["vertices_m"]:
        vertex[2] = 0.0
    model = read_model(write_model(tmp_path / "model.json", data))
    with pytest.raises(CrosscheckError, match="supports"):
        analyse_model(model, 1)


def test_mesh_nodes_are_shared_and_cover_the_facets(model):
    mesh = build_mesh(model.vertices, model.facets, 3)
    distance = np.linalg.norm(mesh.nodes[:, None] - mesh.nodes, axis=-1)
    assert distance[np.triu_indices(len(distance), 1)].min() > 1e-3  # no node twice
    grid = analyse_model(model, 3).system.grid
    a, b, c = (model.vertices[model.facets[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    np.testing.assert_allclose(grid.quadrature.area.reshape(len(area), -1).sum(1), area)


def test_every_node_on_a_supported_edge_is_held(model):
    mesh = build_mesh(model.vertices, model.facets, 2)
    held = hold_supports(model.supports, model.vertices)(mesh).held
    assert held[:, 0].sum() == 6 * 7 + 8  # seven nodes inside an edge, four ends a line
    ends = model.vertices[[0, 3, 8, 11], 1]
    assert set(np.round(mesh.nodes[: mesh.skeleton][held[:, 0], 1], 9)) == set(ends)


def test_reactions_balance_the_load(model):
    for values in list_values(analyse_model(model, 2)).values():
        unbalance = np.add(values["reaction_sum_kn"], values["load_sum_kn"])
        assert np.linalg.norm(unbalance) < 1e-8 * np.linalg.norm(values["load_sum_kn"])


def test_values_do_not_depend_on_numbering_or_heading(tmp_path):
    """Renumber vertices and facets, start facets elsewhere, turn about z: gravity sees no change.

    Equal but for rounding times the conditioning, about 1e-8.
    """
    data = describe_small_fold()
    data["combinations"] = {"S2": {"SW": 1.4, "SDL": 1.4}, "D2": {"LL": 1.0}}
    rng = np.random.default_rng(4)
    new = rng.permutation(12)
    angle = 0.9
    turn = np.array(
        [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    )
    vertices = np.empty((12, 3))
    vertices[new] = np.array(data["vertices_m"]) @ turn.T
    order = rng.permutation(12)
    facets = new[np.roll(np.array(data["facets"])[order], 1, axis=1)]
    other = data | {
        "vertices_m": vertices.tolist(),
        "facets": facets.tolist(),
        "facet_panel": np.array(data["facet_panel"])[order].tolist(),
        "supported_edges": new[np.array(data["supported_edges"])].tolist(),
    }
    first, second = (
        list_values(analyse_model(read_model(write_model(tmp_path / "model.json", x)), 2))
        for x in (data, other)
    )
    for combination, values in first.items():
        for name in ("displacement_down_max_m", "work_knm", "utilization_panel_mean_max"):
            assert second[combination][name] == pytest.approx(values[name], rel=1e-7)
