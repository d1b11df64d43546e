"""The header of a PLY file: its elements and their properties."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from foldshell.files.meshes.model import MeshError
from foldshell.files.meshes.words import parse_integers, quote

_TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4",
    "float": "f4", "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2",
    "int32": "i4", "uint32": "u4", "int64": "i8", "uint64": "u8", "float32": "f4", "float64": "f8",
}  # fmt: skip
_FORMATS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_LONGEST_HEADER = 100_000


@dataclass(frozen=True)
class Property:
    """A property of an element: type of its values, and of their count where it is a list."""

    name: str
    kind: str
    counted_by: str = ""


@dataclass
class Element:
    """An element of the header."""

    name: str
    count: int
    properties: list[Property] = field(default_factory=list)

    @property
    def lists(self) -> bool:
        """Whether any property is a list."""
        return any(prop.counted_by for prop in self.properties)


@dataclass(frozen=True)
class Header:
    """What a header tells."""

    order: str  # "" for text, else the byte order
    elements: list[Element]
    comments: str
    size: int  # bytes up to the body
    lines: int


def read_header(data: bytes) -> Header:
    """Read the lines up to `end_header`. Raises `MeshError`."""
    data = data[:_LONGEST_HEADER]
    if data[:3].lower() != b"ply":
        raise MeshError("does not begin with 'ply': damaged, empty or another format")
    order, elements, comments, number, place = None, [], [], 0, 0
    while True:
        number += 1
        line, place = _next_line(data, place)
        words = line.decode("latin-1").split()
        key = words[0].lower() if words else ""
        if key == "end_header":
            break
        if key == "format" and len(words) == 3:
            order = _FORMATS.get(words[1].lower())
            if order is None:
                raise MeshError(f"line {number}: {quote(line)}: one of {', '.join(_FORMATS)}")
        elif key == "element" and len(words) == 3:
            size = parse_integers(number, [words[2].encode()])[0]
            if size < 0:
                raise MeshError(f"line {number}: {quote(line)}: a count of at least 0 is allowed")
            if words[1] in [element.name for element in elements]:
                raise MeshError(f"line {number}: {quote(line)}: the element stands twice")
            elements.append(Element(words[1], size))
        elif key == "property" and elements:
            elements[-1].properties.append(_read_property(number, words))
        elif key in ("comment", "obj_info"):
            comments.append(" ".join(words[1:]))
        elif number > 1 and words:
            raise MeshError(f"line {number}: {quote(line)}: not a line of a PLY header")
    if order is None:
        raise MeshError("header: the line 'format' is missing")
    for element in elements:
        names = [prop.name for prop in element.properties]
        if len(set(names)) < len(names) or (element.count and not names):
            raise MeshError(f"header: {element.name}: properties with names of their own are due")
    return Header(order, elements, "\n".join(comments), place, number)


def _next_line(data: bytes, start: int) -> tuple[bytes, int]:
    """A line of the header and where the next one begins; lines end with LF, CR LF or CR."""
    ends = [end for end in (data.find(b"\n", start), data.find(b"\r", start)) if end >= 0]
    if not ends:
        raise MeshError("the header has no 'end_header': damaged or cut off")
    end = min(ends)
    return data[start:end], end + (2 if data[end : end + 2] == b"\r\n" else 1)


def _read_property(number: int, words: Sequence[str]) -> Property:
    kinds = [_TYPES.get(word.lower()) for word in words[1:-1]]
    if len(words) == 3 and kinds[0]:
        return Property(words[2], kinds[0])
    if len(words) == 5 and words[1] == "list" and kinds[1] and kinds[2] and kinds[1][0] != "f":
        return Property(words[4], kinds[2], kinds[1])
    raise MeshError(f"line {number}: {' '.join(words)[:60]!r}: not a property of PLY")
