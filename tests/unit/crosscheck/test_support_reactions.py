"""Reactions of each support: statics, the thrust of a two-hinged frame, and their comparison."""

import copy
from dataclasses import replace

import numpy as np
import openpyxl
import pytest

from crosscheck.analysis import analyse_model, list_values
from crosscheck.comparison import compare
from crosscheck.model import read_model
from crosscheck.reactions import find_thrusts
from crosscheck.records import ShearShare
from crosscheck.stability import Method, analyse_mesh
from crosscheck.supports import share_nodes
from crosscheck.values import build_independent
from crosscheck.workbook import write_comparison
from crosscheck_models import describe_model, describe_small_fold, describe_strip, write_model

SPAN, RISE, WIDTH = 8.0, 2.0, 1.5


def name_supports(data, **supports):
    """Format 3 of a model: named supports, and several combinations compared."""
    data = data | {"format": "foldshell-neutral-model 3"}
    del data["supported_edges"]
    data["supports"] = [{"name": name, "edges": edges} for name, edges in supports.items()]
    data["compare"] = {"strength": ["S2"], "deflection": ["D2"]}
    return data


def describe_gable(turn=0.0):
    """Two strips that meet at a ridge, pinned at both eaves; no Poisson's ratio, so a frame."""
    x = np.array([0.0, SPAN / 2, SPAN])
    z = np.array([0.0, RISE, 0.0])
    vertices = np.array([[x[i], y, z[i]] for y in (0.0, WIDTH) for i in range(3)])
    c, s = np.cos(turn), np.sin(turn)
    vertices = vertices @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]).T
    facets = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]]
    data = describe_model(vertices, facets, [[0, 3], [2, 5]], 0.05)
    data["material"] |= {"poissons_ratio": 0.0}
    data["combinations"] = {"S2": {"SW": 1.0}, "D2": {"SW": 1.0, "WX": 1.0}}
    return name_supports(data, left=[[0, 3]], right=[[5, 2]])


@pytest.mark.parametrize("turn", [0.0, 0.7])
def test_thrust_of_a_two_hinged_frame(tmp_path, turn):
    """H f = w L^2 / 8 + w L^2 / 32, w per metre of plan: bars that symmetry fixes at the ridge.

    Within 1 %: the bars shorten (t^2 / f^2 of the thrust), and the mesh. Each eave carries half of
    the weight, to rounding, whichever way the frame is turned.
    """
    model = read_model(write_model(tmp_path / "model.json", describe_gable(turn)))
    values = list_values(analyse_model(model, 2))["S2"]["support_reactions_kn"]
    weight = 25.0 * 0.05 * 2 * np.hypot(SPAN / 2, RISE) * WIDTH
    thrusts = find_thrusts(model)
    for name, force in values.items():
        assert force[2] == pytest.approx(weight / 2, rel=1e-8)
        assert force @ thrusts[name] == pytest.approx(5 * weight * SPAN / (32 * RISE), rel=1e-2)


def test_thrusts_point_inward_at_right_angles_to_the_edge(tmp_path):
    model = read_model(write_model(tmp_path / "model.json", describe_gable()))
    thrusts = find_thrusts(model)
    assert thrusts["left"] == pytest.approx([1, 0, 0], abs=1e-12)
    assert thrusts["right"] == pytest.approx([-1, 0, 0], abs=1e-12)


def test_a_corner_counts_by_half_for_each_of_two_supports(tmp_path):
    data = name_supports(describe_small_fold(), front=[[0, 1], [1, 2], [2, 3]], left=[[0, 4]])
    model = read_model(write_model(tmp_path / "model.json", data))
    analysis = analyse_model(model, 1)
    shares = share_nodes(model.supports, analysis.system.grid.mesh)
    assert (shares["front"][0] == 0.5).all() and (shares["left"][0] == 0.5).all()
    assert (shares["front"][1] == 1).all() and (shares["left"][[1, 4]] == [[0], [1]]).all()
    values = list_values(analysis)["D2"]
    total = np.sum(list(values["support_reactions_kn"].values()), axis=0)
    np.testing.assert_allclose(total, values["reaction_sum_kn"], rtol=1e-12)


@pytest.mark.parametrize("solver", ["multifrontal", "scipy"])
def test_each_half_of_a_beam_goes_to_its_support(tmp_path, solver):
    """Quarter-point statics of a strip pinned at both ends, loaded on its left half alone."""
    data = describe_strip(length=6.0, width=1.0, thickness=0.2, parts=2)
    data["format"] = "foldshell-neutral-model 2"
    data["self_weight_only_panels"] = [1]
    data["combinations"] = {"S2": {"LL": 1.0}, "D2": {"SW": 1.0}}
    data = name_supports(data, left=data["supported_edges"][:1], right=data["supported_edges"][1:])
    model = read_model(write_model(tmp_path / "model.json", data))
    found = list_values(analyse_model(model, 1, solver=solver))["S2"]["support_reactions_kn"]
    assert found["left"][2] == pytest.approx(3.0 * 0.75, rel=1e-7)
    assert found["right"][2] == pytest.approx(3.0 * 0.25, rel=1e-7)


@pytest.fixture(scope="module")
def both_codes(tmp_path_factory):
    """A primary code that has the values of this one."""
    path = tmp_path_factory.mktemp("model") / "model.json"
    model = read_model(write_model(path, describe_gable()))
    runs = [analyse_mesh(model, m, Method()) for m in (1, 2)]
    independent = build_independent([1, 2], runs)
    return copy.deepcopy(independent), independent, find_thrusts(model)


def test_reactions_of_each_support_are_compared_in_both_orders(both_codes):
    primary, independent, thrusts = both_codes
    result = compare(primary, independent, {}, thrusts=thrusts)
    assert result.passed
    assert set(result.reactions) == {
        f"{c}{order} {edge}" for c in ("S2", "D2") for order in ("", " Th.II")
        for edge in ("left", "right")
    }  # fmt: skip
    entry = result.reactions["S2 left"]
    assert entry.primary_thrust_kn == entry.independent_thrust_kn == entry.primary_kn[0] > 0


@pytest.mark.parametrize(("part", "passed"), [(0.03, True), (0.05, False)])
def test_a_force_that_moves_from_one_edge_to_another_is_seen(both_codes, part, passed):
    """The sum stays: no other quantity can tell. 4 % of the largest resultant is allowed."""
    primary, independent, thrusts = both_codes
    moved = copy.deepcopy(primary)
    values = moved.values["S2"]["support_reactions_kn"]
    for mesh in values:
        shift = part * np.linalg.norm(mesh["left"])
        mesh["left"] = np.add(mesh["left"], [0, 0, shift]).tolist()
        mesh["right"] = np.subtract(mesh["right"], [0, 0, shift]).tolist()
    result = compare(moved, independent, {}, thrusts=thrusts)
    assert result.passed == passed
    assert all(entry.passed for entry in result.quantities.values())
    assert result.reactions["S2 left"].passed == passed
    assert compare(moved, independent, {"support_reaction": 0.1}, thrusts=thrusts).passed


def test_the_workbook_shows_reactions_and_shear(both_codes, tmp_path):
    """Four rows a support, the failed one red; the verdict on shear in words."""
    primary, independent, thrusts = both_codes
    moved = copy.deepcopy(primary)
    for mesh in moved.values["D2"]["support_reactions_kn"]:
        mesh["left"] = np.multiply(mesh["left"], 1.2).tolist()
    share = ShearShare(
        combination="D2", share=0.043, share_meshes=[0.015, 0.033], value=0.1129, limit=0.1167,
        with_shear=0.1178, refined_with_shear=0.1193, turns=True, turns_refined=True,
    )  # fmt: skip
    result = compare(moved, independent, {}, thrusts=thrusts)
    result = replace(result, shear={"displacement_down_max_m": share})
    write_comparison(tmp_path / "c.xlsx", "gable", result)
    book = openpyxl.load_workbook(tmp_path / "c.xlsx")
    assert book.sheetnames == ["comparison", "meshes", "reactions", "shear"]
    rows = list(book["reactions"].iter_rows(min_row=4))
    assert len(rows) == 4 * len(result.reactions)
    at = {tuple(cell.value for cell in row[:3]): row for row in rows}
    thrust = at["S2", "left", "thrust"]
    exact = result.reactions["S2 left"].primary_thrust_kn
    assert thrust[3].value == pytest.approx(exact, rel=1e-12)
    assert at["D2", "left", "x"][7].value == "failed"
    assert at["D2", "left", "x"][0].fill.fgColor.rgb == "FFFFC7CE"
    assert at["D2 Th.II", "right", "x"][7].value == "passed"
    (row,) = book["shear"].iter_rows(min_row=4, values_only=True)
    assert row[:4] == (
        "largest downward displacement", "D2", "turns with shear deformation", pytest.approx(4.3),
    )  # fmt: skip
