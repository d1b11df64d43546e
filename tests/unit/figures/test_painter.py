"""The painter that stands in where there is no OpenGL: same scene, same picture."""

import ctypes
from functools import partial

import numpy as np
import pytest

from figure_cases import make_state
from foldshell.figures import render
from foldshell.figures.camera import fit_camera
from foldshell.figures.painter import paint_scenes
from foldshell.figures.pictures import specify_planarity, specify_thickness
from foldshell.figures.scene import Lines, Scene
from foldshell.results.design_view import make_design_view
from foldshell.settings.material import Material
from foldshell.settings.sizing import Sizing

SIZE = (480, 330)


def scene_of(folder, spec=specify_thickness):
    """Return the scene of a small folded sheet."""
    view = make_design_view(make_state(folder), 5.0, Sizing(), Material())
    return spec(view).scene


@pytest.mark.skipif(not render.has_opengl(), reason="no OpenGL to compare with")
def test_painter_agrees_with_vtk(tmp_path):
    """Nine of ten pixels of the sheet are alike within 24 of 255; what differs is lines' edges.

    A scene without lines and supports leaves one in fifty: pixels on silhouettes.
    """
    full = scene_of(tmp_path)
    bare = Scene(full.points, full.triangles, full.colours)
    for scene, share in ((full, 0.10), (bare, 0.02)):
        camera = fit_camera(full.points, SIZE[0] / SIZE[1])
        (painted,) = paint_scenes([scene], [camera], SIZE)
        (drawn,) = render.draw_scenes([scene], [camera], SIZE)
        sheet = (drawn < 250).any(axis=-1) | (painted < 250).any(axis=-1)
        apart = np.abs(painted.astype(int) - drawn.astype(int)).max(axis=-1) > 24
        assert sheet.mean() > 0.2
        assert apart[sheet].mean() < share


def test_nearer_triangle_hides_the_farther():
    """Blue before red, whichever stands first in the list."""
    near = np.array([[0.0, 0, 0], [1, 0, 0], [0, 0, 1]])
    far = near + np.array([0, 3, 0])
    colours = np.array([[0, 0, 200], [200, 0, 0]], dtype=np.uint8)
    camera = fit_camera(near, 1.0, (0.0, -1.0, 0.01))
    for order in ([0, 1], [1, 0]):
        corners = np.concatenate([(near, far)[k] for k in order])
        scene = Scene(corners, np.arange(6).reshape(2, 3), colours[order])
        (image,) = paint_scenes([scene], [camera], (100, 100))
        x, y = (np.array([1, -1]) * camera.project(near.mean(axis=0)[None])[0] + 1) * 50
        assert image[int(y), int(x)][2] > 150


def test_line_on_a_surface_is_seen():
    """A line along a diagonal of two triangles is not hidden by either."""
    points = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    line = Lines(points[[0, 2]][None], (0, 0, 0), 4.0)
    scene = Scene(points, np.array([[0, 1, 2], [0, 2, 3]]),
                  np.full((2, 3), 255, dtype=np.uint8), (line,))  # fmt: skip
    camera = fit_camera(points, 1.0, (0.1, 0.1, 1.0))
    (image,) = paint_scenes([scene], [camera], (100, 100))
    (middle,) = (np.array([1, -1]) * camera.project(np.array([[0.5, 0.5, 0]])) + 1) * 50
    assert image[int(middle[1]), int(middle[0])].max() < 60


def test_painter_is_taken_without_a_graphics_library(tmp_path, monkeypatch):
    """No library can be loaded, no screen: the same call paints, and does not touch VTK."""
    calls = []
    monkeypatch.setattr(render, "draw_scenes", partial(pytest.fail, "VTK was asked"))
    monkeypatch.setattr(render, "paint_scenes", lambda *args: calls.append(args) or ["image"])
    monkeypatch.delenv("DISPLAY", raising=False)

    def refuse(name):
        raise OSError(name)

    monkeypatch.setattr(ctypes, "CDLL", refuse)
    scene = scene_of(tmp_path, specify_planarity)
    assert render.render_scenes([scene], [fit_camera(scene.points, 1.0)], (80, 80)) == ["image"]
    assert len(calls) == 1
