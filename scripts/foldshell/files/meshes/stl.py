"""STL: triangles without shared vertices, as text or binary."""

import numpy as np

from foldshell.files.meshes.model import Mesh, MeshError, count, make_mesh
from foldshell.files.meshes.words import Line, parse_floats, quote, split_lines

_HEADER, _RECORD = 84, 50
_FACET = b"facet normal x y z outer loop vertex x y z vertex x y z vertex x y z endloop endfacet"
_WORDS = _FACET.split()
_NUMBERS = [place for place, word in enumerate(_WORDS) if word in b"xyz"]


def parse_stl(data: bytes) -> Mesh:
    """Read an STL file's bytes. Raises `MeshError`.

    A file is text where it begins with `solid` and goes on with facets; many binary ones begin
    so too, but their size is that of their count.
    """
    told = int.from_bytes(data[80:84], "little") if len(data) >= _HEADER else -1
    if told >= 0 and len(data) == _HEADER + _RECORD * told:
        return _parse_binary(data, told)
    start = data[:1000].removeprefix(b"\xef\xbb\xbf").lstrip().lower()
    if start.startswith(b"solid") and b"\0" not in data[:_HEADER]:
        return _parse_text(data.removeprefix(b"\xef\xbb\xbf"))
    if told < 0:
        raise MeshError(f"{len(data)} bytes: empty or cut off: binary STL begins with 84 bytes")
    held, rest = divmod(len(data) - _HEADER, _RECORD)
    raise MeshError(
        f"the header counts {count(told, 'triangle')}, the file holds {held}"
        f"{f' and {rest} bytes more' if rest else ''}: damaged or cut off, both must be equal"
    )


def _parse_binary(data: bytes, told: int) -> Mesh:
    kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    records = np.frombuffer(data, kind, told, _HEADER)
    vertices = records["corners"].reshape(-1, 3).astype(float)
    comments = data[:80].rstrip(b"\0 ").decode("latin-1")
    return make_mesh(vertices, np.full(told, 3), np.arange(3 * told), True, comments)


def _parse_text(data: bytes) -> Mesh:
    solids, words, places, names = 0, [], [], []
    is_open = False
    for number, line in split_lines(data, b""):
        key = line[0].lower()
        if key in (b"solid", b"endsolid"):
            if (key == b"solid") == is_open:
                raise MeshError(f"line {number}: {quote(line)}: solid and endsolid must alternate")
            is_open = key == b"solid"
            solids += is_open
            names.append(b" ".join(line[1:]).decode("latin-1"))
            continue
        if not is_open:
            raise MeshError(f"line {number}: {quote(line)}: outside of solid and endsolid")
        words += line
        places += [number] * len(line)
    if is_open:
        raise MeshError("the end 'endsolid' is missing: the file is cut off")
    numbers = _pick_numbers(words, places)
    vertices = parse_floats(numbers).reshape(-1, 3)
    total = len(vertices) // 3
    return make_mesh(vertices, np.full(total, 3), np.arange(3 * total), False, "\n".join(names))


def _pick_numbers(words: list[bytes], places: list[int]) -> list[Line]:
    """Check the words of all facets against the grammar; return rows of corner coordinates."""
    size = len(_WORDS)
    for place, word in enumerate(words):
        due = _WORDS[place % size]
        if due not in b"xyz" and word.lower() != due:
            raise MeshError(
                f"line {places[place]}: {quote(word)} where {due.decode()!r} is due: each facet "
                "is a triangle of three vertices"
            )
    if len(words) % size:
        raise MeshError(f"line {places[-1]}: a facet without its end: the file is cut off")
    rows = []
    for start in range(0, len(words), size):
        for first in _NUMBERS[3::3]:  # the normal is not used
            place = start + first
            rows.append((places[place], words[place : place + 3]))
    return rows
