"""What shear deformation adds: a beam's closed form, a new factor, and verdicts that turn."""

import numpy as np
import pytest

from crosscheck.analysis import analyse_model
from crosscheck.criteria import find_governing, share_shear
from crosscheck.model import read_model
from crosscheck.search import run_alone
from crosscheck.shear import TRUE_SHEAR_FACTOR, search_sheared_state
from crosscheck.values import Code
from crosscheck_models import describe_small_fold, describe_strip, write_model


def read_strip(folder, length, thickness):
    data = describe_strip(length, 1.0, thickness, parts=4)
    data["combinations"] = {"S2": {"SW": 1.0}, "D2": {"LL": 1.0}}
    return read_model(write_model(folder / "model.json", data))


@pytest.mark.parametrize(("slender", "parts"), [(5, 2), (10, 2), (20, 2), (20, 4)])
def test_share_of_a_beam_on_two_supports(tmp_path, slender, parts):
    """48 E I / (5 k G A L^2) = 1.92 t^2 / L^2 of 5 q L^4 / (384 E I), with nu = 0, k = 5/6.

    The thin limit has 1/120 of it. Within 2 % where elements are as small as the beam is thick;
    those of twenty times its thickness leave 9 % more (5 % at m = 3, 1 % at m = 4).
    """
    analysis = analyse_model(read_strip(tmp_path, 4.0, 4.0 / slender), parts)
    sheared = run_alone(analysis.system, search_sheared_state(analysis.system, analysis.response))
    low, high = (np.abs(r.displacement[..., 1]).max() for r in (analysis.response, sheared))
    exact = 1.92 / slender**2
    found = (high / low - 1) / (exact * (1 - 1 / 120) / (1 + exact / 120))
    assert found == pytest.approx(1, abs=0.1 if (slender, parts) == (20, 2) else 0.02)


def test_no_new_factor_gives_what_a_new_one_does(tmp_path):
    """Conjugate gradients end within 2 % of what shear adds."""
    model = read_model(write_model(tmp_path / "model.json", describe_small_fold(0.15)))
    thin, true = (analyse_model(model, 2, factor) for factor in (100.0, TRUE_SHEAR_FACTOR))
    found = run_alone(thin.system, search_sheared_state(thin.system, thin.response))
    change = np.abs(true.response.displacement - thin.response.displacement).max()
    gap = np.abs(true.response.displacement - found.displacement).max()
    assert gap < 0.02 * change
    assert change > 0.01 * np.abs(thin.response.displacement).max()


def make_code(**values):
    """A code with one value of each combination's quantities on two meshes."""
    return Code([4, 8], {c: {q: [v, v] for q, v in e.items()} for c, e in values.items()}, {}, 2.0)


def make_runs(share):
    return [
        {
            "D2": {"displacement_down_max_m": 0.1},
            "D2 with shear": {"displacement_down_max_m": 0.1 * (1 + part)},
        }
        for part in (share / 2, share)
    ]


@pytest.mark.parametrize(
    ("value", "turns"), [(0.100, (False, False)), (0.1035, (True, True)), (0.106, (False, False))]
)
def test_a_verdict_that_turns_with_shear_is_flagged(tmp_path, value, turns):
    """2 % on the fine mesh, half of it on the coarse one: 2.6 % in the limit, limit 0.105 m."""
    data = describe_small_fold() | {"format": "foldshell-neutral-model 3"}
    data["supports"] = [{"name": "ends", "edges": data.pop("supported_edges")}]
    data["compare"] = {"strength": ["S2"], "deflection": ["D2"]}
    data["limits"] = {"displacement_down_max_m": 0.105}
    model = read_model(write_model(tmp_path / "model.json", data))
    primary = make_code(D2={"displacement_down_max_m": value})
    found = share_shear(model, primary, {"displacement": "D2"}, [1, 2], make_runs(0.02))
    entry = found["displacement_down_max_m"]
    assert entry.share == pytest.approx(0.02 + 0.01 / (2**1.4 - 1))
    assert entry.with_shear == pytest.approx(value * (1 + entry.share))
    assert (entry.turns, entry.turns_refined) == turns
    nothing = share_shear(model, primary, {"displacement": "D2"}, [1], [{"D2": {}}])
    assert nothing == {}


def test_shear_and_mesh_error_together_can_turn_it(tmp_path):
    data = describe_small_fold() | {"format": "foldshell-neutral-model 3"}
    data["supports"] = [{"name": "ends", "edges": data.pop("supported_edges")}]
    data["compare"] = {"strength": ["S2"], "deflection": ["D2"]}
    data["limits"] = {"displacement_down_max_m": 0.105}
    model = read_model(write_model(tmp_path / "model.json", data))
    primary = Code([4, 8], {"D2": {"displacement_down_max_m": [0.100, 0.103]}}, {}, 2.0)
    found = share_shear(model, primary, {"displacement": "D2"}, [1, 2], make_runs(0.02))
    entry = found["displacement_down_max_m"]
    assert not entry.turns and entry.turns_refined
    assert entry.refined_with_shear == pytest.approx(0.104 * (1 + entry.share))


def test_governing_is_the_largest_displacement_and_mean_and_the_least_factor():
    """To second order where it is given; strength for two criteria, deflection for the third."""
    values = {
        "S2": {"utilization_panel_mean_max": 0.8, "buckling_factor": 3.0},
        "S2 Th.II": {"utilization_panel_mean_max": 0.95},
        "S5": {"utilization_panel_mean_max": 0.9, "buckling_factor": 2.0,
               "displacement_down_max_m": 0.5},
        "D2": {"displacement_down_max_m": 0.10, "buckling_factor": 1.0},
        "D3": {"displacement_down_max_m": 0.11},
    }  # fmt: skip
    compared = {"strength": ["S2", "S5"], "deflection": ["D2", "D3"]}
    assert find_governing(make_code(**values), compared) == {
        "displacement": "D3",
        "utilization": "S2",
        "buckling": "S5",
    }
