"""What the view shows of single combinations: sums that must close, tensors that are known."""

import numpy as np
import pytest

from figure_cases import PANELS
from foldshell.report.combination_data import (
    average_panels,
    gather_reactions,
    make_combination_data,
    principal_values,
    sum_cases,
)
from foldshell.report.viewer_data import make_grid
from foldshell.results.combination_fields import CombinationFields
from foldshell.results.design_view import view_design
from foldshell.results.fields import cell_area
from foldshell.results.reactions import find_reactions
from unit.results.test_reactions import analysed


def test_loads_of_panels_add_up_to_the_resultants(tmp_path):
    """Every case, every direction: to 1e-12 of the largest."""
    state, given, _ = analysed(tmp_path)
    view = view_design(state, given, 5.0, "miura")
    found = find_reactions(view, given)
    panels = sum_cases(state, given, view.operators)
    assert panels.shape == (len(found.cases), PANELS, 3)
    assert pytest.approx(found.resultant, abs=1e-9) == panels.sum(axis=1).T


def test_reactions_at_vertices_keep_their_sum(tmp_path):
    """Nodes between vertices count with the nearer one."""
    state, given, _ = analysed(tmp_path)
    found = find_reactions(view_design(state, given, 5.0, "miura"), given)
    vertices, forces = gather_reactions(state, found)
    assert len(vertices) == 10 and forces.shape == (4, 10, 3)
    assert pytest.approx(found.force.sum(axis=0), abs=1e-9) == forces.sum(axis=1).T


def test_panel_means_are_weighted_by_area(tmp_path):
    """A field that is the number of the panel comes back; a single cell counts by its area."""
    state, _, _ = analysed(tmp_path)
    number = state.cell_panel.astype(float)
    force = np.repeat(number[None, :, None], 3, axis=2)
    empty = np.empty((0, len(number)))
    fields = CombinationFields(np.empty((len(number), 3, 3)), force, force, force[..., :2], empty)
    assert average_panels(state, fields)[0] == pytest.approx(
        np.repeat(np.arange(PANELS)[:, None], 8, axis=1), abs=1e-12
    )
    area = cell_area(state)
    one = np.flatnonzero(state.cell_panel == 3)
    values = np.zeros((1, len(number), 3))
    values[0, one[0]] = 1
    fields = CombinationFields(fields.axes, values, values, values[..., :2], empty)
    mean = average_panels(state, fields)[0, 3, 0]
    assert mean == pytest.approx(area[one[0]] / area[one].sum(), rel=1e-12)


def test_principal_values_of_known_tensors():
    """Uniaxial 5 along 30 degrees: 5 and 0; pure shear 2: 2 and -2."""
    c, s = np.cos(np.radians(30)), np.sin(np.radians(30))
    found = principal_values(np.array([[5 * c * c, 5 * s * s, 5 * c * s], [0, 0, 2.0]]))
    assert pytest.approx(np.array([[5, 0], [2, -2]]), abs=1e-12) == found.T


def test_nothing_without_displacements(tmp_path):
    """No combination to choose."""
    state, given, _ = analysed(tmp_path)
    view = view_design(state, given, 5.0, "miura")
    found = make_combination_data(view, make_grid(view), None, given)
    assert found.arrays == {} and found.facts["combinations"] == []


def test_displacements_of_all_combinations_are_those_of_each(tmp_path):
    """All at once or one by one: the same numbers."""
    state, _, _ = analysed(tmp_path)
    found = state.all_displacements()
    for number, name in enumerate(state.combinations):
        one = state.displacement_at_nodes(name)
        assert np.abs(found[number] - one).max() <= 1e-15 * np.abs(one).max() + 1e-300
