"""FOLD 1.2 files (Demaine, Ku and Lang, A new file standard, 2016): write and read sheets.

The top frame is the flat crease pattern, whose fold angles are the targets that tools fold it to:
those of the rest state. `file_frames` are folded states that inherit it, with the angles that they
have. Edge fold angles are in degrees, valley positive; own keys start with `foldshell:`.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.strict_json import read_json_object
from foldshell.files.whole import Json, write_json
from foldshell.pattern.angles import measure_folds
from foldshell.pattern.grid import Grid, build_grid, remove_creases
from foldshell.pattern.sheet import Frame, Sheet
from foldshell.settings.design import GRID_PATTERNS

REST_TITLE, UNROLLED_TITLE = "rest", "rest, unrolled"


def write_fold(path: str | Path, sheet: Sheet, title: str) -> None:
    """Write a sheet as a FOLD file, whole or not at all."""
    write_json(path, describe_sheet(sheet, title))


def describe_sheet(sheet: Sheet, title: str) -> Json:
    """Build the FOLD dictionary of a sheet."""
    grid = sheet.grid
    rest = [] if sheet.kind in ("smooth", "flat") else [Frame(REST_TITLE, sheet.rest)]
    if sheet.unrolled is not None:
        rest.append(Frame(UNROLLED_TITLE, sheet.unrolled))
    return {
        "file_spec": 1.2,
        "file_creator": "foldshell",
        "file_title": title,
        "file_classes": ["singleModel"],
        "frame_title": "crease pattern",
        "frame_classes": ["creasePattern"],
        "frame_attributes": ["2D", "manifold", "orientable", "nonSelfIntersecting"],
        "frame_unit": "m",
        "vertices_coords": sheet.flat[:, :2].tolist(),
        "edges_vertices": grid.edges.tolist(),
        "edges_assignment": grid.assignments.tolist(),
        "edges_foldAngle": _fold_angles(sheet.rest, grid),
        "faces_vertices": grid.facets.tolist(),
        "foldshell:kind": sheet.kind,
        "foldshell:settings": sheet.settings,
        "foldshell:zigzag": grid.zigzag_index.tolist(),
        "foldshell:strip": grid.strip_index.tolist(),
        "foldshell:panels": grid.quads.tolist(),
        "file_frames": [_describe_frame(frame, grid) for frame in (*rest, *sheet.path)],
    }


def _describe_frame(frame: Frame, grid: Grid) -> Json:
    return {
        "frame_title": frame.title,
        "frame_classes": ["foldedForm"],
        "frame_attributes": ["3D", "manifold", "orientable"],
        "frame_parent": 0,
        "frame_inherit": True,
        "frame_unit": "m",
        "vertices_coords": frame.vertices.tolist(),
        "edges_foldAngle": _fold_angles(frame.vertices, grid),
    }


def _fold_angles(vertices: np.ndarray, grid: Grid) -> list[float | None]:
    """Degrees; the border, which folds nothing, has null as the format asks."""
    degrees = np.degrees(measure_folds(vertices, grid)) + 0.0
    border = grid.assignments == "B"
    return [None if b else float(d) for d, b in zip(degrees, border, strict=True)]


def read_fold(path: str | Path) -> Sheet:
    """Read a FOLD file written by `write_fold`.

    Raises InputError when a field is missing or does not describe a crease grid.
    """
    data = read_json_object(path, "a FOLD 1.2 file")
    grid = _read_grid(path, data)
    flat = _read_vertices(path, data, "vertices_coords", grid)
    frames = tuple(_read_frames(path, data, grid))
    named = {frame.title: frame.vertices for frame in frames}
    return Sheet(
        kind=_read_kind(path, data),
        grid=grid,
        flat=flat,
        rest=named.get(REST_TITLE, flat),
        path=tuple(f for f in frames if f.title not in (REST_TITLE, UNROLLED_TITLE)),
        settings=_read_settings(path, data),
        unrolled=named.get(UNROLLED_TITLE),
    )


def _read_frames(path: str | Path, data: Json, grid: Grid) -> Iterator[Frame]:
    frames = data.get("file_frames", [])
    if not isinstance(frames, list):
        raise InputError(f"{path}: file_frames: {_show(frames)}: a list of frames is needed")
    for k, frame in enumerate(frames, start=1):
        title = frame.get("frame_title", str(k)) if isinstance(frame, dict) else None
        if not isinstance(title, str):
            raise InputError(f"{path}: frame {k}: {_show(frame)}: an object with a title is needed")
        yield Frame(title, _read_vertices(path, frame, f"frame {k}", grid))


def _read_kind(path: str | Path, data: Json) -> str:
    kind = data.get("foldshell:kind", GRID_PATTERNS[0])
    if kind not in GRID_PATTERNS:
        raise InputError(
            f"{path}: foldshell:kind: {_show(kind)}: one of {', '.join(GRID_PATTERNS)}"
        )
    return kind


def _read_settings(path: str | Path, data: Json) -> dict[str, float]:
    settings = data.get("foldshell:settings", {})
    if not isinstance(settings, dict) or not all(
        type(v) in (int, float) for v in settings.values()
    ):
        raise InputError(
            f"{path}: foldshell:settings: {_show(settings)}: numbers by name are needed"
        )
    return settings


def _show(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:60]}..."


def _read_grid(path: str | Path, data: Json) -> Grid:
    zigzag_index, strip_index = (
        _read_integers(path, data, f"foldshell:{name}") for name in ("zigzag", "strip")
    )
    if not (len(zigzag_index) == len(strip_index) > 0):
        raise InputError(
            f"{path}: foldshell:strip: {len(strip_index)} entries: as many as foldshell:zigzag"
        )
    zigzag_count, strip_count = int(zigzag_index.max()) + 1, int(strip_index.max()) + 1
    if min(zigzag_count, strip_count) < 3 or zigzag_count * strip_count != len(zigzag_index):
        raise InputError(
            f"{path}: foldshell:zigzag: {zigzag_count} x {strip_count} polylines and "
            f"{len(zigzag_index)} vertices: at least 3 of each, and as many vertices as crossings"
        )
    grid = build_grid(zigzag_count, strip_count)
    if data.get("foldshell:kind") == "smooth":
        grid = remove_creases(grid)
    expected = {"foldshell:zigzag": grid.zigzag_index, "foldshell:strip": grid.strip_index,
                "edges_vertices": grid.edges, "faces_vertices": grid.facets}  # fmt: skip
    for key, value in expected.items():
        if not np.array_equal(_read_integers(path, data, key), value):
            raise InputError(f"{path}: {key}: not the crease grid that this project writes")
    if data.get("edges_assignment") != grid.assignments.tolist():
        raise InputError(f"{path}: edges_assignment: not those of a Miura-like grid")
    return grid


def _read_integers(path: str | Path, data: Json, key: str) -> np.ndarray:
    if key not in data:
        raise InputError(f"{path}: {key}: missing: a list of integers is needed")
    values = _as_array(data[key], (int,), np.int64)
    if values is None:
        raise InputError(f"{path}: {key}: not integers: a list of integers is needed")
    return values


def _read_vertices(path: str | Path, data: Json, where: str, grid: Grid) -> np.ndarray:
    values = _as_array(data.get("vertices_coords"), (int, float), np.float64)
    if values is None:
        raise InputError(f"{path}: {where}: vertices_coords: rows of 2 or 3 coordinates are needed")
    if (
        values.ndim != 2
        or values.shape[0] != len(grid.zigzag_index)
        or values.shape[1] not in (2, 3)
    ):
        raise InputError(
            f"{path}: {where}: {values.shape}: {len(grid.zigzag_index)} rows of 2 or 3 coordinates"
        )
    if not np.isfinite(values).all():
        raise InputError(f"{path}: {where}: not finite: coordinates must be numbers")
    return np.column_stack([values, np.zeros((len(values), 3 - values.shape[1]))])


def _as_array(value: object, kinds: tuple[type, ...], dtype: type) -> np.ndarray | None:
    """A list, or a list of lists, of numbers of these kinds as an array; None for anything else."""
    rows = value if isinstance(value, list) else None
    if rows is None:
        return None
    flat = [x for row in rows for x in row] if all(isinstance(r, list) for r in rows) else rows
    if not all(type(x) in kinds for x in flat):
        return None
    try:
        return np.array(rows, dtype=dtype)
    except (ValueError, OverflowError):
        return None
