"""Steel of the independent code: its shear, its strips, and how it stands beside the other's."""

import json

import numpy as np
import pytest

from crosscheck.element import compute_tied_shear, integrate_elements, interpolate_tied_shear
from crosscheck.panel_steel import Laid, find_inner_sides
from crosscheck.primary import read_reinforcement
from crosscheck.reinforcement import compare_reinforcement
from crosscheck.steel import Bars

LAID = Laid(Bars(), 0.3, 0.5, True, ("S2",))
GIVEN = {"steel_kg_m2": [10.0, 10.2], "steel_max_kn_m": [300.0, 310.0],
         "moment_max_knm_m": [4.0, 4.1], "shear_max_kn_m": [20.0, 30.0]}  # fmt: skip


def run(**changes):
    """Values of one mesh: those of the other code's finest, some of them changed."""
    return {name: values[-1] for name, values in GIVEN.items()} | changes


def test_shear_of_a_tilted_rigid_plate_is_its_slope():
    """w = 0.3 x - 0.2 y without rotation: gamma = (0.3, -0.2) at every point of a skewed element,
    to round-off, since the tied field holds constants."""
    side = np.array([-1.0, 0.0, 1.0])
    r, s = (one.ravel() for one in np.meshgrid(side, side))
    xy = np.stack([1.3 * r + 0.4 * s + 2, 0.1 * r + 0.9 * s], axis=-1)[None]
    plate = np.zeros((1, 9, 3))
    plate[0, :, 0] = xy[0] @ [0.3, -0.2]
    tied = compute_tied_shear(xy) @ plate.reshape(1, 27, 1)
    found = interpolate_tied_shear(integrate_elements(xy), tied[..., 0])
    assert found == pytest.approx(np.broadcast_to([0.3, -0.2], (1, 9, 2)), abs=1e-12)


def test_sides_inside_a_panel_are_its_diagonals():
    class Sheet:
        facets = np.array([[0, 1, 3], [0, 3, 2], [1, 4, 3]])
        facet_panel = np.array([0, 0, 1])

    assert find_inner_sides(Sheet).tolist() == [[False, False, True], [True, False, False],
                                                [False, False, False]]  # fmt: skip


def test_steel_decides_and_moments_and_shear_are_told_beside():
    same = compare_reinforcement(LAID, GIVEN, [run(), run(shear_max_kn_m=60.0)])
    assert same.passed and same.reason is None
    assert not same.quantities["shear_max_kn_m"].passed
    assert same.quantities["shear_max_kn_m"].primary_mesh_error == pytest.approx(1 / 3)
    more = compare_reinforcement(LAID, GIVEN, [run(steel_kg_m2=11.0), run(steel_kg_m2=12.0)])
    assert not more.passed
    assert more.quantities["steel_kg_m2"].relative_difference == pytest.approx(1.8 / 12)
    assert more.reason == (
        "mass of steel differs by 15 %: between its two meshes it moves by 1.96 % in the primary "
        "code and by 8.33 % in the independent one"
    )


def test_what_is_laid_is_read_from_the_other_codes_file(tmp_path):
    laid = {"level_m": 0.021, "two_layers_from_m": None, "central_lever_ratio": 0.45,
            "yield_kpa": 4e5, "crush_kpa": 2e4, "density_kg_m3": 7850, "strip_m": 0.3,
            "shear_strip_m": 0.5, "diagonals": False}  # fmt: skip
    study = {"combinations": ["S2"], "laid": laid, "quantities": GIVEN}
    data = {"subdivisions": [4, 12], "reinforcement": study}
    (tmp_path / "primary.json").write_text(json.dumps(data))
    found, given = read_reinforcement(tmp_path / "primary.json")
    assert found.bars == Bars(0.021, np.inf, 0.45, 4e5, 2e4, 7850)
    assert (found.strip, found.shear_strip, found.diagonals) == (0.3, 0.5, False)
    assert given == GIVEN
    del data["reinforcement"]
    (tmp_path / "primary.json").write_text(json.dumps(data))
    assert read_reinforcement(tmp_path / "primary.json") is None
