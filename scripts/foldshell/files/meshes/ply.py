"""PLY: elements with properties that the header announces, as text or binary."""

import numpy as np

from foldshell.files.meshes.model import Mesh, MeshError, count, make_mesh
from foldshell.files.meshes.ply_header import Element, Header, read_header
from foldshell.files.meshes.words import Line, parse_floats, parse_integers, quote, split_lines

_CORNERS = ("vertex_indices", "vertex_index")
Columns = dict[str, np.ndarray | list[np.ndarray]]
"""Values of an element by property: (N,), or N arrays for a list."""


def parse_ply(data: bytes) -> Mesh:
    """Read a PLY file's bytes. Raises `MeshError`."""
    header = read_header(data)
    names = [element.name for element in header.elements]
    if "vertex" not in names:
        raise MeshError("header: no element 'vertex': the file holds no vertices")
    read = _read_binary if header.order else _read_text
    values = read(data, header)
    vertex = header.elements[names.index("vertex")]
    points = _pick_points(vertex, values["vertex"])
    single = bool(header.order) and any(
        p.kind == "f4" for p in vertex.properties if p.name in "xyz"
    )
    sizes, corners = _pick_corners(header, values)
    if not len(sizes):
        held = count(vertex.count, "vertex", "vertices")
        others = [f"{e.count} of {e.name!r}" for e in header.elements if e.name not in _KNOWN]
        more = f" and {', '.join(others)}" if others else ""
        raise MeshError(f"holds {held}{more}, no faces: 0 triangles, a mesh of faces is needed")
    return make_mesh(points, sizes, corners, single, header.comments)


_KNOWN = ("vertex", "face", "tristrips")


def _read_text(data: bytes, header: Header) -> dict[str, Columns]:
    lines = [
        (number + header.lines, words)
        for number, words in split_lines(data[header.size :], b"")
        if words[0] != b"comment"
    ]
    due = sum(element.count for element in header.elements)
    if len(lines) != due:
        more = len(lines) > due
        raise MeshError(
            f"the header announces {due} lines, {len(lines)} follow: "
            f"{'more than that' if more else 'cut off'}, both must be equal"
        )
    values, first = {}, 0
    for element in header.elements:
        rows = lines[first : first + element.count]
        first += element.count
        values[element.name] = _read_text_rows(element, rows)
    return values


def _read_text_rows(element: Element, rows: list[Line]) -> Columns:
    if not element.lists:
        due = len(element.properties)
        for number, words in rows:
            if len(words) != due:
                raise MeshError(f"line {number}: {len(words)} values of {element.name}: {due} due")
        table = parse_floats(rows).reshape(-1, due) if rows else np.empty((0, due))
        return {prop.name: table[:, k] for k, prop in enumerate(element.properties)}
    columns: dict[str, list] = {prop.name: [] for prop in element.properties}
    for number, words in rows:
        place = 0
        for prop in element.properties:
            size = 1
            if prop.counted_by:
                size, place = (
                    parse_integers(number, words[place : place + 1] or [b""])[0],
                    place + 1,
                )
            part = words[place : place + size]
            if size < 0 or len(part) != size:
                raise MeshError(f"line {number}: {quote(words)}: as many values as counted are due")
            is_whole = prop.kind[0] != "f"
            read = parse_integers(number, part) if is_whole else parse_floats([(number, part)])
            columns[prop.name].append(np.asarray(read).ravel())
            place += size
        if place != len(words):
            raise MeshError(f"line {number}: {quote(words)}: more values than the header tells")
    return columns


def _read_binary(data: bytes, header: Header) -> dict[str, Columns]:
    values, place = {}, header.size
    for element in header.elements:
        read = _read_records(data, place, element, header.order)
        if read is None:
            read = _read_ragged(data, place, element, header.order)
        values[element.name], place = read
    rest = data[place:]
    if rest.strip(b"\r\n\0"):
        raise MeshError(
            f"{len(rest)} bytes follow what the header announces: damaged, both must agree"
        )
    return values


def _read_records(data: bytes, place: int, element: Element, order: str) -> tuple | None:
    """Read an element whose records are all as long as the first; None if they are not."""
    parts, at = [], place
    for k, prop in enumerate(element.properties):
        size: tuple[int, ...] = ()
        if prop.counted_by:
            counter = np.dtype(order + prop.counted_by)
            if not element.count:
                return {p.name: [] for p in element.properties}, place
            _check_room(data, at, counter.itemsize, element, 0)
            number = int(np.frombuffer(data, counter, 1, at)[0])
            _check_room(data, at, number if number > 0 else 0, element, 0)
            parts.append((f"count {k}", counter))
            at += counter.itemsize
            size = (max(number, 0),)
        parts.append((f"value {k}", np.dtype(order + prop.kind), size))
        at += np.dtype(prop.kind).itemsize * (size[0] if size else 1)
    kind = np.dtype(parts)
    held = (len(data) - place) // kind.itemsize if kind.itemsize else element.count
    if held < element.count:
        if element.lists:
            return None
        _check_room(data, place, kind.itemsize * element.count, element, held)
    table = np.frombuffer(data, kind, element.count, place) if kind.itemsize else None
    columns: Columns = {}
    for k, prop in enumerate(element.properties):
        if prop.counted_by and (table[f"count {k}"] != table[f"count {k}"][0]).any():
            return None
        columns[prop.name] = table[f"value {k}"]
    return columns, place + kind.itemsize * element.count


def _check_room(data: bytes, place: int, size: int, element: Element, done: int) -> None:
    if place + size > len(data):
        raise MeshError(
            f"{count(element.count, 'element')} {element.name!r} announced, the file ends after "
            f"{done}: cut off, both must be equal"
        )


def _read_ragged(data: bytes, place: int, element: Element, order: str) -> tuple[Columns, int]:
    """Read an element record by record, as its lists differ in length."""
    columns: dict[str, list] = {prop.name: [] for prop in element.properties}
    kinds = [
        (
            prop.name,
            np.dtype(order + prop.kind),
            prop.counted_by and np.dtype(order + prop.counted_by),
        )
        for prop in element.properties
    ]
    for done in range(element.count):
        for name, kind, counter in kinds:
            size = 1
            if counter:
                _check_room(data, place, counter.itemsize, element, done)
                size = int(np.frombuffer(data, counter, 1, place)[0])
                place += counter.itemsize
                if size < 0:
                    raise MeshError(f"{element.name} {done + 1}: a list of {size} values")
            _check_room(data, place, size * kind.itemsize, element, done)
            columns[name].append(np.frombuffer(data, kind, size, place))
            place += size * kind.itemsize
    return columns, place


def _pick_points(vertex: Element, values: Columns) -> np.ndarray:
    names = [prop.name for prop in vertex.properties]
    for axis in "xyz":
        if axis not in names or vertex.properties[names.index(axis)].counted_by:
            raise MeshError(f"header: vertex: the property {axis!r} is missing")
    points = [np.asarray(values[axis], dtype=float).ravel() for axis in "xyz"]
    return np.column_stack(points)


def _pick_corners(header: Header, values: dict[str, Columns]) -> tuple[np.ndarray, np.ndarray]:
    sizes, corners = [np.empty(0, dtype=np.int64)], [np.empty(0, dtype=np.int64)]
    for element in header.elements:
        if element.name not in ("face", "tristrips") or not element.count:
            continue
        names = [p.name for p in element.properties if p.counted_by and p.kind[0] != "f"]
        wanted = next((name for name in _CORNERS if name in names), None)
        if wanted is None:
            raise MeshError(f"header: {element.name}: the list 'vertex_indices' is missing")
        rows = values[element.name][wanted]
        if element.name == "tristrips":
            rows = [triangle for row in rows for triangle in _split_strip(row)]
        if isinstance(rows, np.ndarray):
            sizes.append(np.full(len(rows), rows.shape[1]))
            corners.append(rows.astype(np.int64).ravel())
        elif rows:
            sizes.append(np.array([len(row) for row in rows]))
            corners.append(np.concatenate(rows).astype(np.int64))
    return np.concatenate(sizes), np.concatenate(corners)


def _split_strip(strip: np.ndarray) -> list[np.ndarray]:
    """Triangles of strips of vertices, one after the other, that -1 ends."""
    triangles = []
    ends = [*np.flatnonzero(strip == -1), len(strip)]
    for start, end in zip([0, *(k + 1 for k in ends[:-1])], ends, strict=True):
        part = strip[start:end]
        for k in range(len(part) - 2):
            triangles.append(part[[k, k + 1, k + 2]] if k % 2 == 0 else part[[k + 1, k, k + 2]])
    return triangles
