"""Read .vtk, .vtu, .vtp, .msh and .3dm by libraries, in a process of its own that may crash.

`python child.py FILE OUT UNIT`: writes the mesh to OUT (npz) and ends with 0, or prints a sentence
and ends with REFUSED. Imports nothing of this project, so that it starts alone.
"""

import contextlib
import re
import sys
from pathlib import Path

import numpy as np

REFUSED = 3
MEMORY = 6_000_000_000
"""Bytes of address space that reading may take."""
_FLAT_CELLS = {5: "triangle", 6: "strip", 7: "polygon", 8: "pixel", 9: "quad"}
_PASSED_OVER = {0, 1, 2, 3, 4, 21, 35, 68}  # empty, points and lines
_GMSH_FLAT = {"triangle": 3, "quad": 4}


class Refused(ValueError):
    """A file that cannot be used, and why."""


def read_vtk(path: str) -> dict:
    """Read legacy VTK, vtu or vtp: vertices, starts and corners of the polygons."""
    from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

    window = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(window)
    reader = _make_reader(Path(path).suffix.lower())
    reader.SetFileName(path)
    reader.Update()
    said = window.GetOutput() or ""
    said = said.decode("latin-1") if isinstance(said, bytes) else said
    if re.search(r"\bERR(OR)?\b", said) or reader.GetErrorCode():
        raise Refused(f"damaged, empty or cut off: VTK says {_shorten(said)!r}")
    data = reader.GetOutputDataObject(0)
    if data is None or not hasattr(data, "GetPoints"):
        name = data.GetClassName() if data is not None else "nothing"
        raise Refused(f"holds {name}: a mesh of polygons is needed")
    points = data.GetPoints()
    sizes, corners = _collect_cells(data)
    vertices = _as_array(points.GetData()) if points else np.empty((0, 3))
    _check_announced(path, len(vertices), data.GetNumberOfCells())
    return {"vertices": vertices, "sizes": sizes, "corners": corners}


def _make_reader(suffix: str):
    if suffix == ".vtk":
        from vtkmodules.vtkIOLegacy import vtkGenericDataObjectReader

        return vtkGenericDataObjectReader()
    from vtkmodules import vtkIOXML

    kinds = {".vtu": vtkIOXML.vtkXMLUnstructuredGridReader, ".vtp": vtkIOXML.vtkXMLPolyDataReader}
    return kinds[suffix]()


def _shorten(said: str) -> str:
    """The first thing that VTK says, without where in its source it says so."""
    first = next((line.partition("): ")[2] for line in said.splitlines() if "): " in line), said)
    return " ".join(re.sub(r" for file: .*", "", first).split())[:120]


def _as_array(data) -> np.ndarray:
    from vtkmodules.util.numpy_support import vtk_to_numpy

    return vtk_to_numpy(data)


def _collect_cells(data) -> tuple[np.ndarray, np.ndarray]:
    """Corner counts (P,) and corners of all polygons, whatever kind of data set holds them."""
    if data.IsA("vtkPolyData"):
        sizes, corners = _split(data.GetPolys(), data.GetNumberOfPoints())
        strips = _split(data.GetStrips(), data.GetNumberOfPoints())
        more = _split_strips(*strips)
        return np.concatenate([sizes, more[0]]), np.concatenate([corners, more[1]])
    if data.IsA("vtkUnstructuredGrid"):
        return _collect_grid(data)
    if data.IsA("vtkStructuredGrid"):
        dimensions = [0, 0, 0]
        data.GetDimensions(dimensions)
        return _collect_structured(dimensions)
    raise Refused(f"holds a {data.GetClassName()}: a mesh of polygons is needed")


def _split(cells, points: int) -> tuple[np.ndarray, np.ndarray]:
    if cells is None or not cells.GetNumberOfCells():
        return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
    offsets = _as_array(cells.GetOffsetsArray()).astype(np.int64)
    corners = _as_array(cells.GetConnectivityArray()).astype(np.int64)
    sizes = np.diff(offsets)
    if (sizes < 0).any() or offsets[0] != 0 or offsets[-1] != len(corners):
        raise Refused("offsets of the cells do not fit their corners: damaged")
    outside = (corners < 0) | (corners >= points)
    if outside.any():
        wrong = corners[outside][0]
        raise Refused(f"a cell of vertex {wrong} (counted from 0): must be below {points}")
    return sizes, corners


def _split_strips(sizes: np.ndarray, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    triangles = []
    for start, size in zip(np.cumsum(sizes) - sizes, sizes, strict=True):
        for k in range(start, start + size - 2):
            order = [k, k + 1, k + 2] if (k - start) % 2 == 0 else [k + 1, k, k + 2]
            triangles.append(corners[order])
    flat = np.concatenate(triangles) if triangles else np.empty(0, dtype=np.int64)
    return np.full(len(triangles), 3), flat


def _collect_grid(data) -> tuple[np.ndarray, np.ndarray]:
    if not data.GetNumberOfCells():
        return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
    kinds = _as_array(data.GetCellTypesArray() if hasattr(data, "GetCellTypesArray") else
                      data.GetCellTypes())  # fmt: skip
    strange = [int(k) for k in np.unique(kinds) if k not in _FLAT_CELLS and k not in _PASSED_OVER]
    if strange:
        raise Refused(
            f"cells of VTK type {strange[0]}: flat triangles, quadrilaterals and polygons are "
            "allowed, no solid and no curved elements"
        )
    sizes, corners = _split(data.GetCells(), data.GetNumberOfPoints())
    starts = np.cumsum(sizes) - sizes
    keep = np.isin(kinds, (5, 7, 9))
    chosen = np.repeat(keep, sizes)
    parts = [(sizes[keep], corners[chosen])]
    for k in np.flatnonzero(kinds == 8):  # a pixel's corners run in rows
        a, b, c, d = corners[starts[k] : starts[k] + 4]
        parts.append((np.array([4]), np.array([a, b, d, c])))
    strips = kinds == 6
    parts.append(_split_strips(sizes[strips], corners[np.repeat(strips, sizes)]))
    return np.concatenate([p[0] for p in parts]), np.concatenate([p[1] for p in parts])


def _collect_structured(dimensions: list[int]) -> tuple[np.ndarray, np.ndarray]:
    size = [k for k in dimensions if k > 1]
    if len(size) != 2:
        raise Refused(
            f"a grid of {' x '.join(map(str, dimensions))} points: a surface has one layer"
        )
    number = np.arange(size[0] * size[1]).reshape(size[1], size[0])
    sides = [number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]]
    quads = np.stack([side.ravel() for side in sides], axis=1)
    return np.full(len(quads), 4), quads.ravel()


def _check_announced(path: str, points: int, cells: int) -> None:
    """Compare what was read with the counts that the file itself announces."""
    data = Path(path).read_bytes()
    if Path(path).suffix.lower() == ".vtk":
        told = re.search(rb"^\s*POINTS\s+(\d+)", data, re.MULTILINE | re.IGNORECASE)
        pairs = [("points", int(told[1]) if told else points, points)]
    else:
        head = data.split(b"<AppendedData")[0]
        sums = [sum(map(int, re.findall(rb'NumberOf%s="\s*(\d+)\s*"' % kind, head)))
                for kind in (b"Points", b"(?:Cells|Verts|Lines|Strips|Polys)")]  # fmt: skip
        pairs = [("points", sums[0], points), ("cells", sums[1], cells)]
    for kind, announced, read in pairs:
        if announced != read:
            raise Refused(f"{announced} {kind} announced, {read} read: damaged or cut off")


def read_gmsh(path: str) -> dict:
    """Read a Gmsh .msh of version 2 or 4, text or binary."""
    import meshio

    data = Path(path).read_bytes()
    _check_sections(data)
    try:
        mesh = meshio.gmsh.read(path)
    except (Exception, SystemExit) as error:  # the reader raises what it likes, and exits
        raise Refused(f"damaged or cut off: {type(error).__name__} {str(error)[:100]}") from None
    known = (*_GMSH_FLAT, "line", "vertex")
    strange = [block.type for block in mesh.cells if block.type not in known and len(block.data)]
    if strange:
        raise Refused(
            f"elements {strange[0]!r}: flat triangles and quadrilaterals are allowed, no solid "
            "and no curved elements"
        )
    blocks = [block.data for block in mesh.cells if block.type in _GMSH_FLAT and len(block.data)]
    none = [np.empty(0, dtype=np.int64)]
    sizes = np.concatenate(none + [np.full(len(block), block.shape[1]) for block in blocks])
    corners = np.concatenate(none + [np.asarray(block).ravel() for block in blocks])
    return {"vertices": mesh.points, "sizes": sizes, "corners": corners}


def _check_sections(data: bytes) -> None:
    if not data.lstrip().startswith((b"$MeshFormat", b"$Comments")):
        raise Refused(
            "does not begin with $MeshFormat: damaged, empty or not a file of Gmsh 2 or 4"
        )
    for name in (b"MeshFormat", b"Nodes", b"Elements"):
        if b"$" + name not in data:
            raise Refused(f"the section ${name.decode()} is missing: damaged or cut off")
        if b"$End" + name not in data:
            raise Refused(f"the section ${name.decode()} has no end: damaged or cut off")


def _limit() -> None:
    """Bound the memory, and leave no core file, on systems that can."""
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource

        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def read_3dm(path: str, unit: str) -> dict:
    """Read a .3dm file of Rhino whose model is in `unit`."""
    try:
        from rhino_child import read_rhino  # beside this file, where it runs as a script
    except ImportError:
        from foldshell.files.meshes.rhino_child import read_rhino
    return read_rhino(path, unit, Refused)


def main(path: str, out: str, unit: str = "metres") -> int:
    """Read `path`, whose unit must be `unit` where it has one; write `out` or print why not.

    Return the exit code.
    """
    _limit()
    try:
        suffix = Path(path).suffix.lower()
        if suffix == ".3dm":
            arrays = read_3dm(path, unit)
        else:
            arrays = read_gmsh(path) if suffix == ".msh" else read_vtk(path)
        np.savez(out, **arrays)
    except Refused as error:
        print(error)
        return REFUSED
    except (OverflowError, ValueError) as error:  # counts and offsets that fit nothing
        print(f"damaged: {type(error).__name__} {' '.join(str(error).split())[:100]}")
        return REFUSED
    except MemoryError:
        print(f"needs more than {MEMORY / 1e9:g} GB to be read: damaged, or too large")
        return REFUSED
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
