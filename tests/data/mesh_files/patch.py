"""The surface that every file of the collection holds, before it is spoilt."""

from dataclasses import dataclass

import numpy as np

SPAN, POINTS = 6.0, 9  # m, points along a side


def height(x, y):
    """z(x, y) [m] of the patch: a dome of 0.9 m with a slight skew."""
    return 1.0 - 0.04 * x**2 - 0.06 * y**2 + 0.01 * x * y


@dataclass(frozen=True)
class Patch:
    """Vertices (V, 3) [m] and polygons as lists of vertex numbers."""

    vertices: np.ndarray
    polygons: list[list[int]]

    @property
    def triangles(self) -> int:
        """Number of triangles after its polygons are split."""
        return sum(len(polygon) - 2 for polygon in self.polygons)


def make_patch(sides: int = 3, points: int = POINTS) -> Patch:
    """The patch in triangles (3), quadrilaterals (4) or hexagons of two cells each (6)."""
    along = np.linspace(-SPAN / 2, SPAN / 2, points)
    x, y = (k.ravel() for k in np.meshgrid(along, along, indexing="ij"))
    number = np.arange(points**2).reshape(points, points)
    polygons = []
    for i in range(points - 1):
        for j in range(points - 1):
            a, b, c, d = number[i, j], number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]
            if sides == 3:
                polygons += [[a, b, c], [a, c, d]]
            elif sides == 4:
                polygons.append([a, b, c, d])
            elif j % 2 == 0:
                e, f = number[i + 1, j + 2], number[i, j + 2]
                polygons.append([a, b, c, e, f, d])
    plain = [[int(k) for k in polygon] for polygon in polygons]
    return Patch(np.column_stack([x, y, height(x, y)]), plain)


def change(patch: Patch, vertices: np.ndarray) -> Patch:
    """The same polygons over other vertices."""
    return Patch(vertices, patch.polygons)


def spoil() -> dict[str, tuple[Patch, str]]:
    """Patches that no format can save, and the reason that is due for each."""
    patch = make_patch()
    v, f = patch.vertices, patch.polygons
    up = v[:, [0, 2, 1]]
    radius = np.linalg.norm(v[:, :2], axis=1)
    hole = [p for p in f if radius[p].mean() > 1.2]
    below = np.vstack([v, v - [0, 0, 1.0]])
    count = len(v)
    double = Patch(below, f + [[k + count for k in p] for p in f])
    step = v + np.outer(v[:, 0] > 0.5, [0, 0, 20.0])
    fin = Patch(np.vstack([v, [[0.1, 0.1, 4.0]]]), [*f, [f[60][0], f[60][1], count]])
    return {
        "millimetres": (change(patch, v * 1000), "looks like millimetres"),
        "centimetres": (change(patch, v * 100), "looks like centimetres"),
        "inches": (change(patch, v / 0.0254), "looks like inches"),
        "feet": (change(patch, v / 0.3048), "looks like feet"),
        "small": (change(patch, v * 0.5), "must cover the span of 6 m"),
        "y_up": (change(patch, up), "y seems to be up"),
        "x_up": (change(patch, v[:, [2, 1, 0]]), "x seems to be up"),
        "y_up_millimetres": (change(patch, up * 1000), "y seems to be up.*like millimetres"),
        "hole": (Patch(v, hole), "no surface above"),
        "doubled": (double, "lies over itself"),
        "wall": (change(patch, step), "steeper than 85 deg"),
        "fin": (fin, "three or more triangles"),
        "far_apart": (change(patch, v * 1e12), "at most 1e9 m|must cover"),
        "flat_line": (change(patch, v * [1, 0, 0]), "0 triangles with an area"),
        "closed": (_close(patch), "a closed surface"),
    }


def _close(patch: Patch) -> Patch:
    """The patch with a cone below it that closes it to a body."""
    number = np.arange(POINTS**2).reshape(POINTS, POINTS)
    ring = [*number[:-1, 0], *number[-1, :-1], *number[:0:-1, -1], *number[0, :0:-1]]
    tip = len(patch.vertices)
    cone = [[int(b), int(a), tip] for a, b in zip(ring, [*ring[1:], ring[0]], strict=True)]
    return Patch(np.vstack([patch.vertices, [[0, 0, -2.0]]]), patch.polygons + cone)
