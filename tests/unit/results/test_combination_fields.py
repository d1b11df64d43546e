"""Moments, shear and utilization of combinations on result cells, against beam theory."""

from dataclasses import replace

import numpy as np
import pytest

from figure_cases import make_state
from foldshell.loads.cases import make_load_cases
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.results.combination_fields import basis_gradient, evaluate_combinations
from foldshell.settings.analysis import Analysis
from foldshell.settings.loads import Loads
from foldshell.settings.material import Material
from foldshell.shell.analysis import analyse_shell, build_model
from foldshell.shell.mesh import build_mesh
from foldshell.shell.mesh_files import cell_triangles, result_mesh
from foldshell.shell.reference import orthonormal_basis

SPAN, WIDTH, LOAD, THICKNESS = 6.0, 1.0, 2.0, 0.2
MATERIAL = Material("plain", 30e6, 0.0, 25.0, 20e3, 2e3)


def beam_state(folder, turn):
    """Return the state of a plate on two opposite edges under a uniform load, turned in plan."""
    x, y = np.meshgrid(np.linspace(0, SPAN, 4), [0, WIDTH], indexing="ij")
    flat = np.column_stack([x.ravel(), y.ravel(), 0 * x.ravel()])
    cosine, sine = np.cos(turn), np.sin(turn)
    vertices = flat @ np.array([[cosine, sine, 0], [-sine, cosine, 0], [0, 0, 1]])
    facets = np.array(
        [[2 * k + a for a in part] for k in range(3) for part in ((0, 2, 3), (0, 3, 1))]
    )
    mesh = build_mesh(vertices, facets, np.arange(6) // 2, 4)
    ends = (np.abs(mesh.nodes @ [cosine, sine, 0] - place) < 1e-9 for place in (0, SPAN))
    model = build_model(mesh, np.flatnonzero(np.logical_or(*ends)), 0.0)
    thickness = np.full(len(mesh.elements), THICKNESS)
    loads = make_load_cases(Loads(0.0, LOAD, 0.0, 0.0), MATERIAL.unit_weight)
    done = analyse_shell(
        model, thickness, MATERIAL, loads, {"S1": {"LL": 1.0}}, Analysis(second_order=False)
    )
    cells = result_mesh(mesh, vertices, facets)
    state = replace(
        make_state(folder), mesh=mesh, cells=cells, triangles=cell_triangles(cells),
        final=AnalysisArrays(thickness=np.full(3, THICKNESS), displacement=done.displacement),
        strength=("S1",), deflection=(),
    )  # fmt: skip
    return state, cells.nodes[state.triangles].mean(axis=1) @ [cosine, sine, 0]


@pytest.mark.parametrize("turn", [0.0, 0.4])
def test_beam_under_uniform_load(tmp_path, turn):
    """m = q x (l - x) / 2, sagging positive, v = dm/dx = q (l/2 - x); without lateral strain.

    Exact for polynomials of the element's order, so only rounding is left: 1e-6 of the peak.
    """
    state, x = beam_state(tmp_path, turn)
    found = evaluate_combinations(state, MATERIAL)
    along = found.axes[0, :2] @ [np.cos(turn), np.sin(turn), 0]
    mx, my, mxy = found.moment[0].T
    moment = along[0] ** 2 * mx + along[1] ** 2 * my + 2 * along[0] * along[1] * mxy
    exact = LOAD * x * (SPAN - x) / 2
    assert np.abs(moment - exact).max() < 1e-6 * exact.max()
    shear = found.shear[0] @ along
    assert np.abs(shear - LOAD * (SPAN / 2 - x)).max() < 1e-5 * LOAD * SPAN / 2
    assert np.abs(found.force).max() < 1e-6
    middle = 6 * LOAD * SPAN**2 / 8 / THICKNESS**2 / 20e3
    assert found.utilization.max() == pytest.approx(middle, rel=0.01)  # mean of a cell


def test_gradient_of_the_basis():
    """Against central differences of the basis itself: h^2 leaves 1e-8."""
    points, step = np.array([[0.2, 0.3], [0.5, 0.1], [0.1, 0.7]]), 1e-4
    for axis in (0, 1):
        move = step * np.eye(2)[axis]
        ends = [orthonormal_basis(4, points + sign * move) for sign in (1, -1)]
        difference = (ends[0] - ends[1]) / (2 * step)
        assert np.abs(basis_gradient(4, points)[axis] - difference).max() < 1e-4
