"""Membrane forces and what follows from them against states known exactly."""

import numpy as np
import pytest

from figure_cases import make_state
from foldshell.results.fields import (
    cell_area,
    choose_deflection,
    choose_strength,
    facet_axes,
    membrane_force_cells,
    membrane_force_coefficients,
    principal_forces,
    rotate_forces,
)
from foldshell.shell.stiffness import build_operators
from foldshell.shell.stress import membrane_forces

MODULUS, POISSON = 31e6, 0.2


def test_constant_strain_gives_constant_forces(tmp_path):
    """Flat sheet, eps = (1e-3, -2e-3, gamma 1e-3): N = t E / (1 - nu2) (...), in global axes."""
    state = make_state(
        tmp_path,
        folded=False,
        move=lambda x: np.column_stack([1e-3 * (x[:, 0] + x[:, 1]), -2e-3 * x[:, 1], 0 * x[:, 0]]),
    )
    found = membrane_force_coefficients(state, "D2", MODULUS, POISSON)
    force, axes = membrane_force_cells(*found, state.mesh)
    t = state.final.thickness[state.cell_panel]
    exact = np.array([1e-3 - 0.2 * 2e-3, -2e-3 + 0.2 * 1e-3, 0.4 * 1e-3]) / (1 - 0.2**2) * MODULUS
    assert np.allclose(force, t[:, None] * exact, rtol=1e-9)
    assert np.allclose(axes, np.eye(3), atol=1e-12)


def test_forces_are_those_of_the_analysis(tmp_path):
    """Same coefficients as the function that the analysis uses, on a folded sheet."""
    state = make_state(tmp_path, move=lambda x: 1e-3 * np.sin(x + x[:, [1, 2, 0]]))
    coefficients, _ = membrane_force_coefficients(state, "S2", MODULUS, POISSON)
    thickness = state.final.thickness[state.mesh.panel]
    operators = build_operators(state.mesh, POISSON)
    exact = membrane_forces(operators, state.final.displacement[:, [1]], thickness, MODULUS)
    assert np.allclose(coefficients, exact[..., 0], rtol=1e-9, atol=1e-9 * np.abs(exact).max())


def test_principal_forces_of_a_turned_tension():
    """100 kN/m along 30 degrees and -40 across it, in a tilted facet."""
    turn, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
    axes = (turn * np.sign(np.linalg.det(turn)))[None]
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    force = np.array([[100 * c * c - 40 * s * s, 100 * s * s - 40 * c * c, 140 * s * c]])
    value, direction = principal_forces(force, axes)
    assert np.allclose(value, [[100, -40]])
    along = c * axes[0, 0] + s * axes[0, 1]
    assert abs(direction[0, 0] @ along) == pytest.approx(1, abs=1e-12)
    assert direction[0, 1] @ along == pytest.approx(0, abs=1e-12)


def test_turning_the_axes_keeps_the_tensor():
    """Trace and determinant do not change; a quarter turn swaps xx and yy."""
    normal = np.array([[0.0, 0, 1]])
    frame = facet_axes(normal)
    quarter = np.array([[[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]]])
    turned = rotate_forces(np.array([[[3.0, -1, 2]]]), frame, quarter)
    assert np.allclose(turned, [[[-1, 3, -2]]])


def test_axis_x_of_an_upright_facet_is_taken_from_y():
    """A facet across x has no projection of x: its axis is y, and the axes stay right-handed."""
    axes = facet_axes(np.array([[1.0, 0, 0], [0, 0.6, 0.8]]))
    assert np.allclose(axes[0, 0], [0, 1, 0])
    assert np.allclose(np.linalg.det(axes), 1)
    assert np.allclose(axes[1, 0], [1, 0, 0])


def test_chosen_combinations(tmp_path):
    """D2 moves down ten times as much as D1; S2 (index 1) governs everywhere."""
    state = make_state(tmp_path)
    assert choose_deflection(state) == "D2"
    assert choose_strength(state) == "S2"
    assert cell_area(state).sum() == pytest.approx(4 * 5 * 0.9 * 0.7 * np.sin(np.radians(63)))
