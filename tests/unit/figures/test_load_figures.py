"""The picture of load cases: where arrows begin and end, and what stands below."""

from dataclasses import replace

import numpy as np
import pytest

from figure_cases import COMBINATIONS, PANELS, write_case
from foldshell.figures.load_figures import draw_loads, find_cases, make_arrows
from foldshell.loads.cases import SETTLEMENT, TEMPERATURE, SurfaceLoad, make_load_cases
from foldshell.results.design_view import make_design_view
from foldshell.results.state import read_state
from foldshell.settings.loads import Combinations, Loads
from foldshell.settings.material import Material
from foldshell.settings.sizing import Sizing
from foldshell.settings.zones import read_zone
from foldshell.shell.results import panel_centroids

MIXED = (
    SurfaceLoad("P", "pressure", 2.0, None, zone=read_zone("panels 0-4"), where="panels 0-4"),
    SurfaceLoad("P", "pressure", 1.0, (0.0, 0.0, 1.0), zone=read_zone("panels 19")),
    SurfaceLoad("T", TEMPERATURE, 20.0, (0.0, 0.0, -1.0)),
    SurfaceLoad("U", SETTLEMENT, 0.01, (0.0, 0.0, -1.0)),
)


def view_of(folder, loads):
    state = read_state("case", *write_case(folder)[:4], Combinations(**COMBINATIONS))
    view = make_design_view(state, 5.0, Sizing(), Material())
    return replace(view, loads=loads)


def test_arrows_press_on_the_panel_or_pull_at_it(tmp_path):
    """Pressure against the normal ends on the centroid, suction begins there; twice the load has
    twice the length."""
    view = view_of(tmp_path, MIXED)
    case = find_cases(view)[0]
    centre, normal = panel_centroids(view.operators)
    arrows = make_arrows(view, case)
    assert arrows.shape == (6, 5, 3)
    assert arrows[:5, 1] == pytest.approx(centre[:5])
    assert arrows[5, 0] == pytest.approx(centre[19])
    shaft = arrows[:, 1] - arrows[:, 0]
    assert np.linalg.norm(shaft[:5], axis=1) == pytest.approx(2 * np.linalg.norm(shaft[5]))
    assert np.cross(shaft[:5], normal[:5]) == pytest.approx(0, abs=1e-9)
    assert (shaft[:5] * normal[:5]).sum(axis=1).max() < 0 and shaft[5, 2] > 0


def test_all_cases_are_drawn_with_their_sums(tmp_path):
    view = view_of(tmp_path, make_load_cases(Loads(), 25.0) + MIXED)
    cases = find_cases(view)
    assert [case.name for case in cases] == ["SW", "SDL", "LL", "WX", "WY", "P", "T", "U"]
    area = view.operators.geometry.area.sum()
    assert cases[2].force == pytest.approx([0, 0, -area]) and len(cases[2].panel_force) == PANELS
    assert cases[2].panel_force.sum(axis=0) == pytest.approx(cases[2].force)
    assert cases[6].strains and not cases[6].force.any()
    assert "on panels 0-4" in cases[5].words
    picture = draw_loads(view, (480, 360))
    assert picture.size[0] == 480 and picture.size[1] > 4 * 180
    used = np.asarray(picture).reshape(-1, 3)
    assert (np.abs(used.astype(int) - [190, 70, 0]).max(axis=1) < 40).any()
