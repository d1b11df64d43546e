"""Scenes without OpenGL: triangles and lines painted from the farthest to the nearest.

Stands in for VTK on machines without a graphics library. Correct for meshes of small triangles
that do not cut each other, which folded sheets are.
"""

from collections.abc import Sequence

import numpy as np
from PIL import Image, ImageDraw

from foldshell.figures.camera import Camera
from foldshell.figures.scene import AMBIENT, DIFFUSE, LIFT, SUPPORT_COLOUR, Lines, Scene

OVERSAMPLING = 2


def paint_scenes(
    scenes: Sequence[Scene], cameras: Sequence[Camera], size: tuple[int, int]
) -> list[np.ndarray]:
    """Return an image (height, width, 3) uint8 of each scene."""
    return [_paint(s, c, size) for s, c in zip(scenes, cameras, strict=True)]


def _paint(scene: Scene, camera: Camera, size: tuple[int, int]) -> np.ndarray:
    """Collect polygons and lines with their depths, sort, paint, and reduce."""
    large = (OVERSAMPLING * size[0], OVERSAMPLING * size[1])
    picture = Image.new("RGB", large, "white")
    pen = ImageDraw.Draw(picture)
    depths, shapes = _triangles(scene, camera, large)
    step = _cell_size(scene)
    for lines in scene.lines:
        _add(depths, shapes, _segments(lines, camera, large, step))
    _add(depths, shapes, _supports(scene, camera, large))
    for k in np.argsort(-np.array(depths), kind="stable"):
        points, colour, width = shapes[k]
        if width:
            pen.line(points, colour, width)
        else:
            pen.polygon(points, colour)
    return np.asarray(picture.resize(size, Image.Resampling.BOX))


def _add(depths: list, shapes: list, more: tuple[list, list]) -> None:
    depths.extend(more[0])
    shapes.extend(more[1])


def to_pixels(camera: Camera, points: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Return pixel coordinates (N, 2), x to the right and y down, of points (N, 3).

    Points in m.
    """
    half = size[1] / 2
    return camera.project(points) * (half, -half) + (size[0] / 2, half)


def _triangles(scene: Scene, camera: Camera, size: tuple[int, int]) -> tuple[list, list]:
    corner = scene.points[scene.triangles]
    middle = corner.mean(axis=1)
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    ray = camera.eye - middle
    depth = np.linalg.norm(ray, axis=1)
    length = np.linalg.norm(normal, axis=1) * depth
    facing = np.abs(np.einsum("ij,ij->i", normal, ray)) / np.where(length > 0, length, 1)
    own = scene.colours.astype(float)
    if len(own) != len(corner):
        own = own[scene.triangles].mean(axis=1)
    shade = AMBIENT + DIFFUSE * facing
    colours = np.clip(own * shade[:, None], 0, 255).round().astype(int)
    places = to_pixels(camera, scene.points, size)[scene.triangles].reshape(-1, 6)
    shapes = [
        (place, tuple(colour), 0)
        for place, colour in zip(places.tolist(), colours.tolist(), strict=True)
    ]
    return depth.tolist(), shapes


def _cell_size(scene: Scene) -> float:
    """Return the usual length of a triangle's side, m: how far lines come before the surface."""
    corner = scene.points[scene.triangles]
    return float(np.median(np.linalg.norm(corner[:, 1] - corner[:, 0], axis=1)))


def _segments(
    lines: Lines, camera: Camera, size: tuple[int, int], step: float
) -> tuple[list, list]:
    count, length = lines.points.shape[:2]
    if not count:
        return [], []
    points = lines.points.reshape(-1, 3)
    places = to_pixels(camera, points, size).reshape(count, length, 2)
    pairs = np.concatenate([places[:, :-1], places[:, 1:]], axis=2).reshape(-1, 4)
    distance = np.linalg.norm(points - camera.eye, axis=1).reshape(count, length)
    nearer = step * max(1.0, lines.lift / LIFT) if lines.lift > 0 else 0.0
    depth = ((distance[:, :-1] + distance[:, 1:]) / 2).ravel() - nearer
    width = max(1, round(OVERSAMPLING * lines.width * 0.8))
    return depth.tolist(), [(pair, lines.colour, width) for pair in pairs.tolist()]


def _supports(scene: Scene, camera: Camera, size: tuple[int, int]) -> tuple[list, list]:
    if scene.supports is None or not len(scene.supports):
        return [], []
    right = camera.axes()[0] * 0.45 * scene.support_size
    foot = scene.supports - (0, 0, scene.support_size)
    corner = np.stack([scene.supports, foot - right, foot + right], axis=1)
    places = to_pixels(camera, corner.reshape(-1, 3), size).reshape(-1, 6)
    depth = np.linalg.norm(corner.mean(axis=1) - camera.eye, axis=1)
    return depth.tolist(), [(place, SUPPORT_COLOUR, 0) for place in places.tolist()]
