"""What a renderer is given: a coloured surface, lines on it, supports."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from foldshell.figures.camera import Camera

AMBIENT, DIFFUSE = 0.72, 0.32
"""Light from all sides, and from the eye: enough to tell facets apart, too little to mislead."""
SUPPORT_COLOUR = (64, 64, 64)
NEAR = 100.0
"""Distance from the origin, in sizes of the scene, up to which single precision is fine."""
LIFT = 0.0015
"""Lines stand this share of the eye's distance in front of the surface they lie on."""


@dataclass(frozen=True)
class Lines:
    """Polylines (K, n, 3) m of one colour and width (pixels of the final image)."""

    points: np.ndarray
    colour: tuple[int, int, int]
    width: float
    lift: float = LIFT


@dataclass(frozen=True)
class Scene:
    """What is in one picture.

    Attributes
    ----------
    points, triangles : surface (N, 3) m, (C, 3)
    colours : (C, 3) or (N, 3) uint8, of the triangles or of the points
    lines : polylines
    supports : (S, 3) m, points that carry a support mark
    support_size : height of that mark, m
    """

    points: np.ndarray
    triangles: np.ndarray
    colours: np.ndarray
    lines: Sequence[Lines] = field(default_factory=tuple)
    supports: np.ndarray | None = None
    support_size: float = 0.0


def bring_near(scene: Scene, camera: Camera) -> tuple[Scene, Camera]:
    """Move a scene that stands far from the origin, and its camera, to the origin.

    Renderers hold single precision, which has 0.5 m left at the coordinates of a national grid.
    """
    far = np.abs(scene.points).max(initial=0.0)
    if far <= NEAR * np.ptp(scene.points, axis=0).max(initial=0.0):
        return scene, camera
    middle = scene.points.mean(axis=0)
    lines = tuple(replace(line, points=line.points - middle) for line in scene.lines)
    supports = None if scene.supports is None else scene.supports - middle
    moved = replace(scene, points=scene.points - middle, lines=lines, supports=supports)
    return moved, replace(camera, eye=camera.eye - middle, focus=camera.focus - middle)
