"""Reinforcement of panels: a strip in pure tension, layouts that cannot be, bars, quantities."""

import numpy as np
import pytest

from foldshell.checks.concrete import envelope
from foldshell.checks.concrete.layout import describe_fit, lay_out, refuse_layout
from foldshell.checks.concrete.model import build_concrete_model
from foldshell.checks.concrete.quantities import Quantities, sum_cost, sum_emissions, sum_steel
from foldshell.checks.concrete.schedule import choose_bars, make_schedule
from foldshell.checks.concrete.use import find_panel_use
from foldshell.settings.reinforcement import Co2, Prices, Reinforcement
from foldshell.shell.mesh import build_mesh
from foldshell.shell.stiffness import build_operators
from foldshell.shell.stress import StressResultants

ASKED = Reinforcement()


def make_state(force, thickness=0.1, asked=ASKED):
    """Two rectangular panels in one plane under one uniform membrane force in the axes of x."""
    flat = np.array([[x, y, 0.0] for y in (0, 2) for x in (0, 3, 6)], float)
    facets = np.array([[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]])
    mesh = build_mesh(flat, facets, np.array([0, 0, 1, 1]), 4)
    operators = build_operators(mesh, 0.2)
    tensor = np.array([[force[0], force[2]], [force[2], force[1]]])
    local = operators.geometry.frame[:, :2, :2]
    own = np.einsum("eax,xy,eby->eab", local, tensor, local)
    values = np.zeros((len(own), 3, mesh.order * (mesh.order + 1) // 2, 2))
    for k, (a, b) in enumerate(((0, 0), (1, 1), (0, 1))):
        values[:, k, 0, 0] = own[:, a, b]
        values[:, k, 0, 1] = own[:, a, b] / 2
    found = StressResultants(values, np.zeros_like(values), np.zeros((len(own), 15, 2)))
    model = build_concrete_model(operators, 2, asked, 0.3)
    return find_panel_use(model, found, np.full(2, thickness), ("strut", "ratio", "shear", "fit"))


def test_uniform_tension_gives_every_panel_its_steel():
    """100, 50 and 20 kN/m of shear: 120 and 70 kN/m in two layers; the first combination governs,
    and the panels crack at f_ctd = 0.7 2.565 / 1.5 MPa, 119.7 kN/m: not at 107.9 kN/m."""
    found = make_state((100.0, 50.0, 20.0))
    needed = np.array([[60.0, 35.0], [60.0, 35.0]]) / (500e3 / 1.15)
    assert found.steel.needed == pytest.approx(np.stack([needed, needed]))
    assert not found.steel.cracked.any()
    assert (found.combination[:, :2] == 0).all()
    assert found.shares[:, 2] == pytest.approx(0, abs=1e-9)
    assert found.steel.ratio_use == pytest.approx(2 * needed[0, 0] / (0.04 * 0.1))


def test_combinations_in_parts_are_those_of_all_at_once(monkeypatch):
    """Of a large shell some combinations at a time fit into memory: the same bits."""
    whole = make_state((100.0, 50.0, 20.0))
    monkeypatch.setattr(envelope, "NUMBERS", 1)
    parts = make_state((100.0, 50.0, 20.0))
    for name in ("needed", "strut_use", "fit_use", "cracked"):
        assert (getattr(parts.steel, name) == getattr(whole.steel, name)).all()
    assert (parts.combination == whole.combination).all()
    assert (parts.shear.size == whole.shear.size).all()


def test_cracked_panels_get_least_steel_and_thin_ones_one_mesh():
    """150 kN/m crack 40 mm; y has no force and gets k f_ctm t / f_yk in the middle."""
    found = make_state((150.0, 0.0, 0.0), thickness=0.04)
    assert found.steel.cracked.all() and not found.steel.two_layers.any()
    fctm = 0.3 * 25 ** (2 / 3)
    assert found.steel.area[0, 0] == pytest.approx([150 / (500e3 / 1.15), fctm * 0.04 / 500])
    assert (found.steel.area[:, 1] == 0).all()


def test_pressure_crushes_where_the_sheet_is_full():
    found = make_state((-25e3 / 1.5 * 0.1, 0.0, 0.0))
    assert found.steel.strut_use == pytest.approx(1.0)
    assert found.steel.needed.max() == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ("changes", "thickness", "words"),
    [
        ({"fck": 95e3}, 0.1, "fck of 95 MPa is outside"),
        ({"fyk": 300e3}, 0.1, "fyk of 300 MPa is outside"),
        ({"cover": 0.05}, 0.04, "cover of 50 mm is not less than the sheet's 40 mm"),
        ({"diameter": 0.025, "cover": 0.03}, 0.04, "bars of 25 mm that cross do not fit"),
        ({"exposure": "XC4"}, 0.2, "exposure XC4 needs a cover of 30 mm, cover_mm is 15"),
        ({}, 0.04, ""),
    ],
)
def test_layouts_that_cannot_be_are_named_in_a_sentence(changes, thickness, words):
    refused = refuse_layout(ASKED.changed(**changes), np.array([thickness, 0.3]))
    assert refused.startswith(words) and bool(refused) == bool(words)


def test_panels_without_room_are_counted():
    layout = lay_out(ASKED)
    words = describe_fit(layout, np.array([0.04, 0.041, 0.06]))
    assert words.startswith("2 panels from 40 mm have no place for crossing bars of 6 mm")
    assert "least distances" in describe_fit(layout, np.array([0.05]))


def test_textile_fits_where_bars_do_not():
    grid = lay_out(ASKED.changed(kind="textile"))
    assert grid.two_from == pytest.approx(0.028)
    assert grid.strengths.fyd == pytest.approx(1000e3)
    assert lay_out(ASKED.changed(kind="central_mesh")).two_from == np.inf


def test_bars_hold_what_is_needed_at_spacings_that_can_be_laid():
    layout = lay_out(ASKED)
    for area in (1e-4, 5e-4, 12e-4, 30e-4):
        diameter, spacing, given = choose_bars(area, 0.15, True, layout)
        assert given >= area and given == pytest.approx(np.pi * diameter**2 / 4 / spacing)
        assert spacing >= diameter + 0.02 - 1e-12
        assert spacing * 1e3 == pytest.approx(round(spacing * 1e3 / 5) * 5) or given < 1.3 * area


def test_schedule_has_a_row_for_each_class_layer_and_direction():
    layout = lay_out(ASKED)
    needed = np.zeros((3, 2, 2))
    needed[:, 0] = [[2e-4, 1e-4], [3e-4, 1e-4], [4e-4, 2e-4]]
    rows = make_schedule(
        needed, np.array([False, False, True]), np.array([0.05, 0.05, 0.1]),
        np.array([2.0, 3.0, 4.0]), layout,
    )  # fmt: skip
    assert [(one.thickness, one.layer, one.direction, one.panels) for one in rows] == [
        (0.05, "middle", "x", 2), (0.05, "middle", "y", 2),
        (0.1, "bottom", "x", 1), (0.1, "bottom", "y", 1)]  # fmt: skip
    assert rows[0].use == pytest.approx(3e-4 / rows[0].area)
    assert rows[0].mass == pytest.approx(rows[0].area * 5.0 * 7850)


def test_quantities_by_hand():
    steel = sum_steel(np.full((2, 2, 2), 1e-4), np.array([3.0, 5.0]), 7850)
    assert steel == pytest.approx(4e-4 * 8 * 7850)
    total = Quantities(2.0, 100.0, 10.0, 40.0)
    assert sum_emissions(total, Co2()) == pytest.approx((600, 475, 772))
    assert sum_cost(total, Prices()) is None
    priced = Prices(concrete_m3=200.0, steel_kg=2.0, crease_m=5.0, range_share=0.1)
    assert sum_cost(total, priced) == pytest.approx((650, 585, 715))
