"""Directions, clamps and springs against beams, and a roof on stiff springs against a pinned one.

The strips are 2 m x 0.5 m, 50 mm, E 31 GPa, 2 kN/m2. With Poisson's ratio 0 they are beams: within
0.05 %, the mesh. With 0.2 the tip stands between the beam (12.387 mm) and the plate strip (11.89),
within 1.5 % of the beam, as two independent codes find.
"""

from dataclasses import replace

import numpy as np
import pytest

from foldshell.loads.cases import PRESSURE, SurfaceLoad
from foldshell.settings.analysis import Analysis
from foldshell.settings.material import Material
from foldshell.shell.analysis import analyse_shell, build_model
from foldshell.shell.boundary import (
    Hold,
    find_element_edges,
    join_holds,
    newton_cotes_weights,
    refuse_rigid_motion,
)
from foldshell.shell.mesh import build_mesh
from foldshell.shell.results import reaction_imbalance, support_reactions, translations
from foldshell.sizing.adjoint import open_adjoint
from shell_cases import folded_strip, random_rotation

LENGTH, WIDTH, THICKNESS, PARTS, LIVE = 2.0, 0.5, 0.05, 4, 2.0
STIFF = 31e6 * THICKNESS**3 / 12  # kNm per m of width
FREE = LIVE * LENGTH**4 / (8 * STIFF)
START, END = [[0, PARTS + 1]], [[PARTS, 2 * PARTS + 1]]
SIDES = [[k + start, k + start + 1] for start in (0, PARTS + 1) for k in range(PARTS)]
NONE = np.empty((0, 2), dtype=int)
DOWN, ALONG = (0.0, 0.0, -1.0), (-1.0, 0.0, 0.0)


def hold(pairs=NONE, vertices=(), fix="", clamp=False, spring=(0, 0, 0)):
    fixed = np.array([axis in fix for axis in "xyz"])
    return Hold(np.array(pairs), np.array(vertices, int), fixed, clamp, np.array(spring, float))


def strip_mesh(subdivisions=2, turn=None):
    x, y = np.meshgrid(np.linspace(0, LENGTH, PARTS + 1), [0.0, WIDTH])
    points = np.column_stack([x.ravel(), y.ravel(), 0 * x.ravel()])
    k = np.arange(PARTS)
    one, two = np.array([k, k + 1, k + PARTS + 2]).T, np.array([k, k + PARTS + 2, k + PARTS + 1]).T
    facets = np.stack([one, two], axis=1).reshape(-1, 3)
    return build_mesh(points if turn is None else points @ turn, facets, subdivisions=subdivisions)


def analyse(mesh, holds, poisson=0.0, thickness=THICKNESS, second_order=False, direction=DOWN):
    boundary = join_holds(mesh, holds)
    refuse_rigid_motion(mesh, boundary.fixed, boundary.springs)
    model = build_model(mesh, np.empty(0, int), poisson, boundary.fixed, springs=boundary.springs)
    material = Material().changed(poissons_ratio=poisson)
    case = SurfaceLoad("LL", PRESSURE, LIVE, direction)
    options = Analysis().changed(second_order=second_order)
    field = np.full(len(mesh.elements), thickness)
    result = analyse_shell(model, field, material, [case], {"D": {"LL": 1.0}}, options)
    return model, result, support_reactions(model, result, field, material)


def tip(model, result):
    return -translations(model, result.displacement)[END[0], 2, 0].mean()


@pytest.mark.parametrize("order", range(1, 8))
def test_newton_cotes_weights_integrate_powers(order):
    points = np.linspace(0, 1, order + 1)
    weights = newton_cotes_weights(order)
    found = [weights @ points**k for k in range(order + 1)]
    assert found == pytest.approx(1 / (1 + np.arange(order + 1)), rel=1e-12)
    assert (weights > 0).all()


@pytest.mark.parametrize("stiffness", [0.0, 10.0, 100.0, 1e3])
@pytest.mark.parametrize(("poisson", "within"), [(0.0, 5e-4), (0.2, 1.5e-2)])
def test_cantilever_on_a_line_spring(stiffness, poisson, within):
    """w = (q L^4 / 8 EI) / (1 + k L^3 / 3 EI): 12.387, 11.442, 6.785, 1.338 mm."""
    holds = [hold(START, fix="xyz", clamp=True), hold(END, spring=(0, 0, stiffness))]
    model, result, reactions = analyse(strip_mesh(), holds, poisson)
    exact = FREE / (1 + stiffness * LENGTH**3 / (3 * STIFF))
    assert tip(model, result) == pytest.approx(exact, rel=within)
    assert reaction_imbalance(model, result, reactions) < 1e-9
    if stiffness:
        at_end = model.mesh.nodes[model.supported_nodes, 0] > LENGTH / 2
        carried = stiffness * WIDTH * tip(model, result)
        assert reactions[at_end, 2].sum() == pytest.approx(carried, rel=2e-3)
        assert not reactions[at_end, :2].any()


@pytest.mark.parametrize("subdivisions", [1, 2, 4])
def test_a_stiff_spring_is_a_support(subdivisions):
    """k = 1e8 kN/m per m leaves at most 2e-6 of the free tip, 12.4 mm: in a beam and in a plate
    strip everywhere, between them in the mean of the end (a plate's corner forces act on points,
    so that the corners move by more the finer the mesh is)."""
    holds = [hold(START, fix="xyz", clamp=True), hold(END, spring=(0, 0, 1e8))]
    mesh = strip_mesh(subdivisions)
    for poisson, more in ((0.0, []), (0.2, [hold(SIDES, clamp=True)])):
        model, result, _ = analyse(mesh, [*holds, *more], poisson)
        at_end = np.isclose(mesh.nodes[:, 0], LENGTH)
        down = -translations(model, result.displacement)[at_end, 2, 0]
        assert 0 < down.max() < 2e-6 * FREE
    model, result, _ = analyse(mesh, holds, 0.2)
    assert -translations(model, result.displacement)[at_end, 2, 0].mean() < 2e-6 * FREE


def test_springs_at_points_are_those_of_the_line():
    """Each corner takes half of 100 kN/m per m over 0.5 m."""
    holds = [hold(START, fix="xyz", clamp=True), hold(vertices=END[0], spring=(0, 0, 25.0))]
    model, result, _ = analyse(strip_mesh(), holds)
    assert tip(model, result) == pytest.approx(6.785e-3, rel=1e-3)


@pytest.mark.parametrize("seed", [None, 1])
def test_clamps_at_both_ends_of_a_strip_that_lies_anywhere(seed):
    """q L^4 / 384 EI; turned about z alone, so that the load stays across."""
    turn = None
    if seed is not None:
        c, s = np.cos(seed), np.sin(seed)
        turn = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    ends = [hold(START, fix="xyz", clamp=True), hold(END, fix="xyz", clamp=True)]
    model, result, _ = analyse(strip_mesh(turn=turn), ends)
    down = -translations(model, result.displacement)[:, 2, 0].min()
    assert down == pytest.approx(LIVE * LENGTH**4 / (384 * STIFF), rel=5e-4)


def test_a_roller_takes_no_thrust_and_closes_the_sum():
    """5 q L^4 / 384 EI: 1.290 mm with Poisson's ratio 0. With 0.2 and no rotation about its sides
    it is a plate strip, 5 q L^4 / 384 D = 1.238 mm."""
    holds = [hold(START, fix="xyz"), hold(END, fix="yz")]
    model, result, reactions = analyse(strip_mesh(), holds)
    down = -translations(model, result.displacement)[:, 2, 0].min()
    assert down == pytest.approx(5 * LIVE * LENGTH**4 / (384 * STIFF), rel=5e-4)
    assert reaction_imbalance(model, result, reactions) < 1e-9
    at_end = model.mesh.nodes[model.supported_nodes, 0] > LENGTH / 2
    assert not reactions[at_end, 0].any()
    assert reactions[at_end, 2].sum() == pytest.approx(LIVE * LENGTH * WIDTH / 2, rel=1e-6)
    model, result, _ = analyse(strip_mesh(), [*holds, hold(SIDES, clamp=True)], 0.2)
    down = -translations(model, result.displacement)[:, 2, 0].min()
    assert down == pytest.approx(1.2387e-3, rel=5e-4)


def roof_mesh():
    """Two ridges and three valleys over 8 m x 12 m, 1.2 m high, of 16 facets."""
    x, y = np.meshgrid(np.linspace(0, 8, 5), [0.0, 6.0, 12.0])
    vertices = np.column_stack([x.ravel(), y.ravel(), np.tile([0, 1.2, 0, 1.2, 0], 3)])
    number = np.arange(15).reshape(3, 5)
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
    facets = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], 2).reshape(-1, 3)
    ends = [[k + start, k + start + 1] for start in (0, 10) for k in range(4)]
    return build_mesh(vertices, facets, subdivisions=2), ends


def test_a_roof_on_stiffer_springs_nears_the_pinned_one_as_one_over_k():
    """From 1e6 to 1e10 kN/m per m, a tenth for each ten times but for the square of 1/k, and within
    1e-4 in the end."""
    mesh, pairs = roof_mesh()
    exact = analyse(mesh, [hold(pairs, fix="xyz")])[1].displacement
    size = np.abs(exact).max()
    gaps = []
    for exponent in (6, 7, 8, 9, 10):
        found = analyse(mesh, [hold(pairs, spring=(10.0**exponent,) * 3)])[1].displacement
        gaps.append(np.abs(found - exact)[: 3 * len(mesh.nodes)].max() / size)
    assert gaps[-2] < 1e-4
    assert np.divide(gaps[:-1], gaps[1:]) == pytest.approx(10 / (1 + np.array(gaps[:-1])), rel=0.2)
    assert np.divide(gaps[1:-1], gaps[2:]) == pytest.approx(10, rel=0.03)


def column_factor(spring):
    """Least factor of q = LIVE along a column, clamped at 0, on a spring at its tip: Ritz, powers
    2 to 9 of x / L. EI v'' over v'' + k v(L)^2 against the normal force q (L - x) over v'^2."""
    powers = np.arange(2, 10)
    p, r = np.meshgrid(powers, powers)
    bend = STIFF / LENGTH**3 * p * (p - 1) * r * (r - 1) / (p + r - 3) + spring
    push = LIVE * p * r * (1 / (p + r - 1) - 1 / (p + r))
    return 1 / np.linalg.eigvals(np.linalg.solve(bend, push)).real.max()


def test_columns_by_ritz_are_greenhills():
    """q L = 7.837 EI / L2 without a spring (Greenhill 1881)."""
    assert column_factor(0) * LIVE * LENGTH**3 / STIFF == pytest.approx(7.8373, rel=1e-4)


@pytest.mark.parametrize("share", [0.0, 1.0, 10.0])
def test_buckling_of_a_column_on_a_spring(share):
    """Springs of 0, 3 EI / L3 and 30 EI / L3 at the tip; 0.1 %, the mesh."""
    spring = share * 3 * STIFF / LENGTH**3
    holds = [hold(START, fix="xyz", clamp=True), hold(END, fix="y", spring=(0, 0, spring))]
    _, result, _ = analyse(strip_mesh(4), holds, second_order=True, direction=ALONG)
    assert result.buckling.factors[0] == pytest.approx(column_factor(spring), rel=1e-3)


def test_second_order_balances_with_springs():
    holds = [hold(START, fix="xyz"), hold(END, fix="y", spring=(500.0, 0, 2e3))]
    model, result, reactions = analyse(strip_mesh(4), holds, 0.2, second_order=True)
    assert result.state == "ok"
    assert reaction_imbalance(model, result, reactions) < 1e-6


def test_edges_of_a_clamp_are_those_along_it():
    mesh = strip_mesh(8)
    edges = find_element_edges(mesh, np.array(END))
    ends = np.sort(mesh.corners[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    own = ends[np.isin(mesh.element_edges.ravel(), edges)]
    assert len(edges) == 2
    assert mesh.nodes[own, 0] == pytest.approx(LENGTH)


@pytest.mark.parametrize(
    ("holds", "words"),
    [
        ([hold(START, fix="yz"), hold(END, fix="yz")], "to move along"),
        ([hold(START, fix="xyz")], "to turn about the line"),
        ([hold(START, spring=(1, 1, 1))], "to turn about the line"),
        ([hold(vertices=[0], fix="xyz")], "to turn about the line"),
        ([hold(vertices=[0], fix="xyz"), hold(vertices=[4], fix="xyz")], "to turn about the line"),
    ],
)
def test_a_shell_that_may_move_whole_is_refused(holds, words):
    with pytest.raises(ValueError, match=words):
        analyse(strip_mesh(turn=random_rotation(3)), holds)


def test_a_clamped_edge_holds_alone():
    model, result, _ = analyse(strip_mesh(), [hold(START, fix="xyz", clamp=True)])
    assert tip(model, result) == pytest.approx(FREE, rel=5e-4)


def test_gradients_with_springs_by_taylor():
    """J(t + h d) - J(t) - h dJ d falls as h2: the rest by four where h is halved, within 5 %."""
    mesh = folded_strip(2, 2)
    holds = [hold([[0, 1]], fix="xyz", clamp=True), hold([[2, 4]], fix="y", spring=(300, 0, 900))]
    boundary = join_holds(mesh, holds)
    model = build_model(mesh, np.empty(0, int), 0.2, boundary.fixed, springs=boundary.springs)
    material, names = Material(), {"D": {"LL": 1.0}}
    case = SurfaceLoad("LL", PRESSURE, LIVE, DOWN)
    options = Analysis().changed(second_order=True)
    rng = np.random.default_rng(4)
    start, way = rng.uniform(0.05, 0.09, 4), rng.uniform(-0.02, 0.02, 4)
    node = 5

    def solve(share):
        field = model.to_elements(start + share * way)
        return analyse_shell(model, field, material, [case], names, options), field

    result, field = solve(0.0)
    adjoint = open_adjoint(model, replace(result, displacement=result.first_order), field, material,
                           np.zeros((len(field), 3, 1)))  # fmt: skip
    unit = np.zeros((mesh.dof_count, 1))
    unit[3 * node + 2] = 1.0
    slope = adjoint.implicit(adjoint.solve(unit), np.zeros(1, dtype=int))
    buckling = adjoint.buckling_slope(0)
    moved, factor = [], []
    for share in (0.2, 0.1, 0.05):
        other, _ = solve(share)
        rest = other.first_order[3 * node + 2, 0] - result.first_order[3 * node + 2, 0]
        moved.append(rest - share * (adjoint.sum_panels(slope)[0] @ way))
        rest = other.buckling.factors[0] - result.buckling.factors[0]
        factor.append(rest - share * (adjoint.sum_panels(buckling[:, None])[0] @ way))
    assert np.divide(moved[:-1], moved[1:]) == pytest.approx(4, rel=0.2)
    assert np.divide(factor[:-1], factor[1:]) == pytest.approx(4, rel=0.2)
