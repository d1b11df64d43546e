"""Target surfaces z = c + p x2 + q y2 + r x y: closest points, sections, arc lengths."""

from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from foldshell.settings.design import SURFACES

Length = TypeVar("Length", float, np.ndarray)


@dataclass(frozen=True)
class Quadric:
    """z = apex + along_x x2 + along_y y2 + twist x y over a plan of sides along x and y [m].

    The plan is a square of side `span` where there is no `rectangle`; else that is the longer one.
    """

    name: str
    span: float
    height: float
    apex: float
    along_x: float
    along_y: float
    twist: float
    rectangle: tuple[float, float] | None = None

    @property
    def sides(self) -> tuple[float, float]:
        """Sides of the plan along x and y [m]."""
        return self.rectangle or (self.span, self.span)

    @property
    def origin(self) -> tuple[float, float, float]:
        """The middle of the plan stands at 0 [m]."""
        return (0.0, 0.0, 0.0)

    def evaluate_height(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """z(x, y) [m]."""
        return self.apex + self.along_x * x**2 + self.along_y * y**2 + self.twist * x * y

    def find_normals(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Upward unit normals (N, 3)."""
        slope_x, slope_y = self._slopes(x, y)
        normals = np.stack([-slope_x, -slope_y, np.ones_like(slope_x)], axis=-1)
        return normals / np.linalg.norm(normals, axis=-1, keepdims=True)

    def _slopes(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return 2 * self.along_x * x + self.twist * y, 2 * self.along_y * y + self.twist * x

    def find_closest(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """argmin |p - s(x, y)|: closest points (N, 3) [m] and upward unit normals there.

        Newton's method on the plan coordinates from the point's own; where the Hessian is not
        positive definite its Gauss-Newton part stands in. Long steps are halved until the
        distance falls; short ones are taken as they are, since there the distance is flat.
        """
        plan = points[:, :2].copy()
        for _ in range(60):
            step = self._newton_step(points, plan)
            length = np.abs(step).max(axis=1, initial=0.0)
            if length.max(initial=0.0) > 1e-3 * self.span:
                step = self._shorten(points, plan, step, length > 1e-3 * self.span)
            plan = plan + step
            if length.max(initial=0.0) <= 1e-9 * self.span:  # quadratic: the next is round-off
                break
        x, y = plan.T
        return np.column_stack([plan, self.evaluate_height(x, y)]), self.find_normals(x, y)

    def measure_distances(self, points: np.ndarray) -> np.ndarray:
        """n.(x - p(x)): signed distances (N,) [m] of points (N, 3), above positive."""
        closest, normals = self.find_closest(points)
        return np.einsum("ij,ij->i", normals, points - closest)

    def measure_reach(self, points: np.ndarray) -> float:
        """0: the surface has no border, whatever the points (N, 3) [m]."""
        del points
        return 0.0

    def _shorten(
        self, points: np.ndarray, plan: np.ndarray, step: np.ndarray, long: np.ndarray
    ) -> np.ndarray:
        distance = self._squared_distance(points, plan)
        scale = np.ones(len(points))
        for _ in range(20):
            trial = plan + scale[:, None] * step
            worse = long & (self._squared_distance(points, trial) > distance)
            if not worse.any():
                break
            scale[worse] /= 2
        return scale[:, None] * step

    def _squared_distance(self, points: np.ndarray, plan: np.ndarray) -> np.ndarray:
        rise = points[:, 2] - self.evaluate_height(plan[:, 0], plan[:, 1])
        return ((points[:, :2] - plan) ** 2).sum(axis=1) + rise**2

    def _newton_step(self, points: np.ndarray, plan: np.ndarray) -> np.ndarray:
        x, y = plan.T
        slope_x, slope_y = self._slopes(x, y)
        rise = points[:, 2] - self.evaluate_height(x, y)
        force_x = points[:, 0] - x + rise * slope_x
        force_y = points[:, 1] - y + rise * slope_y
        xx = 1 + slope_x**2 - 2 * rise * self.along_x
        yy = 1 + slope_y**2 - 2 * rise * self.along_y
        xy = slope_x * slope_y - rise * self.twist
        weak = (xx <= 0) | (xx * yy - xy**2 <= 1e-3)
        xx = np.where(weak, 1 + slope_x**2, xx)
        yy = np.where(weak, 1 + slope_y**2, yy)
        xy = np.where(weak, slope_x * slope_y, xy)
        determinant = xx * yy - xy**2
        return (
            np.column_stack([(yy * force_x - xy * force_y), (xx * force_y - xy * force_x)])
            / determinant[:, None]
        )

    def section_lengths(self) -> tuple[float, float]:
        """Arc lengths [m] of the central sections y = 0 and x = 0 over the span."""
        x, y = (side / 2 for side in self.sides)
        return 2 * _arc_length(x, self.along_x), 2 * _arc_length(y, self.along_y)

    def walk_section(self, axis: int, arc: np.ndarray) -> np.ndarray:
        """Coordinate (x for axis 0, y for axis 1) at signed arc length from the centre [m]."""
        bend = (self.along_x, self.along_y)[axis]
        coordinate = arc.astype(float)
        for _ in range(60):
            speed = np.sqrt(1 + (2 * bend * coordinate) ** 2)
            step = (_arc_length(coordinate, bend) - arc) / speed
            coordinate = coordinate - step
            if np.abs(step).max(initial=0.0) <= 1e-15 * self.span:
                break
        return coordinate


def _arc_length(x: Length, bend: float) -> Length:
    """Length of z = bend x2 from 0 to x: (x sqrt(1 + k2 x2) + asinh(k x) / k) / 2, k = 2 bend."""
    slope = 2 * bend * x
    if bend == 0:
        return x
    return (x * np.sqrt(1 + slope**2) + np.arcsinh(slope) / (2 * bend)) / 2


def make_quadric(
    name: str, span: float, height: float, sides: tuple[float, float] | None = None
) -> Quadric:
    """Build a target of the study over a square plan, or over a rectangle of two `sides` [m].

    paraboloid: corners at 0, apex `height`; hypar: saddle with total range `height`;
    hypar_twist: the same range, twisted; arch: profile along zig-zags, springings at 0 on the
    strip edges; arch_strip: the other way round.
    """
    if not (span > 0 and height > 0):
        raise ValueError(f"span {span}, height {height}: must be positive")
    if sides is not None:
        span = max(sides)
    x, y = (height / (side / 2) ** 2 for side in sides or (span, span))
    twist = x if sides is None else height / (sides[0] / 2 * sides[1] / 2)
    coefficients = {
        "paraboloid": (height, -x / 2, -y / 2, 0.0),
        "hypar": (height / 2, x / 2, -y / 2, 0.0),
        "hypar_twist": (height / 2, 0.0, 0.0, twist / 2),
        "arch": (height, -x, 0.0, 0.0),
        "arch_strip": (height, 0.0, -y, 0.0),
    }
    if name not in coefficients:
        raise ValueError(f"surface {name!r}: must be one of {', '.join(SURFACES)}")
    return Quadric(name, float(span), float(height), *coefficients[name], sides)
