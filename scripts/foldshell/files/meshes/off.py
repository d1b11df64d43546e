"""OFF: counts, vertices, faces by vertex numbers."""

from foldshell.files.meshes.model import Mesh, MeshError, make_mesh
from foldshell.files.meshes.words import Line, parse_floats, parse_integers, quote, split_lines

_KEYWORDS = (b"OFF", b"COFF", b"NOFF", b"CNOFF", b"STOFF", b"STCOFF", b"STNOFF", b"STCNOFF")


def parse_off(data: bytes) -> Mesh:
    """Read an OFF file's bytes: colours, normals and texture coordinates are passed over."""
    lines = list(split_lines(data.removeprefix(b"\xef\xbb\xbf")))
    if not lines:
        raise MeshError("the file is empty: 'OFF' and counts are due")
    (vertex_count, face_count), body = _read_counts(lines)
    if len(body) != vertex_count + face_count:
        more = len(body) > vertex_count + face_count
        raise MeshError(
            f"{vertex_count} vertices and {face_count} faces are announced, {len(body)} lines "
            f"follow: {'more than that' if more else 'cut off'}, both must be equal"
        )
    for number, words in body[:vertex_count]:
        if len(words) < 3:
            raise MeshError(f"line {number}: {quote(words)}: 3 coordinates are due")
    vertices = parse_floats([(number, words[:3]) for number, words in body[:vertex_count]])
    sizes, corners = [], []
    for number, words in body[vertex_count:]:
        size = parse_integers(number, words[:1])[0]
        if size < 3 or len(words) < 1 + size:
            raise MeshError(
                f"line {number}: {quote(words)}: a count of at least 3 and as many vertices are due"
            )
        sizes.append(size)
        corners += parse_integers(number, words[1 : 1 + size])
    return make_mesh(vertices, sizes, corners)


def _read_counts(lines: list[Line]) -> tuple[list[int], list[Line]]:
    """Counts of vertices and faces, and the lines after them; the keyword may be left out."""
    number, words = lines[0]
    key = words[0].upper()
    if key in _KEYWORDS:
        if words[1:2] and words[1].upper() == b"BINARY":
            raise MeshError(f"line {number}: binary OFF: text is allowed")
        lines = ([(number, words[1:])] if words[1:] else []) + lines[1:]
    elif key.endswith(b"OFF"):
        raise MeshError(f"line {number}: {quote(key)}: points of three coordinates are allowed")
    elif not key.isdigit():
        raise MeshError(f"line {number}: {quote(words)}: 'OFF' is due, this is another format")
    if not lines or len(lines[0][1]) not in (2, 3):
        raise MeshError("the counts of vertices, faces and edges are missing: cut off")
    counts = parse_integers(*lines[0])[:2]
    if min(counts) < 0:
        raise MeshError(f"line {lines[0][0]}: {counts}: counts of at least 0 are allowed")
    return counts, lines[1:]
