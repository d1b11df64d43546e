"""A perspective camera that fits what it looks at into the picture, and where points appear."""

import math
from dataclasses import dataclass

import numpy as np

VIEW_ANGLE_DEG = 22.0
STANDARD_DIRECTION = (-0.55, -0.75, 0.62)
"""From the sheet towards the eye: from the side of low x and y, and from above."""


NEARLY, RIM = 2, 0.05
"""Step of the fit at which the camera hardly moves any more: from then on points are left out that
are further inside the picture than this share of it."""


@dataclass(frozen=True)
class Camera:
    """Eye and focal point (3,) m, z up; `view_angle` rad is that of the picture's height."""

    eye: np.ndarray
    focus: np.ndarray
    view_angle: float

    def axes(self) -> np.ndarray:
        """Return the rows right, up, forward (3, 3)."""
        forward = self.focus - self.eye
        forward = forward / np.linalg.norm(forward)
        right = np.cross(forward, (0.0, 0.0, 1.0))
        right /= np.linalg.norm(right)
        return np.stack([right, np.cross(right, forward), forward])

    def project(self, points: np.ndarray) -> np.ndarray:
        """Return (N, 2): right and up in halves of the picture's height, of points (N, 3).

        Points in m.
        """
        local = (points - self.eye) @ self.axes().T
        return local[:, :2] / local[:, 2:] / math.tan(self.view_angle / 2)

    def towards(self, points: np.ndarray, distance: float) -> np.ndarray:
        """Move points (N, 3) towards the eye; they stay where they are in the picture.

        Points in m.
        """
        ray = self.eye - points
        return points + distance * ray / np.linalg.norm(ray, axis=1, keepdims=True)


def fit_camera(
    points: np.ndarray,
    aspect: float,
    direction: tuple[float, float, float] = STANDARD_DIRECTION,
    margin: float = 0.03,
) -> Camera:
    """Return the camera of a direction whose picture (width / height = aspect) holds all points.

    The eye moves until the projections of points (N, 3) m fill the width or the height but for
    the margin, and lie in the middle.
    """
    away = np.asarray(direction, dtype=float)
    away /= np.linalg.norm(away)
    angle = math.radians(VIEW_ANGLE_DEG)
    focus = (points.max(axis=0) + points.min(axis=0)) / 2
    radius = float(np.linalg.norm(points - focus, axis=1).max())
    distance = radius / math.sin(angle / 2)
    for number in range(30):
        camera = Camera(focus + distance * away, focus, angle)
        seen = camera.project(points)
        low, high = seen.min(axis=0), seen.max(axis=0)
        if number == NEARLY:
            inner = (seen > low + RIM * (high - low)) & (seen < high - RIM * (high - low))
            points = points[~inner.all(axis=1)]
        fill = float(((high - low) / (2 * aspect, 2)).max()) / (1 - 2 * margin)
        shift = (low + high) / 2 * math.tan(angle / 2) * distance
        focus = focus + shift @ camera.axes()[:2]
        distance *= fill
        if abs(fill - 1) < 1e-4 and np.abs(shift).max() < 1e-4 * radius:
            break
    return Camera(focus + distance * away, focus, angle)


def look_at(points: np.ndarray, place: np.ndarray) -> tuple[float, float, float]:
    """Return the standard direction, turned to the corner in plan that is nearest a place (3,).

    Place and points (N, 3) in m.
    """
    middle = (points.max(axis=0) + points.min(axis=0)) / 2
    x, y, z = STANDARD_DIRECTION
    return (
        abs(x) if place[0] > middle[0] else -abs(x),
        abs(y) if place[1] > middle[1] else -abs(y),
        z,
    )
