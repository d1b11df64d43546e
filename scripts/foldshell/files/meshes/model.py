"""What every reader of mesh files hands over, and how it refuses."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


class MeshError(ValueError):
    """What is wrong with a mesh file: place in it, value found, what is allowed; not its name."""


@dataclass(frozen=True)
class Mesh:
    """Vertices (V, 3) and polygons: number k has the corners `corners[starts[k]:starts[k + 1]]`.

    `single` tells that coordinates were stored in single precision, `comments` what the file
    says about itself, `notes` what was left out of it, `unit` the one that it declares, in words.
    """

    vertices: np.ndarray
    starts: np.ndarray
    corners: np.ndarray
    single: bool = False
    comments: str = ""
    notes: tuple[str, ...] = ()
    unit: str = ""

    @property
    def polygons(self) -> int:
        """Number of polygons."""
        return len(self.starts) - 1


def make_mesh(
    vertices: np.ndarray,
    sizes: np.ndarray | Sequence[int],
    corners: np.ndarray | Sequence[int],
    single: bool = False,
    comments: str = "",
    notes: tuple[str, ...] = (),
) -> Mesh:
    """Build a mesh from polygons that have `sizes` (P,) corners each, one after the other.

    Coordinates in the file's unit.
    """
    starts = np.concatenate([[0], np.cumsum(np.asarray(sizes, dtype=np.int64))])
    points = np.asarray(vertices, dtype=float).reshape(-1, 3)
    return Mesh(points, starts, np.asarray(corners, dtype=np.int64), single, comments, notes)


def count(number: int, one: str, many: str = "") -> str:
    """Write `1 face` or `3 faces`."""
    return f"{number} {one if number == 1 else many or one + 's'}"


def check_mesh(mesh: Mesh) -> None:
    """Raise `MeshError` for coordinates that are no numbers and corners that are no vertices."""
    wrong = ~np.isfinite(mesh.vertices).all(axis=1)
    if wrong.any():
        row = int(wrong.argmax())
        value = mesh.vertices[row][~np.isfinite(mesh.vertices[row])][0]
        raise MeshError(
            f"vertex {row + 1}: {value} among its coordinates, which are not finite: "
            "finite numbers are allowed"
        )
    far = np.abs(mesh.vertices).max(initial=0.0)
    if far > 1e9:
        raise MeshError(f"a coordinate of {far:.3g}: at most 1e9 m is allowed")
    sizes = np.diff(mesh.starts)
    if (sizes < 3).any():
        row = int((sizes < 3).argmax())
        raise MeshError(f"face {row + 1}: {sizes[row]} corners: at least 3 are allowed")
    outside = (mesh.corners < 0) | (mesh.corners >= len(mesh.vertices))
    if outside.any():
        place = int(outside.argmax())
        face = int(np.searchsorted(mesh.starts, place, side="right"))
        raise MeshError(
            f"face {face}: vertex {mesh.corners[place]} (counted from 0): must be at least 0 and "
            f"below {len(mesh.vertices)}, the number of vertices"
        )
