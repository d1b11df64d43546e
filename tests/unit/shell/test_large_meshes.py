"""Large meshes: their order, and that they come out the same on one thread and on two."""

import numpy as np
import pytest

from foldshell.checks import utilization
from foldshell.files import threads
from foldshell.loads.cases import make_load_cases
from foldshell.settings.loads import Combinations, Loads
from foldshell.settings.material import Material
from foldshell.shell import analysis, assembly, linear_solver, subspace
from foldshell.shell.analysis import ShellAnalysis, analyse_shell, build_model
from foldshell.shell.dissection import rank_by_dissection
from foldshell.shell.effort import COLD, FULL, USUAL
from foldshell.shell.mesh import build_mesh


def folded_mesh(rows: int, columns: int, turned: float = 0.0):
    """Return a mesh of a corrugated sheet, its panels, and the nodes of its two ends."""
    i, j = (index.ravel() for index in np.indices((rows + 1, columns + 1)))
    points = np.column_stack([2.0 * j, 2.0 * i + 0.6 * (j % 2), 0.8 * (j % 2) + 0.02 * j * i])
    turn = np.array([[np.cos(turned), -np.sin(turned), 0], [np.sin(turned), np.cos(turned), 0],
                     [0, 0, 1]])  # fmt: skip
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    quads = np.column_stack([first, first + 1, first + columns + 2, first + columns + 1])
    facets = np.stack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]], axis=1).reshape(-1, 3)
    mesh = build_mesh(points @ turn.T, facets, np.repeat(np.arange(len(quads)), 2), subdivisions=2)
    return mesh, np.flatnonzero((i == 0) | (i == rows))


@pytest.fixture
def counts_as_large(monkeypatch):
    """Let every mesh be worked on as large ones are, with short parts."""
    for module in (threads, assembly, linear_solver, analysis):
        monkeypatch.setattr(module, "LARGE", 100)
    whole = threads.divide_rows
    for module in (assembly, subspace, utilization):
        monkeypatch.setattr(module, "divide_rows", lambda count, size, _=0: whole(count, size, 37))
    yield
    threads.use_threads(1)


def state_of(mesh, held):
    """Return what an analysis of the mesh is told: 0.1 m of concrete with the default loads."""
    material = Material()
    cases = make_load_cases(Loads(), material.unit_weight)
    thickness = np.full(len(mesh.elements), 0.1)
    factors = {**Combinations().strength, **Combinations().deflection}
    return build_model(mesh, held, 0.2), thickness, material, cases, factors


def analyse(mesh, held):
    return analyse_shell(*state_of(mesh, held), effort=USUAL)


def test_the_same_bytes_on_one_thread_and_on_two(counts_as_large):
    mesh, held = folded_mesh(6, 8)
    threads.use_threads(1)
    alone = analyse(mesh, held)
    threads.use_threads(2)
    both = analyse(mesh, held)
    assert threads.count_threads() == 2
    assert alone.displacement.tobytes() == both.displacement.tobytes()
    assert alone.buckling.factors.tobytes() == both.buckling.factors.tobytes()
    assert alone.buckling.modes.tobytes() == both.buckling.modes.tobytes()


def test_a_large_mesh_has_the_answer_of_a_small_one(counts_as_large, monkeypatch):
    """Another order of elimination and other blocks: the same to rounding, 1e-9 of the largest."""
    mesh, held = folded_mesh(6, 8)
    divided = analyse(mesh, held)
    monkeypatch.undo()
    whole = analyse(mesh, held)
    gap = np.abs(divided.displacement - whole.displacement).max()
    assert gap < 1e-9 * np.abs(whole.displacement).max()
    assert np.allclose(divided.buckling.factors, whole.buckling.factors, rtol=1e-6)


def test_utilization_in_blocks_of_elements_is_that_of_all_at_once(counts_as_large, monkeypatch):
    """Each value comes of its own element's forces: the same to rounding."""
    mesh, held = folded_mesh(6, 8)
    model, thickness, material, *_ = state_of(mesh, held)
    moved = np.random.default_rng(5).normal(size=(mesh.dof_count, 3))
    asked = model, moved, thickness, material
    blocks = utilization.compute_utilization(*asked)
    monkeypatch.undo()
    whole = utilization.compute_utilization(*asked)
    assert np.allclose(blocks.combination, whole.combination, rtol=1e-12, atol=0)
    assert np.array_equal(blocks.governing, whole.governing)


def test_a_search_that_was_let_go_ends_where_a_cold_one_does(counts_as_large):
    """From a state known roughly, whose vectors are gone, to the factors and displacements of a
    full analysis from nothing: 1e-6 and 1e-8, the tolerances of a delivered state."""
    state = state_of(*folded_mesh(6, 8))
    in_steps = ShellAnalysis(*state)
    rough = in_steps.run(COLD)
    assert in_steps._search is None
    full = in_steps.run(FULL, rough.buckling.modes)
    cold = ShellAnalysis(*state).run(FULL)
    assert np.allclose(full.buckling.factors, cold.buckling.factors, rtol=1e-6)
    gap = np.abs(full.displacement - cold.displacement).max()
    assert gap < 2e-8 * np.abs(cold.displacement).max()


@pytest.mark.parametrize("turned", [0.0, 0.7])
def test_dissection_is_an_order_with_less_fill_than_minimum_degree(turned, monkeypatch):
    """On a sheet of 16 x 16 panels the factor has fewer nonzeros; a turned one is cut as well."""
    mesh, held = folded_mesh(16, 16, turned)
    nonzeros = {}
    for least in (10**9, 1):
        monkeypatch.setattr(assembly, "LARGE", least)
        model = build_model(mesh, held, 0.2)
        assert np.array_equal(np.sort(model.pattern.dofs), np.flatnonzero(model.pattern.free))
        nonzeros[least] = count_fill(model.pattern.indptr, model.pattern.indices)
    assert nonzeros[1] < nonzeros[10**9]


def count_fill(indptr, indices):
    """Return the nonzeros of the factor of a lower triangle, column by column (Davis 2006)."""
    size = len(indptr) - 1
    below: list[set[int]] = [set() for _ in range(size)]
    total = 0
    for column in range(size):
        own = below[column] | set(indices[indptr[column] + 1 : indptr[column + 1]].tolist())
        total += 1 + len(own)
        if own:
            parent = min(own)
            own.discard(parent)
            below[parent] |= own
        below[column] = set()
    return total


def test_what_lies_on_a_cut_comes_after_what_it_parts():
    """A strip of eight units that share a group with the next one: the middle is last."""
    groups = np.column_stack([np.arange(8), np.arange(8, 16), np.arange(9, 17)])
    points = np.column_stack([np.arange(8.0), np.zeros(8), np.zeros(8)])
    size = np.ones(17, dtype=np.int64)
    rank = rank_by_dissection(groups, size, np.arange(8), points, np.arange(17))
    assert sorted(rank) == list(range(17))
    assert rank[12] == 16


def test_parts_are_those_of_the_work_alone():
    assert threads.divide(7, 10) == [slice(0, 7)]
    assert threads.divide(7, 10**6) == [slice(0, 3), slice(3, 7)]
    assert threads.divide(3, 10**6, least=2) == [slice(0, 3)]
    rows = threads.divide_rows(200_000, 200_000)
    assert rows[0] == slice(0, 65536) and rows[-1].stop == 200_000
    threads.use_threads(9)
    assert threads.count_threads() == threads.MOST
    assert list(threads.run_parts(lambda part: part**2, [1, 2, 3])) == [1, 4, 9]
    threads.use_threads(1)
