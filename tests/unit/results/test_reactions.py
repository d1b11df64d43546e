"""Reactions and load resultants against hand sums."""

from dataclasses import replace

import numpy as np
import pytest

from figure_cases import write_case
from foldshell.loads.cases import make_load_cases
from foldshell.results.design_view import view_design
from foldshell.results.reactions import find_reactions
from foldshell.results.state import read_state
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.make import make_settings
from foldshell.settings.stage import read_stage
from foldshell.settings.stages import stage_parameters
from foldshell.shell.analysis import analyse_shell, build_model


def analysed(folder):
    """Return a small case whose displacements are those of its own first-order analysis."""
    plain = stage_parameters(make_settings({}), "size")
    plain["combinations"] = {
        "strength": {"S1": {"SW": 1.4, "SDL": 1.4}, "S2": {"LL": 1.0}},
        "deflection": {"D1": {"SW": 1.0}, "D2": {"WX": 1.0, "LL": 0.5}},
    }
    plain["analysis"] = plain["analysis"] | {"second_order": False}
    given = read_stage(plain, *ANALYSED)
    *files, _ = write_case(folder)
    state = read_state("case", *files, given.combinations)
    material = given.material
    model = build_model(state.mesh, state.shell.supported_nodes, material.poissons_ratio)
    cases = make_load_cases(given.loads, material.unit_weight)
    thickness = model.to_elements(state.final.thickness)
    found = analyse_shell(
        model, thickness, material, cases, given.combinations.all, given.analysis
    )  # fmt: skip
    final = replace(state.final, displacement=found.displacement)
    return replace(state, final=final), given, model


def test_reactions_carry_the_loads(tmp_path):
    """Sum of reactions against hand sums of weight, dead load, live load and wind: to 1e-9."""
    state, given, model = analysed(tmp_path)
    found = find_reactions(view_design(state, given, 5.0, "miura"), given)
    area, normal = model.operators.geometry.area, model.operators.geometry.frame[:, 2]
    thickness = model.to_elements(state.final.thickness)
    own = -25.0 * (area * thickness).sum()
    dead = -0.5 * (area[:, None] * normal).sum(axis=0)
    live, wind = -1.0 * area.sum(), 0.85 * area.sum()
    hand = np.array([[*(1.4 * dead[:2]), 1.4 * (own + dead[2])], [0, 0, live], [0, 0, own],
                     [wind, 0, 0.5 * live]]).T  # fmt: skip
    total = found.force.sum(axis=0)
    assert total == pytest.approx(-hand, abs=1e-9 * np.abs(hand).max())
    assert found.resultant[2, 0] == pytest.approx(own, rel=1e-12)


def test_edges_share_out_all_reactions(tmp_path):
    """Both strip edges of the case, at their places, and nothing left over."""
    state, given, _ = analysed(tmp_path)
    found = find_reactions(view_design(state, given, 5.0, "miura"), given)
    assert [edge.name for edge in found.edges] == ["first strip edge", "last strip edge"]
    total = sum(edge.force for edge in found.edges)
    assert total == pytest.approx(found.force.sum(axis=0), abs=1e-12 * np.abs(total).max())
    strip, vertices = state.folded.strip, state.folded.vertices
    for edge, number in zip(found.edges, (0, strip.max()), strict=True):
        side = vertices[strip == number]
        assert (edge.place >= side.min(axis=0) - 1e-9).all()
        assert (edge.place <= side.max(axis=0) + 1e-9).all()


def test_no_displacements_no_reactions(tmp_path):
    """A mechanism has none."""
    state, given, _ = analysed(tmp_path)
    lost = np.full_like(state.final.displacement, np.nan)
    broken = replace(state, final=replace(state.final, displacement=lost))
    assert find_reactions(view_design(broken, given, 5.0, "miura"), given) is None
