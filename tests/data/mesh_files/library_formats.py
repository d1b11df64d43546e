"""VTK, VTU, VTP and MSH, written by their own libraries, and spoilt: name -> bytes, answer."""

import re
from pathlib import Path

import meshio
import numpy as np
import pyvista
import vtk

from data.mesh_files.patch import Patch, make_patch
from data.mesh_files.text_formats import HEXAGONS, QUADS, TRIANGLES, Files, N


def to_polydata(patch: Patch = TRIANGLES, kind=float) -> pyvista.PolyData:
    """Polygons as VTK holds them."""
    faces = np.concatenate([[len(p), *p] for p in patch.polygons]) if patch.polygons else None
    points = patch.vertices.astype(kind)
    return pyvista.PolyData(points, faces) if faces is not None else pyvista.PolyData(points)


def to_grid(patch: Patch = TRIANGLES, kind=float) -> pyvista.UnstructuredGrid:
    """The same as cells of an unstructured grid."""
    return to_polydata(patch, kind).cast_to_unstructured_grid()


def write(folder: Path, name: str, data, writer, **options) -> bytes:
    """Bytes that a writer of VTK makes; `options` are its settings."""
    tool = writer()
    tool.SetFileName(str(folder / name))
    tool.SetInputData(data)
    for key, value in options.items():
        setting = getattr(tool, f"Set{key}")
        setting(value) if value is not None else getattr(tool, f"Set{key}")()
    tool.Write()
    return (folder / name).read_bytes()


def with_lines(grid):
    """A grid with a line and a point beside its polygons."""
    cells = np.concatenate([grid.cells, [2, 0, 1, 1, 5]])
    kinds = np.concatenate([grid.celltypes, [3, 1]])
    return pyvista.UnstructuredGrid(cells, kinds, grid.points)


def with_data(mesh):
    """A mesh with fields."""
    mesh = mesh.copy()
    mesh.point_data["height"] = mesh.points[:, 2]
    mesh.cell_data["number"] = np.arange(mesh.n_cells)
    return mesh


def make_structured():
    """The patch as a structured grid of one layer."""
    along = np.linspace(-3, 3, 9)
    x, y = np.meshgrid(along, along, indexing="ij")
    z = 1.0 - 0.04 * x**2 - 0.06 * y**2 + 0.01 * x * y
    return pyvista.StructuredGrid(x[..., None], y[..., None], z[..., None])


def make_solid():
    """Hexahedra below the patch."""
    along = np.linspace(-3, 3, 5)
    return pyvista.StructuredGrid(*np.meshgrid(along, along, [0.0, 1.0], indexing="ij"))


def vtk_files(folder: Path) -> Files:
    """Legacy VTK."""
    poly, grid = vtk.vtkPolyDataWriter, vtk.vtkUnstructuredGridWriter

    def get(data, writer=poly, **options):
        return write(folder, "a.vtk", data, writer, **options)

    text, binary = get(to_polydata()), get(to_polydata(), FileTypeToBinary=None)
    strips = to_polydata().strip()
    nan = change_point(TRIANGLES, 40, float("nan"))
    solid = get(make_solid().cast_to_unstructured_grid(), grid)
    return {
        "text.vtk": (text, N),
        "binary.vtk": (binary, N),
        "old.vtk": (get(to_polydata(), FileVersion=42), N),
        "grid.vtk": (get(to_grid(), grid), N),
        "grid_binary.vtk": (get(to_grid(), grid, FileTypeToBinary=None), N),
        "grid_old.vtk": (get(to_grid(), grid, FileVersion=42), N),
        "float.vtk": (get(to_polydata(kind=np.float32)), N),
        "quads.vtk": (get(to_polydata(QUADS)), N),
        "hexagons.vtk": (get(to_polydata(HEXAGONS)), N),
        "strips.vtk": (get(strips), N),
        "fields.vtk": (get(with_data(to_polydata())), N),
        "lines.vtk": (get(with_lines(to_grid()), grid), N),
        "structured.vtk": (get(make_structured(), vtk.vtkStructuredGridWriter), N),
        "cut.vtk": (text[: len(text) // 2], "cut off|damaged"),
        "binary_cut.vtk": (binary[: len(binary) // 2], "cut off|damaged"),
        "points_high.vtk": (text.replace(b"POINTS 81", b"POINTS 8100000"), "damaged|announced"),
        "index.vtk": (
            get(to_polydata(), FileVersion=42).replace(b"\n3 0 9 10", b"\n3 0 9 1000"),
            "vertex 1000 ",
        ),
        "nan.vtk": (get(to_polydata(nan)), "not finite"),
        "solid.vtk": (solid, "no solid"),
        "solid_structured.vtk": (get(make_solid(), vtk.vtkStructuredGridWriter), "one layer"),
        "image.vtk": (
            get(pyvista.ImageData(dimensions=(4, 4, 1)), vtk.vtkStructuredPointsWriter),
            "ImageData|StructuredPoints",
        ),
        "no_cells.vtk": (get(to_polydata(Patch(TRIANGLES.vertices, []))), "no faces"),
        "table.vtk": (b"# vtk DataFile Version 3.0\nx\nASCII\nDATASET NOTHING\n", "damaged|holds"),
    }


def change_point(patch: Patch, row: int, value: float) -> Patch:
    """The patch with one coordinate changed."""
    vertices = patch.vertices.copy()
    vertices[row, 2] = value
    return Patch(vertices, patch.polygons)


def xml_files(folder: Path, suffix: str) -> Files:
    """VTU or VTP in all their encodings."""
    make = to_grid if suffix == ".vtu" else to_polydata
    writer = vtk.vtkXMLUnstructuredGridWriter if suffix == ".vtu" else vtk.vtkXMLPolyDataWriter

    def get(data, **options):
        return write(folder, f"a{suffix}", data, writer, **options)

    ways = {
        "text": {"DataModeToAscii": None},
        "binary": {"DataModeToBinary": None},
        "appended": {"DataModeToAppended": None},
        "appended_base64": {"DataModeToAppended": None, "EncodeAppendedData": 1},
        "plain_binary": {"DataModeToBinary": None, "CompressorTypeToNone": None},
        "lzma": {"DataModeToBinary": None, "CompressorTypeToLZMA": None},
        "big_end": {"DataModeToBinary": None, "ByteOrderToBigEndian": None},
        "wide": {"DataModeToAppended": None, "HeaderTypeToUInt64": None},
    }
    files: Files = {f"{name}{suffix}": (get(make(), **way), N) for name, way in ways.items()}
    text, binary = files[f"text{suffix}"][0], files[f"binary{suffix}"][0]
    appended = files[f"appended{suffix}"][0]
    nan = change_point(TRIANGLES, 40, float("nan"))
    files |= {
        f"float{suffix}": (get(make(kind=np.float32)), N),
        f"quads{suffix}": (get(make(QUADS)), N),
        f"hexagons{suffix}": (get(make(HEXAGONS)), N),
        f"fields{suffix}": (get(with_data(make())), N),
        f"cut{suffix}": (text[: len(text) // 2], "cut off|damaged"),
        f"binary_cut{suffix}": (binary[: len(binary) // 2], "cut off|damaged"),
        f"appended_cut{suffix}": (appended[: len(appended) // 2], "cut off|damaged"),
        f"points_high{suffix}": (
            re.sub(rb'NumberOfPoints="81"', b'NumberOfPoints="8100"', text),
            "damaged|announced",
        ),
        f"nan{suffix}": (get(make(nan), DataModeToBinary=None), "not finite"),
        f"no_cells{suffix}": (get(make(Patch(TRIANGLES.vertices, []))), "no faces|0 triangles"),
        f"web{suffix}": (b"<!DOCTYPE html><html>404</html>", "a web page"),
        f"other_kind{suffix}": (
            text.replace(b"UnstructuredGrid", b"RectilinearGrid").replace(
                b"PolyData", b"ImageData"
            ),
            "XML file|damaged|rename",
        ),
    }
    if suffix == ".vtu":
        files["lines.vtu"] = (get(with_lines(to_grid())), N)
        files["solid.vtu"] = (get(make_solid().cast_to_unstructured_grid()), "no solid")
        files["index.vtu"] = (
            re.sub(rb'(Name="connectivity"[^>]*>\s*)0 ', rb"\g<1>999 ", text),
            "vertex 999 ",
        )
        files["curved.vtu"] = (get(make_curved()), "no curved")
    else:
        files["strips.vtp"] = (get(to_polydata().strip()), N)
    return files


def make_curved():
    """Triangles of second order."""
    points = np.array([[0, 0, 0], [6, 0, 0], [0, 6, 0], [3, 0, 1], [3, 3, 1], [0, 3, 1.0]])
    return pyvista.UnstructuredGrid(np.array([6, 0, 1, 2, 3, 4, 5]), np.array([22]), points)


def msh_files(folder: Path) -> Files:
    """Gmsh 2.2 and 4.1."""

    def get(blocks, version="4.1", binary=False, points=TRIANGLES.vertices) -> bytes:
        path = folder / "a.msh"
        mesh = meshio.Mesh(points, blocks)
        meshio.gmsh.write(path, mesh, fmt_version=version, binary=binary)
        return path.read_bytes()

    triangles, quads = np.array(TRIANGLES.polygons), np.array(QUADS.polygons)
    flat = [("triangle", triangles)]
    lines = [("line", np.array([[0, 1], [1, 2]])), ("vertex", np.array([[0]])), *flat]
    mixed = [("quad", quads[:30]), ("triangle", triangles[60:])]
    new, old = get(flat), get(flat, "2.2")
    new_binary, old_binary = get(flat, binary=True), get(flat, "2.2", True)
    tetra = [("tetra", np.array([[0, 1, 10, 80]])), *flat]
    nan = change_point(TRIANGLES, 40, float("nan")).vertices
    return {
        "new.msh": (new, N),
        "new_binary.msh": (new_binary, N),
        "old.msh": (old, N),
        "old_binary.msh": (old_binary, N),
        "lines.msh": (get(lines, "2.2"), N),
        "lines_binary.msh": (get(lines, "2.2", True), N),
        "quads.msh": (get([("quad", quads)]), N),
        "mixed.msh": (get(mixed, "2.2"), MIXED_TRIANGLES),
        "cut.msh": (new[: len(new) // 2], "damaged or cut off"),
        "old_cut.msh": (old[: len(old) // 2], "damaged or cut off"),
        "binary_cut.msh": (new_binary[: len(new_binary) // 2], "damaged or cut off"),
        "nan.msh": (get(flat, "2.2", points=nan), "not finite|nan"),
        "solid.msh": (get(tetra, "2.2"), "no solid"),
        "no_elements.msh": (get([("line", np.array([[0, 1]]))], "2.2"), "no faces"),
        "old_index.msh": (
            re.sub(rb"\n(\d+ 2 2 \d+ \d+) 1 ", rb"\n\1 999 ", old, count=1),
            "damaged|vertex",
        ),
        "count_high.msh": (old.replace(b"$Nodes\n81", b"$Nodes\n8100"), "damaged|cut off"),
        "one.msh": (b"$NOD\n3\n1 0 0 0\n$ENDNOD\n", "MeshFormat"),
        "fluent.msh": (b'(0 "grid")\n(2 3)\n', "MeshFormat"),
    }


MIXED_TRIANGLES = 2 * 30 + len(make_patch(3).polygons[60:])


def spoilt_files(folder: Path, patch: Patch, stem: str, reason: str) -> Files:
    """One spoilt surface in the formats of libraries."""
    blocks = [("triangle", np.array(patch.polygons))]
    meshio.gmsh.write(folder / "a.msh", meshio.Mesh(patch.vertices, blocks), "2.2", False)
    return {
        f"{stem}.vtk": (write(folder, "a.vtk", to_polydata(patch), vtk.vtkPolyDataWriter), reason),
        f"{stem}.vtu": (
            write(folder, "a.vtu", to_grid(patch), vtk.vtkXMLUnstructuredGridWriter),
            reason,
        ),
        f"{stem}.vtp": (
            write(folder, "a.vtp", to_polydata(patch), vtk.vtkXMLPolyDataWriter),
            reason,
        ),
        f"{stem}.msh": ((folder / "a.msh").read_bytes(), reason),
    }
