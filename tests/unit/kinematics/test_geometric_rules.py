"""The module of the paper's Fig. 1: its trajectories, and a table that shows what is wrong."""

import math

import numpy as np
import pytest

from foldshell.kinematics import geometric_rules
from foldshell.kinematics.geometric_rules import (
    PANELS,
    compare_with_closed_form,
    list_angles,
    place_module,
    trace_points,
)
from foldshell.kinematics.reverse_fold import fold_by_rules, largest_travel
from foldshell.kinematics.trajectory_figure import project
from foldshell.pattern.miura import Miura

PATTERN = Miura(1.3, 0.7, math.radians(60), 5, 6)
PATH = np.linspace(0.0, math.pi / 2, 31)


def test_e_and_h_come_together_and_i_rises_between_them():
    """V1 and V2 are opposite; |EH| = 2 a - t; P's path is upright, its height a sin t sin g."""
    traced = trace_points(PATTERN, PATH, "EHI")
    assert np.allclose(traced["E"], -traced["H"], atol=1e-15)
    gone = traced["E"][:, 1] - traced["E"][0, 1]
    assert gone[-1] == pytest.approx(largest_travel(PATTERN) / 2, abs=1e-14)
    assert (np.diff(gone) > 0).all()
    height = 1.3 * np.sin(PATH) * math.sin(PATTERN.sector_angle)
    assert np.allclose(traced["I"], np.column_stack([0 * PATH, 0 * PATH, height]), atol=1e-14)


@pytest.mark.parametrize("angle", [0.0, 0.4, 1.1, math.pi / 2])
def test_every_panel_of_the_module_keeps_its_shape(angle):
    """All six are congruent to the flat parallelogram: sides 1.3, 0.7 and both diagonals."""
    flat, folded = place_module(PATTERN, 0.0), place_module(PATTERN, angle)
    for name, panel in PANELS.items():
        for one in range(4):
            for two in range(one):
                lengths = [np.linalg.norm(at[panel[one]] - at[panel[two]]) for at in (flat, folded)]
                assert lengths[0] == pytest.approx(lengths[1], abs=1e-14), name


def test_neighbours_share_their_folds():
    """Two panels of the module that touch have two corners in common."""
    for pair in (("S1", "S3"), ("S3", "S4"), ("S4", "S2"), ("S3", "S5"), ("S4", "S6")):
        assert len(set(PANELS[pair[0]]) & set(PANELS[pair[1]])) == 2, pair


def test_centre_of_a_panel_is_the_mean_of_its_corners():
    at = place_module(PATTERN, 0.7)
    centre = trace_points(PATTERN, [0.7], ["S5"])["S5"][0]
    assert centre == pytest.approx(sum(at[corner] for corner in "EIvu") / 4)
    mirrored = trace_points(PATTERN, [0.7], ["S3"])["S3"][0] * [-1, 1, 1]
    assert centre == pytest.approx(mirrored, abs=1e-15)


def test_angles_run_over_the_whole_path_with_the_rest_state():
    angles = list_angles(math.radians(60))
    assert angles[0] == 0.0 and angles[-1] == math.pi / 2 and len(angles) == 20
    assert min(abs(math.degrees(a) - 54.7356) for a in angles) < 1e-4


def test_a_wrong_rule_shows(monkeypatch):
    """A fold of 0.1 mm too much at one vertex is seen by every measure but the travel."""

    def slip(pattern, travel):
        vertices = fold_by_rules(pattern, travel)
        vertices[8] += 1e-4
        return vertices

    monkeypatch.setattr(geometric_rules, "fold_by_rules", slip)
    row = compare_with_closed_form(PATTERN, 0.8)
    assert row.vertices_max_m == pytest.approx(math.sqrt(3) * 1e-4, rel=1e-9)
    seen = (row.edge_strain_max, row.planarity_max, row.angle_defect_max_rad, row.kawasaki_max_rad)
    assert min(seen) > 1e-6


def test_view_keeps_lengths_across_the_line_of_sight():
    """Seen along x at level, (y, z) is what is drawn."""
    assert project(np.array([5.0, 2.0, 3.0]), 0.0, 0.0) == pytest.approx([2.0, 3.0])
