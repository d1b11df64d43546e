"""A folded plate roof of hexagons and triangles, written in the formats that such files come in."""

from pathlib import Path

import numpy as np

FOLDS, WIDTH, LENGTH, RISE, HIP = 3, 3.6, 14.0, 1.3, 2.2


def make_roof() -> tuple[np.ndarray, list[list[int]]]:
    """Vertices (V, 3) m and panels: ridges with hips at both ends, valleys at height 0.

    Each fold has two hexagons, whose valley side passes two vertices, and two hip triangles.
    """
    number: dict[tuple[float, float, float], int] = {}

    def at(x: float, y: float, z: float) -> int:
        return number.setdefault((round(x, 9), round(y, 9), round(z, 9)), len(number))

    panels = []
    inner = [LENGTH / 3, 2 * LENGTH / 3]
    for k in range(FOLDS):
        left, right, middle = k * WIDTH, (k + 1) * WIDTH, (k + 0.5) * WIDTH
        ends = [at(middle, HIP, RISE), at(middle, LENGTH - HIP, RISE)]
        valleys = [[at(x, y, 0) for y in (0, *inner, LENGTH)] for x in (left, right)]
        panels += [
            [valleys[0][0], valleys[1][0], ends[0]],
            [*valleys[1], ends[1], ends[0]],
            [valleys[1][3], valleys[0][3], ends[1]],
            [*reversed(valleys[0]), ends[0], ends[1]],
        ]
    return np.array(list(number)), panels


def write_obj(path: Path, vertices: np.ndarray, panels: list[list[int]]) -> Path:
    """Write an OBJ file with all digits."""
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices.tolist()]
    lines += ["f " + " ".join(str(k + 1) for k in panel) for panel in panels]
    path.write_text("\n".join(lines) + "\n")
    return path


def write_stl(path: Path, vertices: np.ndarray, triangles: np.ndarray) -> Path:
    """Write a binary STL file: single precision, no shared vertices."""
    corners = vertices[triangles].astype("<f4")
    record = np.zeros(len(triangles), dtype=[("n", "<3f4"), ("p", "<9f4"), ("a", "<u2")])
    record["p"] = corners.reshape(-1, 9)
    path.write_bytes(bytes(80) + np.uint32(len(triangles)).tobytes() + record.tobytes())
    return path
