"""Normal equations and Levenberg-Marquardt against dense linear algebra and known minima."""

import numpy as np
import pytest

from foldshell.folding.levenberg import minimise_terms
from foldshell.folding.normal_equations import NormalEquations, NotPositiveDefinite


def _random_rows(rng, unknowns):
    columns = [np.array([rng.choice(unknowns, k, replace=False) for _ in range(9)]) for k in (2, 5)]
    rows = [(rng.normal(size=9), rng.normal(size=c.shape)) for c in columns]
    dense = np.zeros((18, unknowns))
    for n, (c, (_, v)) in enumerate(zip(columns, rows, strict=True)):
        np.add.at(dense, (9 * n + np.arange(9)[:, None], c), v)
    return columns, rows, dense, np.concatenate([r for r, _ in rows])


@pytest.mark.parametrize("solver", ["cholmod", "superlu"])
def test_normal_equations_equal_dense_ones(solver):
    if solver == "cholmod":
        pytest.importorskip("cvxopt")
    rng = np.random.default_rng(3)
    columns, rows, dense, residual = _random_rows(rng, 12)
    equations = NormalEquations(columns, 12, solver)
    values, gradient = equations.assemble(rows)
    assert gradient == pytest.approx(dense.T @ residual, abs=1e-14)
    shift = rng.uniform(0.1, 1.0, 12)
    expected = np.linalg.solve(dense.T @ dense + np.diag(shift), gradient)
    assert equations.solve(values, shift, gradient) == pytest.approx(expected, rel=1e-10)
    assert equations.diagonal(values) == pytest.approx(np.diag(dense.T @ dense), abs=1e-14)


def test_singular_matrix_is_reported():
    equations = NormalEquations([np.array([[0, 1]])], 3)
    values, gradient = equations.assemble([(np.ones(1), np.ones((1, 2)))])
    with pytest.raises(NotPositiveDefinite):
        equations.solve(values, np.zeros(3), gradient)


class _Rosenbrock:
    """r = (10 (y - x2), 1 - x): minimum 0 at (1, 1), along a curved valley."""

    columns = np.array([[0, 1], [0, 1]])

    def evaluate(self, vertices):
        x, y, _ = vertices[0]
        return np.array([10 * (y - x * x), 1 - x]), np.array([[-20 * x, 10.0], [-1.0, 0.0]])


def test_rosenbrock_minimum_is_found():
    minimum = minimise_terms(
        [_Rosenbrock()], np.array([[-1.2, 1.0, 0.0]]),
        max_iterations=100, cost_tolerance=1e-12, step_tolerance=1e-12,
    )  # fmt: skip
    assert minimum.converged
    assert minimum.vertices[0] == pytest.approx([1, 1, 0], abs=1e-8)


def test_a_shortened_step_spares_factorisations():
    """Along the curved valley full steps rise at first; both ways end in the same minimum."""
    ended = [
        minimise_terms(
            [_Rosenbrock()], np.array([[-1.2, 1.0, 0.0]]), damping=1e-9, shorten=shorten,
            max_iterations=100, cost_tolerance=1e-12, step_tolerance=1e-12,
        )
        for shorten in (False, True)
    ]  # fmt: skip
    assert ended[1].vertices[0] == pytest.approx([1, 1, 0], abs=1e-8)
    assert ended[1].iterations < ended[0].iterations


class _Point:
    """r = (x - 1.2, y): nearest point (1.2, 0)."""

    columns = np.array([[0], [1]])

    def evaluate(self, vertices):
        return vertices[0, :2] - [1.2, 0.0], np.ones((2, 1))


class _Circle:
    """r = 1e3 (|x| - 1), the constraint as the solver's matrix sees it."""

    columns = np.array([[0, 1]])

    def evaluate(self, vertices):
        radius = np.linalg.norm(vertices[0, :2])
        return np.array([1e3 * (radius - 1)]), 1e3 * vertices[:, :2] / radius


def test_retracted_steps_stay_on_the_constraint():
    """Half a turn of a circle to its point next to (1.2, 0), where weighing alone would creep."""
    seen = []

    def retract(trial):
        seen.append(trial / np.linalg.norm(trial))
        return seen[-1]

    start = np.array([[np.cos(3.0), np.sin(3.0), 0.0]])
    terms, stop = [_Point(), _Circle()], {"cost_tolerance": 1e-14, "step_tolerance": 1e-12}
    minimum = minimise_terms(terms, start, max_iterations=30, damping=1e-6, retract=retract, **stop)
    assert minimum.vertices[0] == pytest.approx([1, 0, 0], abs=1e-6)
    assert any(minimum.vertices is trial for trial in seen)
    creeping = minimise_terms(terms, start, max_iterations=30, damping=1e-6, **stop)
    assert np.linalg.norm(creeping.vertices[0] - [1, 0, 0]) > 0.1


def test_limit_on_iterations_is_not_called_convergence():
    minimum = minimise_terms(
        [_Rosenbrock()], np.array([[-1.2, 1.0, 0.0]]),
        max_iterations=3, cost_tolerance=1e-12, step_tolerance=1e-12,
    )  # fmt: skip
    assert not minimum.converged and minimum.iterations == 3
    assert "limit" in minimum.reason
