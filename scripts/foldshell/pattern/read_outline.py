"""Files of outlines: lists of points, GeoJSON, and closed lines of DXF and SVG drawings."""

import json
import re
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.meshes.triangles import group_near
from foldshell.files.units import agree_on_unit
from foldshell.files.whole import read_small_file
from foldshell.pattern.line_graph import Lines
from foldshell.pattern.read_dxf import read_dxf_lines
from foldshell.pattern.read_svg import read_svg_lines

LARGEST_FILE = 10_000_000
NEAR = 1e-6
"""Ends of drawn lines nearer than this, of the drawing's size, are one."""


def read_outline_file(path: str | Path, file_unit: str, notes: list[str]) -> list[np.ndarray]:
    """Return the polygons (K, 2) m of a file; `notes` gathers what was passed over.

    Raises `InputError`.
    """
    if not Path(path).is_file():
        raise InputError(f"{path}: no such file")
    suffix, unit = Path(path).suffix.lower(), None
    if suffix in (".dxf", ".svg"):
        lines = (read_dxf_lines if suffix == ".dxf" else read_svg_lines)(path)
        loops, unit = chain_lines(path, lines), lines.unit
        notes += [f"{path}: {note}" for note in lines.notes]
    elif suffix in (".json", ".geojson"):
        loops = _read_rings(path)
    else:
        loops = _read_points(path)
    factor = agree_on_unit(path, unit, file_unit)
    return [factor * loop for loop in loops]


def _read_points(path: str | Path) -> list[np.ndarray]:
    """Polygons of a text: x and y on a line, an empty line between two polygons."""
    data = read_small_file(path, LARGEST_FILE, "a list of points")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(f"{path}: no text in UTF-8") from None
    loops: list[list[list[float]]] = [[]]
    for number, line in enumerate(text.splitlines(), 1):
        words = re.split(r"[\s,;]+", line.split("#")[0].strip())
        if words == [""]:
            loops.append([])
            continue
        if number == 1 and [word.strip('"').lower()[:1] for word in words[:2]] == ["x", "y"]:
            continue  # a header
        try:
            row = [float(word) for word in words]
        except ValueError:
            words = f"line {number}: {line.strip()[:60]!r}"
            raise InputError(f"{path}: {words}: x and y are allowed") from None
        if len(row) == 3 and row[2] == 0:
            row = row[:2]
        if len(row) != 2:
            raise InputError(f"{path}: line {number}: {len(row)} numbers: x and y are allowed")
        loops[-1].append(row)
    return [np.array(loop) for loop in loops if loop]


def _read_rings(path: str | Path) -> list[np.ndarray]:
    """Polygons of GeoJSON, or of a plain list of points or of such lists."""
    raw = read_small_file(path, LARGEST_FILE, "a file of polygons")
    try:
        data = json.loads(raw.decode("utf-8-sig"))
    except (ValueError, RecursionError):
        raise InputError(f"{path}: no JSON") from None
    return [_make_ring(path, ring) for ring in _find_rings(path, data)]


def _find_rings(path: str | Path, data: object) -> list[object]:
    if isinstance(data, dict):
        kind = data.get("type")
        if kind == "FeatureCollection" and isinstance(data.get("features"), list):
            return [ring for one in data["features"] for ring in _find_rings(path, one)]
        if kind == "Feature":
            return _find_rings(path, data.get("geometry"))
        if kind == "Polygon" and isinstance(data.get("coordinates"), list):
            return list(data["coordinates"])
        if kind == "MultiPolygon" and isinstance(data.get("coordinates"), list):
            return [ring for polygon in data["coordinates"] for ring in polygon]
        raise InputError(f"{path}: type {kind!r}: Polygon, MultiPolygon or a Feature is allowed")
    if not isinstance(data, list) or not data:
        raise InputError(f"{path}: a list of points or GeoJSON is allowed")
    first = data[0]
    nested = isinstance(first, list) and first and isinstance(first[0], list)
    return data if nested else [data]


def _make_ring(path: str | Path, ring: object) -> np.ndarray:
    try:
        points = np.array(ring, dtype=float)
    except (TypeError, ValueError):
        points = np.empty(0)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise InputError(f"{path}: a polygon of points with x and y is allowed")
    return points[:, :2]


def chain_lines(path: str | Path, lines: Lines) -> list[np.ndarray]:
    """Return the closed rings (K, 2) of drawn lines, in the drawing's unit.

    Raises `InputError` where a line ends by itself or more than two meet.
    """
    segments = lines.segments
    if not len(segments):
        raise InputError(f"{path}: holds no line")
    ends = np.column_stack([segments.reshape(-1, 2), np.zeros(2 * len(segments))])
    size = np.ptp(ends, axis=0).max()
    label = group_near(ends, NEAR * size).reshape(-1, 2)
    beside: dict[int, list[int]] = {}
    for a, b in label[label[:, 0] != label[:, 1]].tolist():
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    for corner, others in beside.items():
        if len(others) != 2:
            x, y = ends[corner, :2]
            words = "ends by itself" if len(others) == 1 else f"{len(others)} lines meet"
            raise InputError(
                f"{path}: a line {words} at ({x:g}, {y:g}): closed polygons that do not touch are "
                "allowed"
            )
    loops = []
    while beside:
        start, (at, _) = next(iter(beside.items()))
        ring, before = [start], start
        while at != start:
            ring.append(at)
            one, two = beside[at]
            before, at = at, two if one == before else one
        for corner in ring:
            del beside[corner]
        loops.append(ends[ring, :2])
    return loops
