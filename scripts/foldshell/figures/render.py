"""PyVista without a screen: coloured surface, lines and supports to an image array."""

import ctypes
import os
import sys
from collections.abc import Sequence

import numpy as np

from foldshell.figures.camera import Camera
from foldshell.figures.painter import paint_scenes
from foldshell.figures.scene import AMBIENT, DIFFUSE, SUPPORT_COLOUR, Lines, Scene

OPENGL_LIBRARIES = ("libEGL.so.1", "libOSMesa.so.8", "libOSMesa.so")


def render_scenes(
    scenes: Sequence[Scene], cameras: Sequence[Camera], size: tuple[int, int]
) -> list[np.ndarray]:
    """Return an image (height, width, 3) uint8 of each scene.

    Drawn by PyVista in one window of that size, or painted where there is no OpenGL: VTK would
    end the process with a segmentation fault.
    """
    draw = draw_scenes if has_opengl() else paint_scenes
    return draw(scenes, cameras, size)


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
    """Return the images of the scenes as PyVista renders them off-screen."""
    if not os.environ.get("DISPLAY"):
        os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
    import pyvista

    plotter = pyvista.Plotter(off_screen=True, window_size=size, lighting="none")
    plotter.set_background("white")
    plotter.enable_anti_aliasing("msaa", multi_samples=8)
    plotter.add_light(pyvista.Light(light_type="headlight", intensity=1.0))
    try:
        return [_render(plotter, s, c) for s, c in zip(scenes, cameras, strict=True)]
    finally:
        plotter.close()


def _render(plotter, scene: Scene, camera: Camera) -> np.ndarray:
    plotter.suppress_rendering = True  # else each added mesh renders the scene once more
    plotter.clear_actors()
    _add_surface(plotter, scene)
    for lines in scene.lines:
        _add_lines(plotter, lines, camera)
    if scene.supports is not None and len(scene.supports):
        _add_supports(plotter, scene.supports, scene.support_size)
    plotter.camera.position = camera.eye
    plotter.camera.focal_point = camera.focus
    plotter.camera.up = (0, 0, 1)
    plotter.camera.view_angle = np.degrees(camera.view_angle)
    plotter.renderer.ResetCameraClippingRange()
    plotter.suppress_rendering = False
    plotter.render()
    return np.asarray(plotter.screenshot(None, return_img=True))[..., :3]


def _add_surface(plotter, scene: Scene) -> None:
    import pyvista

    surface = pyvista.PolyData.from_regular_faces(scene.points, scene.triangles)
    place = surface.cell_data if len(scene.colours) == len(scene.triangles) else surface.point_data
    place["colour"] = scene.colours
    plotter.add_mesh(
        surface, scalars="colour", rgb=True, ambient=AMBIENT, diffuse=DIFFUSE, specular=0.0,
        smooth_shading=False, show_scalar_bar=False,
    )  # fmt: skip


def _add_lines(plotter, lines: Lines, camera: Camera) -> None:
    import pyvista

    count, length = lines.points.shape[:2]
    if not count:
        return
    points = lines.points.reshape(-1, 3)
    distance = np.linalg.norm(camera.eye - camera.focus)
    points = camera.towards(points, lines.lift * distance)
    numbers = np.arange(count * length).reshape(count, length)
    cells = np.column_stack([np.full(count, length), numbers])
    plotter.add_mesh(
        pyvista.PolyData(points, lines=cells.ravel()),
        color=tuple(c / 255 for c in lines.colour),
        line_width=lines.width,
        lighting=False,
    )


def _add_supports(plotter, points: np.ndarray, size: float) -> None:
    import pyvista

    cone = pyvista.Cone(
        center=(0, 0, -size / 2), direction=(0, 0, 1), height=size, radius=0.45 * size,
        resolution=12,
    )  # fmt: skip
    marks = pyvista.PolyData(points).glyph(geom=cone, scale=False, orient=False)
    plotter.add_mesh(marks, color=tuple(c / 255 for c in SUPPORT_COLOUR), ambient=0.5, diffuse=0.5)
