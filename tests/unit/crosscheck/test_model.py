"""What the neutral model file may hold, and the sentence for what it may not."""

import copy
import json

import numpy as np
import pytest

from crosscheck.errors import CrosscheckError
from crosscheck.loads import combine_cases, compute_surface_loads
from crosscheck.model import read_model
from crosscheck.primary import read_primary
from crosscheck_models import describe_small_fold, write_model


def read(tmp_path, model):
    return read_model(write_model(tmp_path / "model.json", model))


def set_value(data, path, value):
    """Set or (value is ...) delete an entry."""
    for key in path[:-1]:
        data = data[key]
    if value is ...:
        del data[path[-1]]
    else:
        data[path[-1]] = value


def test_a_model_is_read_as_written(tmp_path):
    data = describe_small_fold()
    data["panel_thickness_m"][2] = 0.1
    model = read(tmp_path, data)
    assert model.vertices.shape == (12, 3)
    assert model.facets.shape == (12, 3)
    np.testing.assert_array_equal(model.thickness[4:6], 0.1)
    assert list(model.compared_combinations) == ["S2", "D2"]
    assert model.loads.dead_side == "downward"


@pytest.mark.parametrize(
    ("path", "value", "words"),
    [
        (("format",), "something 2", ["format", "something 2"]),
        (("design",), 4, ["design", "text"]),
        (("vertices_m", 3), [0, 1], ["vertices_m[3]", "3 numbers"]),
        (("vertices_m", 3, 1), float("nan"), ["vertices_m[3][1]", "finite"]),
        (("facets", 2), [0, 1, 40], ["facets[2]", "0 to 11"]),
        (("facets", 2), [0, 1, 1], ["facets[2]", "different"]),
        (("facets", 2), [0, 1, 1.5], ["facets[2]"]),
        (("facet_panel", 0), 9, ["facet_panel[0]", "0 to 5"]),
        (("facet_panel",), [0, 0], ["facet_panel", "12"]),
        (("panel_thickness_m", 1), -0.1, ["panel_thickness_m[1]", "above 0"]),
        (("panel_thickness_m", 1), True, ["panel_thickness_m[1]"]),
        (("panel_thickness_m", 1), "0.1", ["panel_thickness_m[1]"]),
        (("supported_edges",), [], ["supported_edges", "not empty"]),
        (("supported_edges", 0), [0, 2], ["supported_edges[0]", "facet side"]),
        (("material", "poissons_ratio"), 0.5, ["material.poissons_ratio", "below 0.5"]),
        (("material", "strength_kpa"), 0, ["material.strength_kpa", "above 0"]),
        (("material", "strength_kpa"), ..., ["material.strength_kpa", "missing"]),
        (("material", "criterion"), "tresca", ["material.criterion", "von_mises"]),
        (("loads_kn_m2", "W"), -1, ["loads_kn_m2.W", "from 0"]),
        (("loads_kn_m2",), 3, ["loads_kn_m2", "object"]),
        (("area_basis",), "volume", ["area_basis", "plan_abs"]),
        (("combinations", "S2", "SNOW"), 1.0, ["combinations.S2", "SNOW", "WX"]),
        (("combinations", "S2", "SW"), None, ["combinations.S2.SW"]),
        (("compare", "strength"), "S9", ["compare.strength", "S9"]),
        (("compare",), ..., ["compare", "missing"]),
    ],
)
def test_a_bad_value_is_named_with_its_place(tmp_path, path, value, words):
    data = describe_small_fold()
    set_value(data, path, value)
    with pytest.raises(CrosscheckError) as caught:
        read(tmp_path, data)
    message = str(caught.value)
    assert "\n" not in message
    for word in ["model.json", *words]:
        assert word in message


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(CrosscheckError, match=r"absent\.json: cannot be read"):
        read_model(tmp_path / "absent.json")
    (tmp_path / "model.json").write_text("{")
    with pytest.raises(CrosscheckError, match=r"model\.json: not JSON"):
        read_model(tmp_path / "model.json")


PRIMARY = {
    "subdivisions": [4, 8],
    "combinations": {
        "S2": {
            "work_knm": [1.0, 1.1],
            "reaction_sum_kn": [[0, 0, 1], [0, 0, 1]],
            "load_sum_kn": [[0, 0, -1], [0, 0, -1]],
            "second_order": {"work_knm": [1.2, 1.3]},
        }
    },
}


@pytest.mark.parametrize(
    ("path", "value", "words"),
    [
        (("subdivisions",), [8, 4], ["subdivisions", "increase"]),
        (("subdivisions",), [], ["subdivisions"]),
        (("combinations", "S2"), ..., ["combinations.S2", "missing"]),
        (("combinations", "S2", "work_knm"), [1.0], ["S2.work_knm", "2, one a mesh"]),
        (("combinations", "S2", "work_knm", 1), None, ["S2.work_knm[1]", "finite"]),
        (("combinations", "S2", "load_sum_kn"), ..., ["load_sum_kn", "missing"]),
        (("combinations", "S2", "reaction_sum_kn", 0), [1, 2], ["reaction_sum_kn[0]", "3"]),
        (("orders",), {"work_knm": 0}, ["orders.work_knm", "above 0"]),
    ],
)
def test_bad_primary_values_are_named(tmp_path, path, value, words):
    data = copy.deepcopy(PRIMARY)
    set_value(data, path, value)
    (tmp_path / "primary.json").write_text(json.dumps(data))
    with pytest.raises(CrosscheckError) as caught:
        read_primary(tmp_path / "primary.json", ["S2"])
    for word in ["primary.json", *words]:
        assert word in str(caught.value)


def test_second_order_values_stand_under_their_own_name(tmp_path):
    (tmp_path / "primary.json").write_text(json.dumps(PRIMARY))
    code = read_primary(tmp_path / "primary.json", ["S2"])
    assert code.values["S2 Th.II"] == {"work_knm": [1.2, 1.3]}


def test_loads_follow_the_words_of_the_paper(tmp_path):
    """A facet at 60 degrees and one that overhangs, by hand: kN on a square metre of facet."""
    model = read(tmp_path, describe_small_fold(0.2))
    normal = np.zeros((12, 3))
    normal[:] = [0, -np.sqrt(3) / 2, 0.5]
    normal[1] = [0.6, 0, -0.8]
    cases = compute_surface_loads(model, normal)
    np.testing.assert_allclose(
        cases[0].T,
        [[0, 0, -5], [0, np.sqrt(3) / 4, -0.25], [0, 0, -1], [0.85, 0, 0], [0, 0.85, 0]],
        atol=1e-15,
    )
    np.testing.assert_allclose(cases[1, :, 1], [0.3, 0, -0.4])
    total = combine_cases(cases, {"S2": {"SW": 1.2, "SDL": 1.2, "LL": 1.6, "WX": 0.5}})[0, :, 0]
    np.testing.assert_allclose(total, [0.425, 0.3 * np.sqrt(3), -6 - 0.3 - 1.6])


def test_plan_area_and_the_sheets_side(tmp_path):
    data = describe_small_fold()
    data["area_basis"] = "plan_abs"
    data["loads_kn_m2"]["dead_side"] = "sheet"
    cases = compute_surface_loads(read(tmp_path, data), np.tile([0.6, 0, -0.8], (12, 1)))
    np.testing.assert_allclose(cases[0, 2, 2], -0.8)
    np.testing.assert_allclose(cases[0, 0, 3], 0.85 * 0.8)
    np.testing.assert_allclose(cases[0, :, 1], [-0.3, 0, 0.4])
