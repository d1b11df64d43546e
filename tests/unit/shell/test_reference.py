"""Polynomials on the reference triangle against exact integrals and differences."""

import subprocess
import sys
from math import factorial
from pathlib import Path

import numpy as np
import pytest

from foldshell.shell.reference import (
    edge_basis,
    edge_quadrature,
    gauss_jacobi,
    jacobi,
    lagrange_basis,
    lattice_points,
    orthonormal_basis,
    reference_triangle,
    triangle_quadrature,
)

ORDERS = [1, 2, 3, 4, 5]


@pytest.mark.parametrize("degree", [1, 2, 5, 8, 12])
def test_quadrature_integrates_every_monomial_of_its_degree(degree):
    """int r^i s^j over the unit triangle = i! j! / (i + j + 2)!; round-off only."""
    points, weights = triangle_quadrature(degree)
    for i in range(degree + 1):
        for j in range(degree + 1 - i):
            exact = 2 * factorial(i) * factorial(j) / factorial(i + j + 2)
            found = weights @ (points[:, 0] ** i * points[:, 1] ** j)
            assert found == pytest.approx(exact, rel=1e-12)


def test_quadrature_does_not_integrate_a_higher_degree():
    points, weights = triangle_quadrature(1)
    exact = 2 * factorial(8) / factorial(10)
    assert weights @ points[:, 0] ** 8 != pytest.approx(exact, rel=1e-3)


@pytest.mark.parametrize("degree", [0, 1, 3, 5])
def test_dubiner_basis_is_orthonormal_and_complete(degree):
    points, weights = triangle_quadrature(2 * degree)
    psi = orthonormal_basis(degree, points)
    assert psi.shape[1] == (degree + 1) * (degree + 2) // 2
    assert psi.T @ (weights[:, None] * psi) == pytest.approx(np.eye(psi.shape[1]), abs=1e-12)


@pytest.mark.parametrize("order", ORDERS)
def test_lagrange_is_one_at_its_node_and_its_derivatives_match_differences(order):
    assert lagrange_basis(order, lattice_points(order))[0] == pytest.approx(
        np.eye((order + 1) * (order + 2) // 2), abs=1e-10
    )
    at, step = np.array([[0.31, 0.23]]), 1e-4
    _, first, second = lagrange_basis(order, at)
    moved = {
        (i, j): lagrange_basis(order, at + step * np.array([[i, j]]))[0]
        for i in (-1, 0, 1)
        for j in (-1, 0, 1)
    }
    # central differences: error step^2 times a fourth derivative of a few hundred
    assert first[0] == pytest.approx((moved[1, 0] - moved[-1, 0]) / (2 * step), abs=1e-5)
    assert first[1] == pytest.approx((moved[0, 1] - moved[0, -1]) / (2 * step), abs=1e-5)
    mixed = moved[1, 1] - moved[1, -1] - moved[-1, 1] + moved[-1, -1]
    curves = [
        (moved[1, 0] - 2 * moved[0, 0] + moved[-1, 0]) / step**2,
        (moved[0, 1] - 2 * moved[0, 0] + moved[0, -1]) / step**2,
        mixed / (4 * step**2),
    ]
    assert second == pytest.approx(np.array(curves), abs=1e-4)


@pytest.mark.parametrize("order", ORDERS)
def test_tabulated_derivatives_reproduce_polynomials(order):
    """Gradient and Hessian coefficients evaluate to the derivatives they stand for."""
    table = reference_triangle(order)
    points = np.array([[0.2, 0.5], [0.05, 0.9], [1 / 3, 1 / 3]])
    _, first, second = lagrange_basis(order, points)
    psi = orthonormal_basis(order - 1, points)
    assert np.einsum("qm,kmn->kqn", psi, table.gradient) == pytest.approx(first, abs=1e-9)
    assert np.einsum("qm,kmn->kqn", psi, table.hessian) == pytest.approx(second, abs=1e-8)


@pytest.mark.parametrize("order", ORDERS)
def test_divergence_theorem_ties_edge_tables_to_the_interior(order):
    """int psi_m d_r N + int d_r psi_m N = oint psi_m N n_r: checked on psi_0 = 1."""
    table = reference_triangle(order)
    interior = table.gradient[:, 0] / 2  # area 1/2, psi_0 = 1
    xi, weights = edge_quadrature(2 * order)
    outward = np.array([[0.0, -1.0], [1.0, 1.0], [-1.0, 0.0]])  # length times normal
    boundary = np.zeros_like(interior)
    corners = np.array([[0, 0], [1, 0], [0, 1.0]])
    for edge, (a, b) in enumerate([(0, 1), (1, 2), (2, 0)]):
        points = (1 - xi)[:, None] * corners[a] + xi[:, None] * corners[b]
        values = weights @ lagrange_basis(order, points)[0]
        boundary += outward[edge][:, None] * values
    assert interior == pytest.approx(boundary, abs=1e-12)


def test_edge_basis_is_legendre():
    xi, weights = edge_quadrature(8)
    gram = edge_basis(4, xi).T @ (weights[:, None] * edge_basis(4, xi))
    assert gram == pytest.approx(np.diag(1 / (2 * np.arange(4) + 1)), abs=1e-13)


def test_order_out_of_range_is_refused():
    with pytest.raises(ValueError, match="element order 9"):
        reference_triangle(9)


def test_jacobi_polynomials_and_gauss_points_are_those_of_scipy():
    """Independent code; both follow recurrences, so a few roundings are between them."""
    from scipy.special import eval_jacobi, roots_jacobi

    x = np.linspace(-1, 1, 41)
    for alpha in (0, 1, 7, 15):
        for degree in range(9):
            exact = eval_jacobi(degree, alpha, 0, x)
            assert jacobi(degree, alpha, x) == pytest.approx(exact, abs=1e-13 * abs(exact).max())
    for count in (1, 2, 5, 13):
        assert np.array(gauss_jacobi(count)) == pytest.approx(
            np.array(roots_jacobi(count, 1, 0)), abs=1e-14
        )


def test_an_analysis_does_not_import_scipy():
    """It would take longer than a small analysis itself, in several hundred jobs of a study."""
    code = "import sys, analyse; print([name for name in sys.modules if name.startswith('scipy')])"
    scripts = Path(__file__).parents[3] / "scripts"
    found = subprocess.run(
        [sys.executable, "-c", code], cwd=scripts, capture_output=True, text=True, check=True
    )
    assert found.stdout.strip() == "[]"
