"""Temperature and settlements: closed forms of plates that are free, held, and bent."""

import numpy as np
import pytest

from foldshell.loads.cases import SETTLEMENT, TEMPERATURE, WEIGHT, SurfaceLoad
from foldshell.settings.analysis import Analysis
from foldshell.settings.material import Material
from foldshell.settings.zones import read_zone
from foldshell.shell.analysis import analyse_shell, build_model
from foldshell.shell.mesh import build_mesh, rotation_dofs, translation_dofs
from foldshell.shell.results import support_reactions, translations
from foldshell.shell.stress import stress_resultants

MATERIAL = Material()
FIRST = Analysis().changed(second_order=False)
T, E, NU, ALPHA = 0.1, MATERIAL.youngs_modulus, MATERIAL.poissons_ratio, 1e-5


def skewed_plate(angle=0.0):
    """A parallelogram of 2 x 1 skewed panels of triangles, turned in space about x."""
    flat = np.array([[0, 0, 0], [1.1, 0, 0], [2, 0, 0], [0.3, 1, 0], [1.5, 1, 0], [2.3, 1, 0]])
    c, s = np.cos(angle), np.sin(angle)
    vertices = flat @ np.array([[1, 0, 0], [0, c, s], [0, -s, c]])
    facets = np.array([[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]])
    return build_mesh(vertices, facets, np.array([0, 0, 1, 1]), 2)


def heat(kelvin, direction=(0.0, 0.0, -1.0)):
    return SurfaceLoad("T", TEMPERATURE, kelvin, direction)


def analyse(model, *cases, options=FIRST, names=("T",)):
    thickness = np.full(len(model.mesh.elements), T)
    combinations = {name: {name: 1.0} for name in names}
    return analyse_shell(model, thickness, MATERIAL, cases, combinations, options), thickness


def hold(mesh, *pairs):
    """A model held in single translations (node, axes) and against nothing else."""
    fixed = np.concatenate([translation_dofs(np.array([node]), axes) for node, axes in pairs])
    return build_model(mesh, np.empty(0, int), NU, fixed)


@pytest.mark.parametrize("angle", [0.0, 0.6])
def test_a_plate_that_is_held_as_a_body_expands_without_stress(angle):
    """d(l^2) / 2 = alpha T l^2, no membrane force, no reaction: to rounding."""
    mesh = skewed_plate(angle)
    model = hold(mesh, (0, (0, 1, 2)), (1, (1, 2)), (3, (2,)))
    result, thickness = analyse(model, heat(30.0))
    moved = translations(model, result.displacement)[..., 0]
    # where it is held fixes a body's motion: what counts is how distances change
    apart = mesh.nodes[:, None] - mesh.nodes
    longer = np.einsum("abx,abx->ab", apart, moved[:, None] - moved)
    assert longer == pytest.approx(ALPHA * 30 * (apart**2).sum(axis=2), abs=1e-12)
    found = stress_resultants(model.operators, result.displacement, thickness, E, result.imposed)
    scale = E * T * ALPHA * 30
    assert np.abs(found.force).max() < 1e-9 * scale and np.abs(found.moment).max() < 1e-9 * scale
    reactions = support_reactions(model, result, thickness, MATERIAL)
    assert np.abs(reactions).max() < 1e-9 * scale


def test_a_plate_that_is_held_all_round_is_compressed():
    """N = -E t alpha T / (1 - nu) in both directions."""
    mesh = skewed_plate()
    border = np.flatnonzero((mesh.nodes[:, 1] < 1e-9) | (mesh.nodes[:, 1] > 1 - 1e-9) | _ends(mesh))
    model = build_model(mesh, border, NU)
    result, thickness = analyse(model, heat(20.0))
    found = stress_resultants(model.operators, result.displacement, thickness, E, result.imposed)
    exact = -E * T * ALPHA * 20 / (1 - NU)
    assert found.force[:, :2, 0, 0] == pytest.approx(exact, rel=1e-9)
    assert np.abs(found.force[:, 2]).max() < 1e-9 * abs(exact)
    assert np.abs(translations(model, result.displacement)).max() < 1e-15


def _ends(mesh):
    x, y = mesh.nodes[:, 0], mesh.nodes[:, 1]
    return (np.abs(x - 0.3 * y) < 1e-9) | (np.abs(x - 2 - 0.3 * y) < 1e-9)


def test_a_difference_bends_a_free_plate_to_a_sphere():
    """kappa = -alpha T / t with the upper side warmer: w = -alpha T / (2 t) r^2 + linear, without
    moments. The curvature of w in any direction by differences over the nodes."""
    mesh = skewed_plate()
    model = hold(mesh, (0, (0, 1, 2)), (1, (1, 2)), (3, (2,)))
    result, thickness = analyse(model, heat(10.0, None))
    w = translations(model, result.displacement)[:, 2, 0]
    x, y = mesh.nodes[:, 0], mesh.nodes[:, 1]
    basis = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=1)
    fit, rest = np.linalg.lstsq(basis, w, rcond=None)[:2]
    kappa = -ALPHA * 10 / T
    assert fit[3:] == pytest.approx([kappa / 2, 0, kappa / 2], abs=1e-9)
    assert float(rest.sum()) < 1e-20
    found = stress_resultants(model.operators, result.displacement, thickness, E, result.imposed)
    assert np.abs(found.moment).max() < 1e-9 * E * T**3 / 12 * abs(kappa)


def test_a_difference_in_a_clamped_plate_gives_moments_and_no_deflection():
    """M = -D (1 + nu) kappa_0 = E t^2 alpha T / (12 (1 - nu)), on the lower side tension."""
    mesh = skewed_plate()
    border = np.flatnonzero((mesh.nodes[:, 1] < 1e-9) | (mesh.nodes[:, 1] > 1 - 1e-9) | _ends(mesh))
    held = np.concatenate(
        [translation_dofs(border), rotation_dofs(mesh, np.arange(mesh.edge_count))]
    )
    model = build_model(mesh, np.empty(0, int), NU, held)
    result, thickness = analyse(model, heat(10.0, None))
    found = stress_resultants(model.operators, result.displacement, thickness, E, result.imposed)
    exact = E * T**2 * ALPHA * 10 / (12 * (1 - NU))
    assert found.moment[:, :2, 0, 0] == pytest.approx(exact, rel=1e-6)
    assert np.abs(translations(model, result.displacement)).max() < 1e-9


def test_a_settlement_of_all_supports_moves_the_plate_as_a_body():
    mesh = skewed_plate(0.4)
    corners = np.array([0, 2, 3, 5])
    model = build_model(mesh, corners, NU)
    case = SurfaceLoad("T", SETTLEMENT, 0.01, (0.0, 0.0, -1.0))
    for options in (FIRST, Analysis()):
        result, _ = analyse(model, case, heat(1e-9), options=options)
        moved = translations(model, result.displacement)[..., 0]
        assert moved == pytest.approx(np.tile([0, 0, -0.01], (len(moved), 1)), abs=1e-9)


def test_a_settlement_of_one_side_is_what_the_unit_displacement_asks():
    """Reactions sum to nothing, and the held nodes stand where they were put; in second order
    too."""
    mesh = skewed_plate()
    model = build_model(mesh, np.array([0, 2, 3, 5]), NU)
    zone = read_zone("box 2 -1 3 2")
    case = SurfaceLoad("T", SETTLEMENT, 0.02, (0.0, 0.0, -1.0), zone=zone)
    weight = SurfaceLoad("T", WEIGHT, 25.0, (0.0, 0.0, -1.0))
    for options in (FIRST, Analysis()):
        result, thickness = analyse(model, case, weight, options=options)
        moved = translations(model, result.displacement)[..., 0]
        assert moved[[2, 5], 2].tolist() == [-0.02, -0.02] and not moved[[0, 3]].any()
        reactions = support_reactions(model, result, thickness, MATERIAL).sum(axis=0)[:, 0]
        load = 25.0 * T * model.operators.geometry.area.sum()
        assert reactions == pytest.approx([0, 0, load], abs=1e-6 * load)


def test_a_settlement_without_a_support_is_refused():
    model = build_model(skewed_plate(), np.array([0, 2, 3, 5]), NU)
    zone = read_zone("box 0.9 -0.5 1.2 0.5")
    case = SurfaceLoad("T", SETTLEMENT, 0.02, (0.0, 0.0, -1.0), zone=zone, where="box")
    with pytest.raises(ValueError, match="load case T: zone 'box' meets no support"):
        analyse(model, case)


def test_heating_buckles_a_held_plate():
    """A square plate held in its plane all round and simply supported: N = k pi^2 D / b^2 with
    k = 2 under equal compression (Timoshenko & Gere, Theory of Elastic Stability, 9.2), so
    T_cr = 2 pi^2 D (1 - nu) / (b^2 E t alpha)."""
    n, b, t = 4, 1.0, 0.02
    grid = np.stack(np.meshgrid(np.arange(n + 1), np.arange(n + 1)), axis=-1).reshape(-1, 2) / n * b
    vertices = np.column_stack([grid, np.zeros(len(grid))])
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    halves = (np.stack([a, a + 1, a + n + 2], 1), np.stack([a, a + n + 2, a + n + 1], 1))
    facets = np.concatenate(halves)
    mesh = build_mesh(vertices, facets, None, 1, 4)
    edge = np.abs(mesh.nodes[:, :2] - b / 2).max(axis=1) > b / 2 - 1e-9
    model = build_model(mesh, np.flatnonzero(edge), NU)
    exact = 2 * np.pi**2 * t**2 / (12 * (1 + NU) * b**2 * ALPHA)
    result = analyse_shell(
        model, np.full(len(mesh.elements), t), MATERIAL, [heat(1.0)], {"T": {"T": exact / 3}},
    )  # fmt: skip
    assert result.buckling.factors[0] == pytest.approx(3.0, rel=5e-3)
