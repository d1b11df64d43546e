"""Wavefront OBJ: vertices and polygons; texture, normals, materials and groups are passed over."""

import re
from dataclasses import dataclass, field

import numpy as np

from foldshell.files.meshes.model import Mesh, MeshError, count, make_mesh
from foldshell.files.meshes.words import Line, parse_floats, parse_integers, quote, split_lines

_PASSED_OVER = (
    b"o g s mtllib usemtl maplib usemap l p bevel c_interp d_interp lod shadow_obj trace_obj "
    b"mg cstype deg bmat step vp ctech stech"
).split()
_FREE_FORM = b"curv curv2 surf parm trim hole scrv sp end con".split()
_CORNER = re.compile(rb"([-+]?\d{1,18})(?:/([-+]?\d{1,18})?)?(?:/([-+]?\d{1,18})?)?")


@dataclass
class _Content:
    """What has been gathered of a file so far; `faces` carries the counts at their place."""

    vertices: list[Line] = field(default_factory=list)
    faces: list[tuple[int, list[bytes], tuple[int, int, int]]] = field(default_factory=list)
    textures: int = 0
    normals: int = 0
    others: dict[bytes, int] = field(default_factory=dict)


def parse_obj(data: bytes) -> Mesh:
    """Read an OBJ file's bytes. Raises `MeshError`."""
    data = data.removeprefix(b"\xef\xbb\xbf")
    content = _gather(_join_lines(data))
    if not content.faces:
        raise MeshError(_say_what_it_holds(content))
    vertices = _read_vertices(content.vertices)
    sizes, corners = _read_faces(content)
    mesh = make_mesh(vertices, sizes, corners, False, _find_comments(data))
    _check_end(data, mesh)
    return mesh


def _join_lines(data: bytes) -> bytes:
    """Join lines that a backslash continues; the lines stay as many, so that numbers are right."""
    text = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    if b"\\\n" not in text:
        return text
    joined = []
    for line in re.split(rb"(?<!\\)\n", text):
        joined.append(line.replace(b"\\\n", b" ") + b"\n" * line.count(b"\\\n"))
    return b"\n".join(joined)


def _gather(data: bytes) -> _Content:
    content = _Content()
    for number, words in split_lines(data):
        key = words[0]
        if key == b"v":
            content.vertices.append((number, words[1:]))
        elif key in (b"f", b"fo"):
            counts = len(content.vertices), content.textures, content.normals
            content.faces.append((number, words[1:], counts))
        elif key == b"vt":
            content.textures += 1
        elif key == b"vn":
            content.normals += 1
        elif key in _FREE_FORM:
            raise MeshError(
                f"line {number}: {quote(words)}: a free-form curve or surface: polygons are "
                "allowed, export a mesh"
            )
        elif key not in _PASSED_OVER:
            raise MeshError(f"line {number}: {quote(words)}: not a keyword of OBJ meshes")
        else:
            content.others[key] = content.others.get(key, 0) + 1
    return content


def _say_what_it_holds(content: _Content) -> str:
    lines, points = content.others.get(b"l", 0), content.others.get(b"p", 0)
    held = [count(lines, "line")] if lines else []
    held += [count(points, "point")] if points else []
    if not content.vertices:
        return "holds no vertices: it has 0 triangles, the file is empty or cut off"
    text = f"holds {count(len(content.vertices), 'vertex', 'vertices')}"
    text += f" and {' and '.join(held)}" if held else ""
    return f"{text}, no faces: 0 triangles, a mesh of faces is needed"


def _read_vertices(lines: list[Line]) -> np.ndarray:
    """Coordinates (V, 3); a weight of 1 or a colour may follow them."""
    for number, words in lines:
        if len(words) not in (3, 4, 6, 7):
            raise MeshError(f"line {number}: {len(words)} numbers of a vertex: 3 are due")
        if len(words) == 4 and parse_floats([(number, words[3:])])[0, 0] != 1:
            raise MeshError(f"line {number}: weight {quote(words[3])}: none, or 1, is allowed")
    return parse_floats([(number, words[:3]) for number, words in lines])


def _read_faces(content: _Content) -> tuple[list[int], list[int]]:
    """Corner counts and corners, counted from 0; numbers below 0 count back from their place."""
    totals = (len(content.vertices), content.textures, content.normals)
    sizes, corners = [], []
    for number, words, counts in content.faces:
        if len(words) < 3:
            raise MeshError(f"line {number}: {quote(words)}: a face of at least 3 corners is due")
        if all(word.isdigit() for word in words):
            found = [value - 1 for value in parse_integers(number, words)]
        else:
            found = [_read_corner(number, word, counts, totals) for word in words]
        if min(found) < 0 or max(found) >= totals[0]:
            wrong = next(k for k in found if not 0 <= k < totals[0])
            raise MeshError(
                f"line {number}: a face with vertex {wrong + 1} ({wrong} counted from 0): 1 to "
                f"{totals[0]} are allowed"
            )
        sizes.append(len(found))
        corners += found
    return sizes, corners


def _read_corner(
    number: int, word: bytes, counts: tuple[int, int, int], totals: tuple[int, int, int]
) -> int:
    match = _CORNER.fullmatch(word)
    if not match:
        raise MeshError(f"line {number}: corner {quote(word)}: numbers such as 3, 3/1/2 or 3//2")
    kinds = ("vertex", "texture vertex", "normal")
    found = []
    for text, so_far, total, kind in zip(match.groups(), counts, totals, kinds, strict=True):
        if not text:
            continue
        value = int(text)
        place = value - 1 if value > 0 else so_far + value
        if value == 0 or not 0 <= place < total:
            allowed = f"1 to {total} are allowed" if total else "the file holds none"
            raise MeshError(f"line {number}: corner {quote(word)}: {kind} {value}: {allowed}")
        found.append(place)
    return found[0]


def _find_comments(data: bytes) -> str:
    return "\n".join(
        line.decode("latin-1") for line in data[:20_000].splitlines() if line.startswith(b"#")
    )


def _check_end(data: bytes, mesh: Mesh) -> None:
    """Refuse a file whose last line is not ended while its last vertices are in no face."""
    unused = len(mesh.vertices) - 1 - int(mesh.corners.max())
    if unused > 0 and not data.endswith((b"\n", b"\r")):
        raise MeshError(
            f"its last line is not ended and no face uses the last "
            f"{count(unused, 'vertex', 'vertices')}: the file seems to be cut off"
        )
