"""Reinforcement on two meshes, its errors, and where checks of panels stand."""

import numpy as np
import pytest

from foldshell.checks.strips import find_strips
from foldshell.loads.cases import make_load_cases
from foldshell.results.mesh_convergence import DesignOnMeshes, study_design
from foldshell.results.mesh_errors import estimate_reinforcement_errors, make_record
from foldshell.results.reinforced_meshes import ConcreteAsked
from foldshell.results.reinforcement import find_mesh_errors
from foldshell.results.reinforcement_places import describe_rows
from foldshell.settings.reinforcement import Reinforcement
from foldshell.shell.mesh import build_mesh
from foldshell.shell.stiffness import build_operators
from sizing_case import PANELS, corrugated_sheet, given


def study(thickness=0.06, **asked):
    settings = given("size")
    cases = make_load_cases(settings.loads, settings.material.unit_weight)
    names = {name: settings.combinations.all[name] for name in ("S2", "D3")}
    concrete = ConcreteAsked(Reinforcement().changed(**asked), 0.3, ("S2",))
    return study_design(
        DesignOnMeshes(corrugated_sheet(), "all", np.full(PANELS, thickness), settings.material,
                       cases, names, concrete=concrete), 1
    )  # fmt: skip


def test_both_meshes_have_their_steel_and_the_error_is_that_of_the_limit():
    """With 1 and 12 subdivisions the limit is fine + (fine - coarse) / 143."""
    found = study()
    values = found.reinforcement.quantities
    assert found.reinforcement.combinations == ("S2",)
    assert found.reinforcement.laid.level_m == pytest.approx(0.021)
    assert all(low >= 0 and high >= 0 for low, high in values.values())
    assert values["steel_kg_m2"][1] > 0
    coarse, fine = values["steel_kg_m2"]
    limit = fine + (fine - coarse) / ((found.subdivisions[1] / 1) ** 2 - 1)
    errors = estimate_reinforcement_errors(found)
    assert errors["steel_kg_m2"] == pytest.approx(abs(coarse - limit) / limit)
    assert make_record(found).reinforcement_errors == errors


@pytest.mark.parametrize("asked", [{"kind": "none"}, {"cover": 0.07}, {"fck": 95e3}])
def test_what_cannot_be_designed_has_none(asked):
    found = study(**asked)
    assert found.reinforcement is None and estimate_reinforcement_errors(found) is None
    assert set(found.combinations) == {"S2", "D3"}


def test_errors_of_checks_say_nothing_of_what_is_at_its_cap():
    known = {"use_strut": 0.02, "use_punching": 0.0, "use_shear": 0.0, "shear_max_kn_m": 0.3}
    found = find_mesh_errors(known)
    assert (found["strut"], found["shear"], found["punching"], found["crack"]) == (
        0.02, 0.3, None, None)  # fmt: skip
    assert find_mesh_errors(None)["shear"] is None


def test_places_name_the_fold_the_panel_beyond_it_and_the_middle():
    flat = np.array([[x, y, 0.0] for y in (0, 2) for x in (0, 3, 6)], float)
    facets = np.array([[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]])
    mesh = build_mesh(flat, facets, np.array([0, 0, 1, 1]), 4)
    strips = find_strips(build_operators(mesh, 0.2), 0.3, True)
    words = describe_rows(mesh, strips.edge, strips.panel, strips.diagonal)
    first = {tuple(edge): one for edge, one, panel in
             zip(strips.edge.tolist(), words, strips.panel, strict=True) if panel == 0}  # fmt: skip
    assert first[1, 4] == "fold to panel 1, middle at (3.00, 1.00, 0.00) m"
    assert first[0, 1] == "border, middle at (1.50, 0.00, 0.00) m"
    assert first[0, 4] == "diagonal, middle at (1.50, 1.00, 0.00) m"
    assert words[0] == "mean of the facet at (2.00, 0.67, 0.00) m"
