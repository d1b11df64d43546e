"""PLY as programs write it, and as it gets spoilt: name -> bytes, answer."""

import struct

import numpy as np

from data.mesh_files.patch import Patch
from data.mesh_files.text_formats import HEXAGONS, QUADS, TRIANGLES, Files, N

MIXED = Patch(QUADS.vertices, QUADS.polygons[:30] + TRIANGLES.polygons[60:])


def write_header(
    kind,
    patch,
    scalar="double",
    listed="uchar int",
    more_vertex="",
    more_face="",
    name="vertex_indices",
    vertices=None,
    faces=None,
    remarks="",
):
    """Header of a file with vertices and faces."""
    axes = "".join(f"property {scalar} {axis}\n" for axis in "xyz")
    vertices = len(patch.vertices) if vertices is None else vertices
    faces = len(patch.polygons) if faces is None else faces
    return (
        f"ply\nformat {kind} 1.0\n{remarks}element vertex {vertices}\n{axes}{more_vertex}"
        f"element face {faces}\nproperty list {listed} {name}\n{more_face}end_header\n"
    )


def write_text(patch=TRIANGLES, vertex="", face="", **header) -> str:
    """Text PLY; `vertex` and `face` follow on each line."""
    lines = [" ".join(map(repr, row)) + vertex for row in patch.vertices.tolist()]
    lines += [f"{len(p)} " + " ".join(map(str, p)) + face for p in patch.polygons]
    return write_header("ascii", patch, **header) + "\n".join([*lines, ""])


CODES = {
    "float": "f",
    "double": "d",
    "float32": "f",
    "uchar": "B",
    "uint8": "B",
    "int": "i",
    "uint": "I",
    "short": "h",
    "ushort": "H",
    "int32": "i",
    "char": "b",
}


def pack(patch=TRIANGLES, order="<", vertex=b"", face=b"", **header) -> bytes:
    """Binary PLY."""
    kind = "binary_little_endian" if order == "<" else "binary_big_endian"
    scalar = CODES[header.get("scalar", "double")]
    counter, index = (CODES[k] for k in header.get("listed", "uchar int").split())
    rows = [struct.pack(f"{order}3{scalar}", *row) + vertex for row in patch.vertices]
    rows += [
        struct.pack(f"{order}{counter}{len(p)}{index}", len(p), *p) + face for p in patch.polygons
    ]
    return write_header(kind, patch, **header).encode() + b"".join(rows)


def write_strips() -> str:
    """One strip for each row of cells, ended by -1."""
    number = np.arange(81).reshape(9, 9)
    strips = [[*np.stack([number[i], number[i + 1]], 1).ravel().tolist(), -1] for i in range(8)]
    flat = [number for strip in strips for number in strip]
    head = write_header("ascii", Patch(TRIANGLES.vertices, []))
    head = head.replace(
        "element face 0\nproperty list uchar int vertex_indices",
        "element tristrips 1\nproperty list int int vertex_indices",
    )
    rows = [" ".join(map(repr, row)) for row in TRIANGLES.vertices.tolist()]
    return head + "\n".join([*rows, f"{len(flat)} " + " ".join(map(str, flat)), ""])


def faces_before_vertices() -> str:
    """The element of faces stands first, in the header and after it."""
    text = write_text()
    head, body = text.split("end_header\n")
    lines = body.splitlines()
    vertex, face = head.index("element vertex"), head.index("element face")
    return "\n".join(
        [
            head[:vertex] + head[face:] + head[vertex:face] + "end_header",
            *lines[81:],
            *lines[:81],
            "",
        ]
    )


def ply_files() -> Files:
    """PLY."""
    text, binary = write_text(), pack()
    colours = "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    remarks = "comment made by a program\nobj_info scanned\ncomment element face 3\n"
    lists = "property list uchar float texcoord\nproperty int texnumber\n"
    edges = (
        text.replace(
            "end_header", "element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header"
        )
        + "0 1\n1 2\n"
    )
    nan = binary.replace(struct.pack("<d", -3.0), struct.pack("<d", float("nan")), 1)
    head = binary.index(b"end_header\n") + 11
    return {
        "text.ply": (text.encode(), N),
        "capitals.ply": (text.replace("ply\n", "PLY\n", 1).encode(), N),
        "crlf.ply": (text.replace("\n", "\r\n").encode(), N),
        "cr.ply": (text.replace("\n", "\r").encode(), N),
        "remarks.ply": (write_text(remarks=remarks).encode(), N),
        "colours.ply": (write_text(vertex=" 255 0 0", more_vertex=colours).encode(), N),
        "vertex_index.ply": (write_text(name="vertex_index").encode(), N),
        "texture.ply": (write_text(face=" 6 0 0 1 0 1 1 7", more_face=lists).encode(), N),
        "quads.ply": (write_text(QUADS).encode(), N),
        "hexagons.ply": (write_text(HEXAGONS).encode(), N),
        "mixed.ply": (write_text(MIXED).encode(), MIXED.triangles),
        "edges.ply": (edges.encode(), N),
        "faces_first.ply": (faces_before_vertices().encode(), N),
        "strips.ply": (write_strips().encode(), N),
        "new_types.ply": (write_text(scalar="float32", listed="uint8 int32").encode(), N),
        "binary.ply": (binary, N),
        "binary_crlf_header.ply": (binary[:head].replace(b"\n", b"\r\n") + binary[head:], N),
        "binary_big.ply": (pack(order=">"), N),
        "binary_float.ply": (pack(scalar="float"), N),
        "binary_big_float.ply": (pack(order=">", scalar="float"), N),
        "binary_ushort.ply": (pack(listed="uint ushort"), N),
        "binary_colours.ply": (pack(vertex=b"\1\2\3", more_vertex=colours), N),
        "binary_mixed.ply": (pack(MIXED), MIXED.triangles),
        "binary_hexagons.ply": (pack(HEXAGONS), N),
        "binary_texture.ply": (
            pack(face=struct.pack("<B6fi", 6, *[0.5] * 6, 2), more_face=lists),
            N,
        ),
        "binary_line_end.ply": (binary + b"\n", N),
        "cut.ply": (text[: len(text) // 2].encode(), "cut off|values of"),
        "cut_header.ply": (text[:80].encode(), "end_header"),
        "faces_high.ply": (write_text(faces=10**9).encode(), "announces.*cut off"),
        "vertices_high.ply": (write_text(vertices=10**9).encode(), "announces"),
        "vertices_low.ply": (write_text(vertices=80, faces=N + 1).encode(), "line|values"),
        "more.ply": ((text + "3 0 1 2\n").encode(), "more than that"),
        "index.ply": (text.replace("\n3 0 ", "\n3 81 ", 1).encode(), "vertex 81 .*below 81"),
        "nan.ply": (text.replace("\n-3.0", "\nnan", 1).encode(), "not finite"),
        "comma.ply": (text.replace("-3.0", "-3,0").encode(), "decimal commas"),
        "no_vertex.ply": (text.replace("vertex", "knoten").encode(), "no element 'vertex'"),
        "no_z.ply": (text.replace("double z", "double w").encode(), "'z' is missing"),
        "no_list.ply": (
            text.replace("vertex_indices", "corners").encode(),
            "'vertex_indices' is missing",
        ),
        "no_format.ply": (text.replace("format ascii 1.0\n", "").encode(), "'format' is missing"),
        "format.ply": (text.replace("ascii", "text").encode(), "binary_little_endian"),
        "type.ply": (text.replace("double", "real").encode(), "not a property of PLY"),
        "no_faces.ply": (pack(Patch(TRIANGLES.vertices, [])), "81 vertices, no faces"),
        "points.ply": (
            pack(Patch(TRIANGLES.vertices, [])).replace(
                b"element face 0\nproperty list uchar int vertex_indices\n", b""
            ),
            "no faces",
        ),
        "binary_cut.ply": (binary[: len(binary) // 2], "cut off"),
        "binary_cut_faces.ply": (binary[:-5], "announced, the file ends after 127: cut off"),
        "binary_faces_high.ply": (pack(faces=10**9), "1000000000 elements 'face' announced"),
        "binary_vertices_high.ply": (pack(vertices=10**12), "elements 'vertex' announced"),
        "binary_faces_low.ply": (pack(faces=100), "bytes follow"),
        "binary_index.ply": (
            pack(Patch(TRIANGLES.vertices, [[0, 1, 5000], *TRIANGLES.polygons])),
            "vertex 5000",
        ),
        "binary_negative.ply": (
            pack(Patch(TRIANGLES.vertices, [[0, 1, -5], *TRIANGLES.polygons])),
            "vertex -5",
        ),
        "binary_nan.ply": (nan, "not finite"),
        "binary_wrong_order.ply": (
            pack().replace(b"little", b"big", 1),
            "cut off|follow|not finite|at most",
        ),
    }
