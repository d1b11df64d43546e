"""Edge beams: where their panels hang, what they weigh, and that they carry like a beam."""

import numpy as np
import pytest

from foldshell.folding.intersections import find_piercing
from foldshell.loads.cases import make_load_cases
from foldshell.settings.analysis import Analysis
from foldshell.settings.loads import Loads
from foldshell.settings.material import Material
from foldshell.shell.analysis import analyse_shell, build_model
from foldshell.shell.edge_beams import (
    EdgeBeam,
    facet_edges,
    free_edges,
    hang_edge_beam_panels,
    make_edge_beam,
)
from foldshell.shell.mesh import build_mesh
from foldshell.shell.mesh_files import mesh_folded_sheet, mesh_from_arrays
from foldshell.shell.results import (
    panel_area,
    panels_beside_edge_beam,
    support_reactions,
    translations,
)
from sizing_case import PANELS, STRIP, ZIGZAG, corrugated_sheet

MATERIAL = Material("concrete", 31e6, 0.2, 25.0, 16.7e3, 1.67e3)
BEAM = EdgeBeam(0.4, 0.15)


def renumbered(seed: int) -> dict[str, np.ndarray]:
    """Return the corrugated sheet turned about the vertical, with vertices in another order."""
    rng, sheet = np.random.default_rng(seed), corrugated_sheet()
    number = rng.permutation(ZIGZAG * STRIP)
    angle = rng.uniform(0, 2 * np.pi)
    c, s = np.cos(angle), np.sin(angle)
    turned = sheet["vertices"] @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + rng.uniform(
        -9, 9, 3
    )
    starts = rng.integers(0, 3, len(sheet["facets"]))
    facets = [np.roll(number[f], k) for f, k in zip(sheet["facets"], starts, strict=True)]
    order = np.argsort(number)
    return {
        "vertices": turned[order],
        "facets": np.array(facets),
        "zigzag": sheet["zigzag"][order],
        "strip": sheet["strip"][order],
    }


def corners_of(arrays, facets):
    return arrays["vertices"][facets]


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("support", "count"), [("zigzag", 2 * 3), ("strip", 2 * 4), ("all", 0)])
def test_edge_beam_panels_hang_from_every_free_border_edge(seed, support, count):
    """Area of a panel: depth times the horizontal length of its edge, whatever the edge's slope."""
    sheet = renumbered(seed)
    arrays = mesh_folded_sheet(sheet, support, 2, edge_beam=BEAM)
    hung = arrays["facets"][len(sheet["facets"]) :]
    assert len(hung) == 2 * count and len(arrays["fixed_thickness"]) == count
    assert (arrays["fixed_thickness"] == BEAM.thickness).all()
    assert np.array_equal(arrays["vertices"][: len(sheet["vertices"])], sheet["vertices"])
    assert np.array_equal(arrays["facet_panel"], np.arange(2 * (PANELS + count)) // 2)
    corner = corners_of(arrays, hung)
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]) / 2
    assert normal[:, 2] == pytest.approx(0, abs=1e-12)
    free = "strip" if support == "zigzag" else "zigzag"
    border = np.isin(sheet[free], (0, sheet[free].max()))
    edges = [
        edge
        for edge in facet_edges(sheet["facets"])
        if border[edge].all() and len(set(sheet[free][edge])) == 1
    ]
    flat = [np.linalg.norm(np.diff(sheet["vertices"][edge, :2], axis=0)) for edge in edges]
    expected = BEAM.depth * sum(flat) if count else 0.0
    assert np.linalg.norm(normal, axis=1).sum() == pytest.approx(expected)


@pytest.mark.parametrize("seed", range(3))
def test_edge_beam_panels_are_cut_along_their_shorter_diagonal(seed):
    """Both facets share two corners, closer than the other two where the edge slopes."""
    sheet = renumbered(seed)
    arrays = mesh_folded_sheet(sheet, "strip", 2, edge_beam=BEAM)
    for first, second in arrays["facets"][len(sheet["facets"]) :].reshape(-1, 2, 3):
        cut, others = np.intersect1d(first, second), np.setxor1d(first, second)
        own, other = (np.ptp(arrays["vertices"][ends], axis=0) for ends in (cut, others))
        assert np.linalg.norm(own) < np.linalg.norm(other)


@pytest.mark.parametrize("seed", range(3))
def test_edge_beam_panels_continue_the_sheet_with_shared_vertices(seed):
    """Every edge has two facets at most, which run along it in opposite directions."""
    arrays = mesh_folded_sheet(renumbered(seed), "strip", 2, edge_beam=BEAM)
    count = ZIGZAG * STRIP
    lower, upper = arrays["vertices"][count:], arrays["vertices"][:count]
    assert len(lower) == 2 * STRIP
    drop = np.abs(lower[:, None] + [0, 0, BEAM.depth] - upper).max(axis=2)
    assert (np.sort(drop, axis=1)[:, 0] < 1e-12).all()
    directed = arrays["facets"][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    assert len(np.unique(directed, axis=0)) == len(directed)
    assert (np.unique(np.sort(directed, axis=1), axis=0, return_counts=True)[1] <= 2).all()


def test_edge_beam_panels_lie_outside_of_what_the_sheet_says_is_its_upper_side():
    """The sheet's positive side continues on the panel's outer side: its normal points away."""
    arrays = mesh_folded_sheet(corrugated_sheet(), "zigzag", 2, edge_beam=BEAM)
    corner = corners_of(arrays, arrays["facets"][2 * PANELS :])
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    middle = corrugated_sheet()["vertices"].mean(axis=0)
    assert (((corner.mean(axis=1) - middle) * normal)[:, 0] > 0).all()


def test_a_negative_depth_stands_the_edge_beam_up():
    """Same area and orientation along the border, above it."""
    sheet = corrugated_sheet()
    down, up = (
        mesh_folded_sheet(sheet, "zigzag", 2, edge_beam=EdgeBeam(depth, 0.15))
        for depth in (0.4, -0.4)
    )
    count = len(sheet["vertices"])
    both = down["vertices"][count:] + up["vertices"][count:]
    assert both / 2 == pytest.approx(sheet["vertices"][np.isin(sheet["strip"], (0, 4))])
    directed = up["facets"][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    assert len(np.unique(directed, axis=0)) == len(directed)
    area = [arrays["nodes"][arrays["elements"][:, [0, 3, 9]]] for arrays in (down, up)]
    area = [np.cross(c[:, 1] - c[:, 0], c[:, 2] - c[:, 0]) for c in area]
    assert np.linalg.norm(area[0], axis=1).sum() == pytest.approx(
        np.linalg.norm(area[1], axis=1).sum()
    )


def test_edge_beam_panels_that_pierce_the_sheet_are_found():
    """The edge x = 0 of a roof that falls away under it: hanging panels cut the lower leaf, those
    that stand up do not."""
    points = np.array(
        [[0, 0, 0], [0, 2, 0], [1, -1, -0.2], [1, 3, -0.2], [-1, -1, -0.6], [-1, 3, -0.6]]
    )
    facets = np.array([[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3]])
    edges = free_edges(facets, np.array([[4, 5], [0, 2], [2, 4], [1, 3], [3, 5]]))
    assert edges.tolist() == [[1, 0]]
    place = find_piercing(*hang_edge_beam_panels(points, facets, edges, 0.8), len(facets))
    assert place is not None and place[0] == pytest.approx(0)
    assert find_piercing(*hang_edge_beam_panels(points, facets, edges, -0.8), len(facets)) is None


def test_supports_stay_those_of_the_plain_design():
    plain = mesh_folded_sheet(corrugated_sheet(), "strip", 2)
    with_beam = mesh_folded_sheet(corrugated_sheet(), "strip", 2, edge_beam=BEAM)
    assert np.array_equal(plain["support_pairs"], with_beam["support_pairs"])
    places = [
        np.unique(arrays["nodes"][arrays["supported_nodes"]].round(9), axis=0)
        for arrays in (plain, with_beam)
    ]
    assert np.array_equal(*places)
    assert "fixed_thickness" not in plain


def test_an_edge_beam_needs_both_sizes():
    for sizes in ((0.0, 0.0), (0.4, 0.0), (0.0, 0.15)):
        assert make_edge_beam(*sizes) is None
    assert make_edge_beam(0.4, 0.15) == BEAM


def test_edge_beam_panels_carry_their_own_weight_only_and_reactions_balance():
    """Own weight grows by unit weight x depth x horizontal length x thickness; SDL, LL and W are
    those of the plain sheet."""
    combinations = {"SW": {"SW": 1.0}, "rest": {"SDL": 1.0, "LL": 1.0, "WX": 1.0, "WY": 1.0}}
    total = {}
    for beam in (None, BEAM):
        arrays = mesh_folded_sheet(corrugated_sheet(), "strip", 2, edge_beam=beam)
        fixed = arrays.get("fixed_thickness")
        mesh = mesh_from_arrays(arrays)
        model = build_model(mesh, arrays["supported_nodes"], 0.2, fixed_thickness=fixed)
        assert model.sized_panels == PANELS
        thickness = model.to_elements(np.full(PANELS, 0.08))
        first = Analysis(second_order=False)
        result = analyse_shell(
            model,
            thickness,
            MATERIAL,
            make_load_cases(Loads(), MATERIAL.unit_weight),
            combinations,
            first,
        )
        load = translations(model, result.loads).sum(axis=0)
        reaction = support_reactions(model, result, thickness, MATERIAL).sum(axis=0)
        assert reaction == pytest.approx(-load, abs=1e-6 * np.abs(load).max())
        total[beam] = load
    edges = [corrugated_sheet()["vertices"][k * STRIP : (k + 1) * STRIP, :2] for k in (0, 3)]
    length = sum(np.linalg.norm(np.diff(edge, axis=0), axis=1).sum() for edge in edges)
    weight = 25.0 * length * BEAM.depth * BEAM.thickness
    assert total[None][2, 0] - total[BEAM][2, 0] == pytest.approx(weight)
    assert total[BEAM][:, 1] == pytest.approx(total[None][:, 1])


@pytest.mark.parametrize("seed", range(3))
def test_each_edge_beam_panel_knows_the_panel_it_hangs_from(seed):
    """They share both vertices of the border edge."""
    sheet = renumbered(seed)
    arrays = mesh_folded_sheet(sheet, "strip", 8, edge_beam=BEAM)
    model = build_model(
        mesh_from_arrays(arrays), arrays["supported_nodes"], 0.2,
        fixed_thickness=arrays["fixed_thickness"],
    )  # fmt: skip
    found = panels_beside_edge_beam(model)
    for beside, panel in enumerate(found):
        hung = arrays["facets"][arrays["facet_panel"] == PANELS + beside]
        beside = arrays["facets"][arrays["facet_panel"] == panel]
        assert len(set(hung.ravel()) & set(beside.ravel())) == 2
    assert len(np.unique(found)) == 2 * (STRIP - 1)


@pytest.mark.parametrize("seed", [None, 4])
def test_channel_cantilever_bends_like_a_beam(seed):
    """A plate 0.5 x 10 m, 100 mm, with edge beams 0.4 m x 60 mm along both sides, clamped at one
    end: tip deflection q L^4 / 8 E I + q L^2 / 2 G A_web of the U-section under its own weight.

    Measured 0.2 % more (shear lag of the flange, which the theory leaves out); 1 % is allowed. The
    plate alone would sink 20 times as much.
    """
    length, width, t, modulus, gamma = 10.0, 0.5, 0.1, 31e6, 25.0
    beam = EdgeBeam(0.4, 0.06)
    x, y = np.meshgrid(np.linspace(0, length, 11), [0, width], indexing="ij")
    vertices = np.column_stack([x.ravel(), y.ravel(), 0 * x.ravel()])
    a = 2 * np.arange(10)
    facets = np.stack([a, a + 2, a + 3, a, a + 3, a + 1], axis=1).reshape(-1, 3)
    ends = np.array([[0, 1], [20, 21]])
    number = np.arange(22) if seed is None else np.random.default_rng(seed).permutation(22)
    edges = free_edges(number[facets], number[ends])
    assert len(edges) == 20
    points, every = hang_edge_beam_panels(
        vertices[np.argsort(number)], number[facets], edges, beam.depth
    )
    mesh = build_mesh(points, every, np.arange(len(every)) // 2, 4)
    clamped = np.flatnonzero(mesh.nodes[:, 0] < 1e-9)
    model = build_model(mesh, clamped, 0.0, fixed_thickness=np.full(20, beam.thickness))
    material = Material("", modulus, 0.0, gamma, 1.0, 1.0)
    result = analyse_shell(
        model, model.to_elements(np.full(10, t)), material,
        make_load_cases(Loads(), material.unit_weight), {"SW": {"SW": 1.0}},
        Analysis(second_order=False),
    )  # fmt: skip
    flange, webs = width * t, 2 * beam.depth * beam.thickness
    centre = -webs * beam.depth / 2 / (flange + webs)
    inertia = width * t**3 / 12 + flange * centre**2
    inertia += webs * (beam.depth**2 / 12 + (beam.depth / 2 + centre) ** 2)
    load = gamma * (flange + webs)
    expected = load * length**4 / (8 * modulus * inertia)
    expected += load * length**2 / (2 * (modulus / 2) * webs)
    tip = np.abs(mesh.nodes[:, 0] - length) < 1e-9
    down = -translations(model, result.displacement)[tip, 2, 0]
    assert down.mean() == pytest.approx(expected, rel=0.01)
    assert panel_area(model)[model.sized_panels :].sum() == pytest.approx(2 * length * beam.depth)


def test_a_vertical_border_edge_has_no_room_for_an_edge_beam():
    """The panel of an upright edge has no area: the mesh says which facet."""
    points = np.array([[0, 0, 0], [0, 0, 1], [1, 0, 0.5]])
    edges = free_edges(np.array([[0, 1, 2]]), np.array([[1, 2], [0, 2]]))
    found = hang_edge_beam_panels(points, np.array([[0, 1, 2]]), edges, 0.5)
    with pytest.raises(ValueError, match=r"facet 1 .* has no area"):
        build_mesh(*found)
