"""Crease patterns drawn as DXF: lines and polylines by layer, or by colour."""

import io
import itertools
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.whole import read_small_file
from foldshell.pattern.line_graph import Lines

LARGEST_FILE = 100_000_000
LAYERS = {"CUT": "B", "BORDER": "B", "BOUNDARY": "B", "OUTLINE": "B", "MOUNTAIN": "M",
          "VALLEY": "V", "FLAT": "F", "FACET": "F"}  # fmt: skip
"""Words in the names of layers."""
COLOURS = {1: "M", 5: "V", 7: "B", 0: "B", 2: "F", 256: "", 8: "F", 9: "F"}
"""AutoCAD colour indices: mountain red, valley blue, border black or white."""
UNITS = {1: "inch", 2: "feet", 4: "mm", 5: "cm", 6: "m"}
_PASSED_OVER = ("TEXT", "MTEXT", "DIMENSION", "HATCH", "POINT", "VIEWPORT", "ATTDEF", "LEADER")


def read_dxf_lines(path: str | Path) -> Lines:
    """Read the straight lines of a DXF drawing's model space, in its $INSUNITS.

    What a line is follows from its layer's name (MOUNTAIN, VALLEY, BORDER or CUT, FLAT), else
    from its colour. Raises `InputError` for curves, blocks, other layers, damaged files.
    """
    document = _open(path)
    segments, letters, passed = [], [], set()
    for entity in document.modelspace():
        kind = entity.dxftype()
        if kind in _PASSED_OVER:
            passed.add(kind)
            continue
        letter = _find_letter(path, document, entity)
        for start, end in _draw(path, entity, kind):
            segments.append((start, end))
            letters.append(letter)
    unit = int(document.header.get("$INSUNITS", 0))
    if unit and unit not in UNITS:
        raise InputError(f"{path}: $INSUNITS: {unit}: one of {sorted(UNITS)} is allowed")
    notes = (f"passed over: {', '.join(sorted(passed))}",) if passed else ()
    whole = np.array(segments, dtype=float).reshape(-1, 2, 2)
    return Lines(whole, np.array(letters, dtype="<U1"), UNITS.get(unit), notes)


def _open(path: str | Path):
    import ezdxf

    data = read_small_file(path, LARGEST_FILE, "a DXF drawing")
    if data.startswith(b"AutoCAD Binary DXF"):
        raise InputError(f"{path}: binary DXF: save it as text")
    if data[:2] == b"AC" and data[2:6].isdigit():
        raise InputError(f"{path}: a DWG file: save it as DXF")
    code = re.search(rb"\$DWGCODEPAGE\s+3\s+ANSI_(\d{3,4})", data)
    new = re.search(rb"\$ACADVER\s+1\s+AC10(2[1-9]|[3-9]\d)", data)
    encoding = "utf-8" if new or not code else f"cp{code[1].decode()}"
    try:
        text = data.decode(encoding, "surrogateescape")
        return ezdxf.read(io.StringIO(text.replace("\r\n", "\n")))
    except Exception as error:  # the reader raises what it likes
        reason = " ".join(str(error).split())[:120] or type(error).__name__
        raise InputError(f"{path}: damaged, cut off or no DXF ({reason})") from None


def _find_letter(path: str | Path, document, entity) -> str:
    name = str(entity.dxf.layer)
    words = re.split(r"[^A-Z]+", name.upper())
    known = [letter for word, letter in LAYERS.items() if word in words or f"{word}S" in words]
    if known:
        return known[0]
    colour = int(entity.dxf.color) if entity.dxf.hasattr("color") else 256
    if colour == 256 and name in document.layers:
        colour = abs(int(document.layers.get(name).color))
    letter = COLOURS.get(colour, "")
    if not letter:
        raise InputError(
            f"{path}: layer {name[:60]!r}, colour {colour}: a layer named "
            f"{', '.join(LAYERS)} or colour 1 (mountain), 5 (valley), 7 (border) is allowed"
        )
    return letter


def _draw(path: str | Path, entity, kind: str) -> Iterator[tuple]:
    if kind == "LINE":
        points, closed = [entity.dxf.start, entity.dxf.end], False
    elif kind == "LWPOLYLINE":
        points, closed = [row[:2] for row in entity.get_points("xyb")], entity.closed
        if any(row[2] for row in entity.get_points("xyb")):
            raise InputError(f"{path}: a polyline with arcs: straight lines are allowed")
    elif kind == "POLYLINE" and not (entity.is_poly_face_mesh or entity.is_polygon_mesh):
        points, closed = list(entity.points()), entity.is_closed
    else:
        raise InputError(f"{path}: {kind}: lines and polylines are allowed, explode blocks")
    flat = []
    for point in points:
        values = [float(k) for k in point]
        if len(values) > 2 and abs(values[2]) > 1e-9 * (abs(values[0]) + abs(values[1]) + 1):
            raise InputError(f"{path}: {kind} at height {values[2]:g}: a flat drawing is allowed")
        flat.append((values[0], values[1]))
    rows = [*flat, flat[0]] if closed and flat else flat
    yield from itertools.pairwise(rows)
