"""VTK without a screen: coloured surface, lines and supports to an image array.

PyVista is left out: to import its plotter takes 0.8 s of processor time, to draw all nine pictures
of a design 1.1 s.
"""

import atexit
import ctypes
import os
import sys
from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from PIL import Image

from foldshell.figures.camera import Camera
from foldshell.figures.painter import paint_scenes
from foldshell.figures.scene import AMBIENT, DIFFUSE, SUPPORT_COLOUR, Lines, Scene, bring_near

OPENGL_LIBRARIES = ("libEGL.so.1", "libOSMesa.so.8", "libOSMesa.so")
OVERSAMPLING = 2
"""Pixels drawn for one in the image, each way: half the time of multi-sampling in software."""
CONE_SIDES = 12


def render_scenes(
    scenes: Sequence[Scene], cameras: Sequence[Camera], size: tuple[int, int]
) -> list[np.ndarray]:
    """Return an image (height, width, 3) uint8 of each scene.

    Drawn by VTK in one window, or painted where there is no OpenGL: VTK would end the process with
    a segmentation fault.
    """
    draw = draw_scenes if has_opengl() else paint_scenes
    near = [bring_near(scene, camera) for scene, camera in zip(scenes, cameras, strict=True)]
    return draw([scene for scene, _ in near], [camera for _, camera in near], size)


def has_opengl() -> bool:
    """Tell whether VTK will find a way to render: a screen, EGL or OSMesa (always if not Linux)."""
    if sys.platform != "linux" or os.environ.get("DISPLAY"):
        return True
    for name in OPENGL_LIBRARIES:
        try:
            ctypes.CDLL(name)
        except OSError:
            continue
        return True
    return False


def draw_scenes(
    scenes: Sequence[Scene], cameras: Sequence[Camera], size: tuple[int, int]
) -> list[np.ndarray]:
    """Return the images of the scenes as VTK renders them off-screen.

    Each is (height, width, 3) uint8.
    """
    if not os.environ.get("DISPLAY"):
        os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 - makes the window's class known

    window = _open_window()
    window.SetSize(OVERSAMPLING * size[0], OVERSAMPLING * size[1])
    return [_render(window, s, c) for s, c in zip(scenes, cameras, strict=True)]


@lru_cache(maxsize=1)
def _open_window():
    """Return the window of this process: to set up another takes as long as two pictures."""
    from vtkmodules.vtkRenderingCore import vtkRenderWindow

    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SwapBuffersOff()
    window.SetFrameBlitModeToNoBlit()  # nobody sees it: pixels are read where they are drawn
    atexit.register(window.Finalize)
    return window


def _render(window, scene: Scene, camera: Camera) -> np.ndarray:
    from vtkmodules.vtkRenderingCore import vtkRenderer

    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    renderer.AddActor(_make_surface(scene, camera))
    for lines in scene.lines:
        if len(lines.points):
            renderer.AddActor(_make_lines(lines, camera))
    if scene.supports is not None and len(scene.supports):
        renderer.AddActor(_make_supports(scene.supports, scene.support_size))
    eye = renderer.GetActiveCamera()
    eye.SetPosition(*camera.eye)
    eye.SetFocalPoint(*camera.focus)
    eye.SetViewUp(0.0, 0.0, 1.0)
    eye.SetViewAngle(float(np.degrees(camera.view_angle)))
    renderer.ResetCameraClippingRange()
    window.AddRenderer(renderer)
    window.Render()
    image = _read_pixels(window)
    window.RemoveRenderer(renderer)
    return image


def _read_pixels(window) -> np.ndarray:
    """Return the image (height, width, 3) uint8 of a window, each pixel the mean of its parts."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    width, height = window.GetSize()
    pixels = _hold_pixels()
    window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, pixels)
    parts = vtk_to_numpy(pixels)[: width * height]  # as Pillow holds them: it copies none
    rows = Image.frombuffer("RGBX", (width, height), parts, "raw", "RGBX", 0, 1)
    small = np.asarray(rows.reduce(OVERSAMPLING))
    return np.ascontiguousarray(small[::-1, :, :3])  # VTK begins at the lower left


@lru_cache(maxsize=1)
def _hold_pixels():
    """Return the array of this process that pixels are read into: a new one is cleared first."""
    from vtkmodules.vtkCommonCore import vtkUnsignedCharArray

    return vtkUnsignedCharArray()


def _make_poly_data(points: np.ndarray, cells: np.ndarray, lines: bool = False):
    """Return vtkPolyData of points (N, 3) and triangles (C, 3), or polylines (K, n)."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

    places, faces, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points, dtype=np.float32), deep=1))
    numbers = np.ascontiguousarray(cells.ravel(), dtype=np.int64)
    faces.SetData(cells.shape[1], numpy_to_vtkIdTypeArray(numbers, deep=1))
    data.SetPoints(places)
    (data.SetLines if lines else data.SetPolys)(faces)
    return data


def _make_actor(data, colour: tuple[int, int, int] = (255, 255, 255)):
    """Return an actor whose facets stay flat, and its properties."""
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

    mapper, actor = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputData(data)
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(*(c / 255 for c in colour))
    look.SetInterpolationToFlat()
    look.SetSpecular(0.0)
    return actor, look


def _make_surface(scene: Scene, camera: Camera):
    """Return the surface in colours that are lit already: VTK would do it pixel by pixel."""
    from vtkmodules.util.numpy_support import numpy_to_vtk

    corners = scene.points[scene.triangles].reshape(-1, 3)
    data = _make_poly_data(corners, np.arange(len(corners)).reshape(-1, 3))
    data.GetPointData().SetScalars(numpy_to_vtk(_light(scene, camera), deep=1))
    actor, look = _make_actor(data)
    look.LightingOff()
    return actor


def _light(scene: Scene, camera: Camera) -> np.ndarray:
    """Return the colours (3 C, 3) uint8 of the corners of triangles in light along the view."""
    corner = scene.points[scene.triangles]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    length = np.linalg.norm(normal, axis=1)
    facing = np.abs(normal @ camera.axes()[2]) / np.where(length > 0, length, 1)
    shade = AMBIENT + DIFFUSE * facing
    own = scene.colours
    if len(own) == len(corner):
        lit = np.repeat(own * shade[:, None], 3, axis=0)
    else:
        lit = (own[scene.triangles] * shade[:, None, None]).reshape(-1, 3)
    return np.clip(np.rint(lit), 0, 255).astype(np.uint8)


def _make_lines(lines: Lines, camera: Camera):
    count, length = lines.points.shape[:2]
    distance = float(np.linalg.norm(camera.eye - camera.focus))
    points = camera.towards(lines.points.reshape(-1, 3), lines.lift * distance)
    numbers = np.arange(count * length).reshape(count, length)
    actor, look = _make_actor(_make_poly_data(points, numbers, lines=True), lines.colour)
    look.SetLineWidth(OVERSAMPLING * lines.width)
    look.LightingOff()
    return actor


def _make_supports(points: np.ndarray, size: float):
    """Return cones whose tips are the points (S, 3)."""
    angle = 2 * np.pi * np.arange(CONE_SIDES) / CONE_SIDES
    rim = size * np.stack([0.45 * np.cos(angle), 0.45 * np.sin(angle), 0 * angle - 1], axis=1)
    corners = np.stack([0 * rim, rim, np.roll(rim, -1, axis=0)], axis=1)
    places = (points[:, None, None] + corners).reshape(-1, 3)
    triangles = np.arange(len(places)).reshape(-1, 3)
    actor, look = _make_actor(_make_poly_data(places, triangles), SUPPORT_COLOUR)
    look.SetAmbient(0.5)
    look.SetDiffuse(0.5)
    return actor
