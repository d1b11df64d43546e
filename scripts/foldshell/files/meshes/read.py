"""One reader for mesh files: the list of formats, what is no mesh at all, and the dispatch."""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.files.meshes.library import read_by_library
from foldshell.files.meshes.model import Mesh, MeshError, check_mesh
from foldshell.files.meshes.obj import parse_obj
from foldshell.files.meshes.off import parse_off
from foldshell.files.meshes.ply import parse_ply
from foldshell.files.meshes.stl import parse_stl
from foldshell.files.whole import open_regular

LARGEST_FILE = 500_000_000
_PARSERS: dict[str, Callable[[bytes], Mesh]] = {
    ".stl": parse_stl,
    ".obj": parse_obj,
    ".ply": parse_ply,
    ".off": parse_off,
}
_BY_LIBRARY = (".vtk", ".vtu", ".vtp", ".msh", ".3dm")
FORMATS = (*_PARSERS, *_BY_LIBRARY)
"""Suffixes of all mesh files that can be read, in small letters."""
_MAGIC = (
    (re.compile(rb"ply\s*[\r\n]", re.IGNORECASE), ".ply"),
    (re.compile(rb"(ST)?C?N?OFF\b"), ".off"),
    (re.compile(rb"# vtk DataFile"), ".vtk"),
    (re.compile(rb"\$MeshFormat"), ".msh"),
    (re.compile(rb"solid\b[^\0]*?\n\s*facet\b", re.IGNORECASE), ".stl"),
    (re.compile(rb"<(\?xml|VTKFile)[^\0]{0,900}?UnstructuredGrid"), ".vtu"),
    (re.compile(rb"<(\?xml|VTKFile)[^\0]{0,900}?PolyData"), ".vtp"),
    (re.compile(rb"\s*<(!doctype|html|\?xml)", re.IGNORECASE), "a web page or another XML file"),
    (re.compile(rb"version https://git-lfs"), "a Git LFS pointer, not the file that it stands for"),
    (re.compile(rb"PK\x03\x04"), "a zip archive: unpack it"),
    (re.compile(rb"\x1f\x8b|BZh|\xfd7zXZ"), "a compressed file: unpack it"),
    (re.compile(rb"\xff\xfe|\xfe\xff"), "UTF-16 text: save it as UTF-8"),
    (re.compile(rb"%PDF"), "a PDF document"),
    (re.compile(rb"ISO-10303-21"), "a STEP file: export a mesh"),
    (re.compile(rb"3D Geometry File Format"), ".3dm"),
)


def is_mesh_file(name: str | Path) -> bool:
    """Tell whether a name has the suffix of a mesh file that can be read."""
    return Path(name).suffix.lower() in FORMATS


def read_mesh(path: str | Path, unit: str = "metres", chord: float | None = None) -> Mesh:
    """Read the vertices and polygons of a mesh file, as they stand in it.

    `unit` is the one that the file may declare (metres, millimetres, centimetres, inches, feet),
    empty for any; `Mesh.unit` is the one that it does. `chord` is how far [m] the mesh of a
    NURBS surface may lie from it.

    Raises `InputError` that names the file, the place in it, what stands there and what is
    allowed. A library that crashes, or asks for more time or memory than a mesh needs, is such
    an error too.
    """
    path = Path(path)
    data = _read_bytes(path)
    try:
        _check_magic(data, path.suffix.lower())
        parse = _PARSERS.get(path.suffix.lower())
        mesh = parse(data) if parse else read_by_library(path, unit, chord)
        if not mesh.polygons:
            raise MeshError("holds no faces: 0 triangles, a mesh of faces is needed")
        check_mesh(mesh)
        declared = mesh.unit or _find_unit(mesh.comments)
        if declared and unit and declared != unit:
            raise MeshError(f"the file declares {declared}: {unit} are allowed")
    except MeshError as error:
        raise InputError(f"{path}: {error}") from None
    except (MemoryError, OverflowError):
        raise InputError(
            f"{path}: too large to be read: damaged, or for a larger machine"
        ) from None
    return replace(mesh, unit=declared)


def _read_bytes(path: Path) -> bytes:
    if path.suffix.lower() not in FORMATS:
        raise InputError(f"{path}: suffix {path.suffix!r}: one of {', '.join(FORMATS)} is allowed")
    try:
        with open_regular(path) as stream:
            data = stream.read(LARGEST_FILE + 1)
    except FileNotFoundError:
        raise InputError(f"{path}: no such file: a mesh file is needed") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise InputError(f"{path}: cannot be read: {reason}: a mesh file is needed") from None
    if len(data) > LARGEST_FILE:
        raise InputError(
            f"{path}: more than {LARGEST_FILE / 1e6:.0f} MB: a smaller mesh is allowed"
        )
    if not data.strip(b"\0\r\n\t "):
        raise InputError(f"{path}: the file is empty: a mesh file is needed")
    return data


def _check_magic(data: bytes, suffix: str) -> None:
    """Refuse a file whose first bytes are those of another format than its name says."""
    head = data[:1000].removeprefix(b"\xef\xbb\xbf")
    for pattern, found in _MAGIC:
        if not pattern.match(head):
            continue
        if found == suffix:
            return
        if found not in FORMATS:
            raise MeshError(f"is {found}: a mesh is needed")
        if not (suffix == ".stl" and found == ".off"):  # a binary STL's title may be any text
            raise MeshError(
                f"its content is {found[1:].upper()}, its name says {suffix}: rename it"
            )


_UNITS = {
    "m": "metres", "metre": "metres", "meter": "metres", "mm": "millimetres",
    "millimet": "millimetres", "cm": "centimetres", "centimet": "centimetres",
    "inch": "inches", "feet": "feet", "foot": "feet", "ft": "feet",
}  # fmt: skip
_UNIT = re.compile(r"\bunits?\b\W*(?:in\b|are\b|is\b|of measure\b)?\W*([a-z]+)", re.IGNORECASE)


def _find_unit(comments: str) -> str:
    """Return the unit of the coordinates as a file says it itself, empty where it does not."""
    for match in _UNIT.finditer(comments):
        word = match[1].casefold()
        unit = next((u for key, u in _UNITS.items() if word == key or
                     (len(key) > 3 and word.startswith(key))), None)  # fmt: skip
        if unit:
            return unit
    return ""
