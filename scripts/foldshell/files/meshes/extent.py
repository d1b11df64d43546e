"""How large a folded sheet in a file is, before anything is made of it."""

from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.meshes.read import read_mesh
from foldshell.files.strict_json import read_json_object
from foldshell.files.units import (
    FACTORS,
    WORDS,
    agree_on_unit,
    find_factor,
    find_fold_unit,
    name_unit,
)

SMALLEST, LARGEST = 0.1, 500.0  # m, of the sides of a plan
PLAUSIBLE = (2.0, 200.0)  # m, of the side of a building: for a message only
UNITS = ("m", "mm", "cm", "feet", "inch")


def measure_extent(path: str | Path, file_unit: str) -> np.ndarray:
    """Return the extents (3,) m along x, y and z of a mesh file or of the last folded FOLD frame.

    `file_unit` is that of the coordinates. Raises `InputError`.
    """
    if Path(path).suffix.lower() == ".fold":
        points, declared = _read_last_frame(path)
        factor = agree_on_unit(path, declared, file_unit)
    else:
        mesh = read_mesh(path, name_unit(file_unit))
        points, factor = mesh.vertices[np.unique(mesh.corners)], find_factor(mesh.unit, file_unit)
    size = factor * np.ptp(points, axis=0)
    if not size[:2].min() > 0:
        raise InputError(f"{path}: plan of {size[0]:g} x {size[1]:g} m: a sheet with a plan is due")
    side = float(size[:2].min())
    if not SMALLEST <= side <= LARGEST:
        looks = next(
            (f"; it looks like {WORDS[unit]}" for unit in UNITS
             if PLAUSIBLE[0] <= side / factor * FACTORS[unit] <= PLAUSIBLE[1]), "",
        )  # fmt: skip
        raise InputError(
            f"{path}: plan of {size[0]:.5g} x {size[1]:.5g} m: sides of {SMALLEST:g} to "
            f"{LARGEST:g} are allowed{looks}, say so by file_unit"
        )
    return size


def _read_last_frame(path: str | Path) -> tuple[np.ndarray, str | None]:
    data = read_json_object(path, "a FOLD file")
    frames = data.get("file_frames") if isinstance(data.get("file_frames"), list) else []
    for frame in (*reversed(frames), data):
        rows = frame.get("vertices_coords") if isinstance(frame, dict) else None
        try:
            points = np.array(rows, dtype=float)
        except (TypeError, ValueError):
            continue
        solid = points.ndim == 2 and points.shape[1] == 3 and np.isfinite(points).all()
        if solid and np.ptp(points, axis=0).min() > 0:
            return points, find_fold_unit(path, data)
    raise InputError(f"{path}: vertices_coords: no frame of a folded sheet, in three dimensions")
