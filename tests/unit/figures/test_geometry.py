"""Camera, creases and isolines against exact geometry."""

import numpy as np
import pytest

from figure_cases import make_state
from foldshell.figures.camera import fit_camera, look_at
from foldshell.figures.pictures import specify_utilization
from foldshell.pattern.grid import build_grid
from foldshell.results.creases import cut_dashes, find_creases
from foldshell.results.design_view import make_design_view
from foldshell.results.fields import cell_area
from foldshell.results.isolines import (
    ISOLINES,
    find_isolines,
    find_region_border,
    panel_node_values,
    utilization_isolines,
)
from foldshell.settings.make import make_settings


@pytest.mark.parametrize("aspect", [0.6, 1.9])
def test_camera_holds_all_points_and_fills_one_side(aspect):
    """The projected box is inside the picture, centred, and fills width or height less 3 %."""
    points = np.random.default_rng(1).normal(size=(200, 3)) * (20, 8, 3) + (100, -40, 7)
    seen = fit_camera(points, aspect).project(points) / (aspect, 1)
    low, high = seen.min(axis=0), seen.max(axis=0)
    assert np.allclose(low + high, 0, atol=1e-4)
    assert (high - low).max() == pytest.approx(2 * 0.94, rel=1e-4)


def test_lifted_points_stay_where_they_are_in_the_picture():
    """Moving a point along its ray changes its depth alone."""
    points = np.random.default_rng(2).normal(size=(20, 3))
    camera = fit_camera(points, 1.5)
    lifted = camera.towards(points, 0.1)
    assert np.allclose(np.linalg.norm(lifted - points, axis=1), 0.1)
    assert np.allclose(camera.project(lifted), camera.project(points), atol=1e-12)


def test_camera_looks_from_the_side_of_a_place():
    """The corner in plan nearest the place, seen from above."""
    points = np.array([[0.0, 0, 0], [10, 10, 2]])
    x, y, z = look_at(points, np.array([9.0, 1, 1]))
    assert x > 0 > y
    assert z > 0


def test_creases_are_those_of_the_pattern(tmp_path):
    """On a folded Miura sheet the measured folds have the signs of the assignment."""
    state = make_state(tmp_path)
    creases = find_creases(state.cells, state.folded)
    grid = build_grid(5, 6)
    count = {kind: int((grid.assignments == kind).sum()) for kind in "MVB"}
    assert len(creases.mountain) == count["M"]
    assert len(creases.valley) == count["V"]
    assert len(creases.border) == count["B"]
    assert len(creases.flat) == 0
    ends = np.sort(creases.mountain[:, [0, -1]], axis=1)
    expected = np.sort(grid.edges[grid.assignments == "M"], axis=1)
    assert np.array_equal(np.unique(ends, axis=0), np.unique(expected, axis=0))


def test_flat_sheet_has_no_mountains(tmp_path):
    """An unfolded sheet folds nowhere: all inner edges are panel borders."""
    state = make_state(tmp_path, folded=False)
    creases = find_creases(state.cells, state.folded)
    assert len(creases.mountain) == len(creases.valley) == 0
    assert len(creases.flat) > 0


def test_smooth_shell_has_panel_borders(tmp_path):
    """A sheet that bends at its panels' borders is told to have no creases there."""
    state = make_state(tmp_path)
    creases = find_creases(state.cells, state.folded, creased=False)
    assert len(creases.mountain) == len(creases.valley) == 0
    assert len(creases.flat) == 4 * 4 + 5 * 3


def test_dashes_cover_their_share_of_a_bent_line():
    """Dashes of 55 % on a straight line of three unequal nodes lie on it and add up to 55 %."""
    line = np.array([[[0.0, 0, 0], [1, 1, 0], [2, 2, 0], [3, 3, 0]]])
    dashes = cut_dashes(line, 0.3)
    length = np.linalg.norm(dashes[:, 1] - dashes[:, 0], axis=1)
    assert length.sum() == pytest.approx(0.55 * 3 * np.sqrt(2), rel=1e-12)
    assert np.allclose(dashes[..., 0], dashes[..., 1])


def test_isoline_of_a_linear_field_is_exact():
    """x = 0.3 on a skewed triangle: one segment, both ends at x = 0.3, length by similar
    triangles."""
    corners = np.array([[[0.0, 0, 0], [1, 0.2, 0], [0.2, 0.9, 0.5]]])
    segments = find_isolines(corners, corners[..., 0], 0.3)
    assert segments.shape == (1, 2, 3)
    assert np.allclose(segments[..., 0], 0.3)
    on_first, on_last = 0.3 * corners[0, 1], corners[0, 2] + 0.125 * (corners[0, 1] - corners[0, 2])
    assert np.linalg.norm(segments[0, 1] - segments[0, 0]) == pytest.approx(
        np.linalg.norm(on_first - on_last), rel=1e-12
    )
    assert len(find_isolines(corners, corners[..., 0], 1.5)) == 0


@pytest.mark.parametrize(("largest", "highest"), [(1.6, 1.0), (0.4, 0.4)])
def test_isolines_lie_on_the_level_that_they_are_labelled_with(tmp_path, largest, highest):
    """The field, read where a line cuts the sides of its triangles, is the level in the legend.

    Levels are fifths of the limit, or of a round number above a sheet that stays below half of it.
    """
    state = make_state(tmp_path)
    middle = state.cells.nodes[state.triangles].mean(axis=1)
    along = middle @ [1.0, 0.4, 0.2]
    cells = state.final.utilization_cell
    cells[...] = (largest * (along - along.min()) / np.ptp(along)).reshape(cells.shape)
    settings = make_settings({})
    lines = utilization_isolines(make_design_view(state, 5.0, settings.sizing, settings.material))
    assert [level for level, _ in lines] == pytest.approx(highest * np.arange(1, ISOLINES + 1) / 5)
    corners = state.cells.nodes[state.triangles]
    area = cell_area(state)
    values = panel_node_values(state.utilization, state.triangles, state.cell_panel, area)
    for level, segments in lines[:-1]:
        cut = (values > level).any(axis=1) & ~(values > level).all(axis=1)
        assert len(segments) == cut.sum() > 0
        for end in segments.transpose(1, 0, 2):
            up = np.array([0, 0, 50])  # so that no triangle's plane holds the origin
            share = np.linalg.solve((corners[cut] + up).transpose(0, 2, 1), (end + up)[:, :, None])
            found = (share[:, :, 0] * values[cut]).sum(axis=1)
            assert np.allclose(found, level, rtol=1e-9)


def test_node_values_are_area_means_within_a_panel():
    """Two cells of one panel share an edge, a third of another panel does not mix in."""
    triangles = np.array([[0, 1, 2], [1, 3, 2], [1, 4, 3]])
    values, panel, area = np.array([1.0, 4, 100]), np.array([0, 0, 1]), np.array([2.0, 1, 5])
    nodes = panel_node_values(values, triangles, panel, area)
    assert np.allclose(nodes, [[1, 2, 2], [2, 4, 2], [100, 100, 100]])


def test_border_of_a_region():
    """Of four triangles about a point the first two are inside: two spokes part them from the rest.

    The sheet's own border is none, nor is a region that covers everything.
    """
    triangles = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [4, 1, 0]])
    border = find_region_border(triangles, np.array([True, True, False, False]))
    assert border.tolist() == [[0, 1], [0, 3]]
    assert len(find_region_border(triangles, np.ones(4, dtype=bool))) == 0


@pytest.mark.parametrize(
    ("measure", "words"),
    [
        ("panel_mean", "panel mean at most 0.40 (decides); pointwise"),
        ("element_max", "cells at most 0.40 (decides), panel mean at most 0.40; pointwise"),
    ],
)
def test_the_picture_of_utilization_says_which_number_decides(tmp_path, measure, words):
    settings = make_settings({"sizing": {"measure": measure}})
    view = make_design_view(make_state(tmp_path), 5.0, settings.sizing, settings.material)
    assert words in str(specify_utilization(view).caption)
