"""STL, OBJ, PLY and OFF as programs write them, and as they get spoilt: name -> bytes, answer.

An answer is the number of triangles that are due, or a pattern of the reason for a refusal.
"""

import struct

import numpy as np

from data.mesh_files.patch import Patch, make_patch

Files = dict[str, tuple[bytes, int | str]]
TRIANGLES, QUADS, HEXAGONS = make_patch(3), make_patch(4), make_patch(6)
N = TRIANGLES.triangles


def write_stl(patch: Patch = TRIANGLES, normal: str = "0 0 1", name: str = "patch") -> str:
    """Text STL; polygons are fanned."""
    lines = [f"solid {name}"]
    for a, b, c in fan(patch):
        lines += [f"  facet normal {normal}", "    outer loop"]
        lines += [
            "      vertex " + " ".join(map(repr, patch.vertices[k].tolist())) for k in (a, b, c)
        ]
        lines += ["    endloop", "  endfacet"]
    return "\n".join([*lines, f"endsolid {name}", ""])


def fan(patch: Patch):
    """Triangles of polygons, fanned."""
    for polygon in patch.polygons:
        for k in range(1, len(polygon) - 1):
            yield polygon[0], polygon[k], polygon[k + 1]


def pack_stl(
    patch: Patch = TRIANGLES, title: bytes = b"patch", attribute: int = 0, count=None
) -> bytes:
    """Binary STL."""
    rows = list(fan(patch))
    body = b"".join(
        struct.pack("<12fH", 0, 0, 1, *patch.vertices[[a, b, c]].ravel(), attribute)
        for a, b, c in rows
    )
    total = len(rows) if count is None else count
    return title.ljust(80, b" ")[:80] + struct.pack("<I", total) + body


def stl_files() -> Files:
    """STL."""
    text, binary = write_stl(), pack_stl()
    record = binary[84:134]
    flat = struct.pack("<12fH", *[0.0] * 3, *[1.0] * 9, 0)
    grow = lambda more, n: binary[:80] + struct.pack("<I", N + n) + binary[84:] + more  # noqa: E731
    nan = bytearray(binary)
    nan[96:100] = struct.pack("<f", float("nan"))
    return {
        "text.stl": (text.encode(), N),
        "capitals.stl": (text.upper().encode(), N),
        "crlf.stl": (text.replace("\n", "\r\n").encode(), N),
        "cr.stl": (text.replace("\n", "\r").encode(), N),
        "bom.stl": (b"\xef\xbb\xbf" + text.encode(), N),
        "tabs.stl": (text.replace("  ", "\t").encode(), N),
        "no_indent.stl": ("\n".join(k.strip() for k in text.splitlines()).encode(), N),
        "no_name.stl": (write_stl(name="").encode(), N),
        "odd_name.stl": (write_stl(name="facet normal of Dach größer").encode("latin-1"), N),
        "nan_normals.stl": (write_stl(normal="nan -nan(ind) nan").encode(), N),
        "zero_normals.stl": (write_stl(normal="0 0 0").encode(), N),
        "two_solids.stl": (
            (
                write_stl(Patch(TRIANGLES.vertices, TRIANGLES.polygons[:50]))
                + write_stl(Patch(TRIANGLES.vertices, TRIANGLES.polygons[50:]))
            ).encode(),
            N,
        ),
        "unit_metres.stl": (write_stl(name="roof units=m").encode(), N),
        "binary.stl": (binary, N),
        "UPPER.STL": (binary, N),
        "binary_solid.stl": (pack_stl(title=b"solid from a CAD program"), N),
        "binary_long_title.stl": (pack_stl(title=b"x" * 80), N),
        "binary_colours.stl": (pack_stl(attribute=0x7FFF), N),
        "binary_flat_triangle.stl": (grow(flat, 1), N),
        "binary_twice.stl": (grow(record, 1), N),
        "blank_lines.stl": (text.replace("endfacet\n", "endfacet\n\n").encode(), N),
        "cut.stl": (text[: len(text) // 2].encode(), "cut off"),
        "cut_at_facet.stl": (text[: text.rindex("  facet")].encode(), "endsolid.*cut off"),
        "four_corners.stl": (
            text.replace("    endloop", "      vertex 0 0 0\n    endloop", 1).encode(),
            "a triangle of three vertices",
        ),
        "comma.stl": (text.replace(".", ",").encode(), "decimal commas must be points"),
        "nan.stl": (
            text.replace("vertex -3.0", "vertex nan", 1).encode(),
            "line 4: 'nan'.*not finite",
        ),
        "unit_mm.stl": (write_stl(name="roof UNITS=mm").encode(), "declares millimetres"),
        "no_facets.stl": (b"solid a\nendsolid a\n", "0 triangles"),
        "binary_cut.stl": (binary[: len(binary) // 2], "counts 128 triangles, the file holds 63"),
        "binary_last_byte.stl": (binary[:-1], "the file holds 127"),
        "binary_count_low.stl": (pack_stl(count=100), "counts 100 triangles, the file holds 128"),
        "binary_count_high.stl": (pack_stl(count=10**9), "counts 1000000000 triangles"),
        "binary_more.stl": (binary + b"more", "4 bytes more"),
        "binary_nan.stl": (bytes(nan), "not finite"),
        "binary_none.stl": (pack_stl(Patch(TRIANGLES.vertices, [])), "0 triangles"),
        "short.stl": (b"\1\2\3\4", "empty or cut off"),
    }


def write_obj(
    patch: Patch = TRIANGLES, corner: str = "{0}", head: str = "", vertex: str = ""
) -> str:
    """OBJ; `corner` is filled with the vertex number, `vertex` follows the coordinates."""
    lines = [head] if head else []
    lines += [f"v {x!r} {y!r} {z!r}{vertex}" for x, y, z in patch.vertices.tolist()]
    if "/" in corner:
        lines += [f"vt {x!r} {y!r}" for x, y, _ in patch.vertices.tolist()]
        lines += ["vn 0 0 1"] * len(patch.vertices)
    for polygon in patch.polygons:
        lines.append(
            "f " + " ".join(corner.format(k + 1, k - len(patch.vertices)) for k in polygon)
        )
    return "\n".join([*lines, ""])


def obj_files() -> Files:
    """OBJ."""
    text = write_obj()
    vertices, faces = text[: text.index("f ")], text[text.index("f ") :]
    soup = Patch(
        TRIANGLES.vertices[np.array(TRIANGLES.polygons).ravel()],
        np.arange(3 * N).reshape(-1, 3).tolist(),
    )
    groups = "mtllib roof.mtl\nusemtl \no dach\ng first second\ns 1\n"
    around = "".join(
        "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in TRIANGLES.vertices[polygon].tolist())
        + "f -3 -2 -1\n"
        for polygon in TRIANGLES.polygons
    )
    files: Files = {
        "plain.obj": (text.encode(), N),
        "quads.obj": (write_obj(QUADS).encode(), N),
        "hexagons.obj": (write_obj(HEXAGONS).encode(), N),
        "texture.obj": (write_obj(corner="{0}/{0}").encode(), N),
        "texture_normal.obj": (write_obj(corner="{0}/{0}/{0}").encode(), N),
        "normal.obj": (write_obj(corner="{0}//{0}").encode(), N),
        "slashes.obj": (write_obj(corner="{0}//").encode(), N),
        "slash.obj": (write_obj(corner="{0}/").encode(), N),
        "negative.obj": (write_obj(corner="{1}").encode(), N),
        "negative_texture.obj": (write_obj(corner="{1}/{1}/{1}").encode(), N),
        "groups.obj": ((groups + text).encode(), N),
        "crlf.obj": ((groups + text).replace("\n", "\r\n").encode(), N),
        "cr.obj": (text.replace("\n", "\r").encode(), N),
        "bom.obj": (b"\xef\xbb\xbf# roof\n" + text.encode(), N),
        "continued.obj": (text.replace(" 1 ", " 1 \\\n ").encode(), N),
        "colours.obj": (write_obj(vertex=" 0.5 0.5 1").encode(), N),
        "weights.obj": (write_obj(vertex=" 1.000").encode(), N),
        "remarks.obj": (text.replace("\nf", " # here\n\n#f 1 1 1\nf").encode(), N),
        "blanks.obj": (text.replace(" ", "\t  ").replace("\nv", "\n  v").encode(), N),
        "faces_first.obj": ((faces + vertices).encode(), N),
        "interleaved.obj": (around.encode(), N),
        "old_faces.obj": (text.replace("\nf ", "\nfo ").encode(), N),
        "with_lines.obj": ((text + "l 1 2 3\np 1\n").encode(), N),
        "no_last_line_end.obj": (text.rstrip().encode(), N),
        "latin.obj": (b"g Dachfl\xe4che\n" + text.encode(), N),
        "flat_face.obj": ((text + "f 1 1 2\nf 1 2 1\n").encode(), N),
        "twice.obj": (
            (text + "f 3 1 2\n" + faces[: faces.index("\n") + 1]).encode(),
            "or more|twice",
        ),
        "face_twice.obj": ((text + faces[: faces.index("\n") + 1]).encode(), N),
        "unused_vertex.obj": (("v 900 900 900\n" + write_obj(corner="{1}")).encode(), N),
        "soup.obj": (write_obj(soup).encode(), N),
        "unit_metres.obj": (write_obj(head="# File units = meters").encode(), N),
        "exponents.obj": (write_exponents().encode(), N),
    }
    files |= {
        "cut.obj": (text[: int(0.8 * len(text))].rstrip().encode(), "cut off"),
        "cut_in_vertices.obj": (
            text[: len(vertices) // 2].encode(),
            "no faces|numbers of a vertex",
        ),
        "cut_at_line.obj": (
            (vertices + faces[: faces.index("\nf", 900)] + "\n").encode(),
            "may be cut off",
        ),
        "no_faces.obj": (vertices.encode(), "81 vertices, no faces"),
        "only_lines.obj": (
            (vertices + "l 1 2\nl 2 3\np 4\n").encode(),
            "2 lines and 1 point, no faces",
        ),
        "free_form.obj": (
            (vertices + "cstype bspline\nsurf 0 1 0 1 1 2 3 4\n").encode(),
            "free-form",
        ),
        "index_high.obj": ((text + "f 1 2 999\n").encode(), "vertex 999 .*1 to 81 are allowed"),
        "index_zero.obj": ((text + "f 0 1 2\n").encode(), "vertex 0"),
        "index_back.obj": ((text + "f -1 -2 -999\n").encode(), "vertex -999"),
        "no_texture.obj": (
            (vertices + faces.replace("f 1 ", "f 1/1 ")).encode(),
            "texture vertex 1: the file holds none",
        ),
        "no_normal.obj": (
            (vertices + faces.replace("f 1 ", "f 1//1 ")).encode(),
            "normal 1: the file holds none",
        ),
        "two_corners.obj": ((text + "f 1 2\n").encode(), "at least 3 corners"),
        "nan.obj": (("v nan 0 0\n" + text).encode(), "line 1: 'nan'.*not finite"),
        "infinite.obj": (("v 1e999 0 0\n" + text).encode(), "line 1: '1e999'"),
        "comma.obj": (text.replace(".", ",").encode(), "decimal commas must be points"),
        "underscore.obj": (("v 1_0 0 0\n" + text).encode(), "'1_0'"),
        "two_numbers.obj": (("v 1 0\n" + text).encode(), "line 1: 2 numbers of a vertex"),
        "weight.obj": (("v 1 0 0 0.5\n" + text).encode(), "weight '0.5'"),
        "keyword.obj": ((text + "face 1 2 3\n").encode(), "not a keyword of OBJ"),
        "unit_mm.obj": (
            write_obj(head="# File units = millimeters").encode(),
            "declares millimetres",
        ),
        "six_digits.obj": (write_shifted(), "must cover the span|given to|0 triangles"),
    }
    return files


def write_exponents() -> str:
    """Numbers as Fortran and C write them."""
    lines = ["v " + " ".join(f"{k:+.15E}" for k in row) for row in TRIANGLES.vertices.tolist()]
    lines += ["f " + " ".join(str(k + 1) for k in p) for p in TRIANGLES.polygons]
    return "\n".join(lines) + "\n"


def write_shifted() -> bytes:
    """Coordinates on a national grid [m] with six digits, as `%g` writes them."""
    rows = TRIANGLES.vertices + np.array([690_000, 5_334_000, 500])
    lines = ["v " + " ".join(f"{k:g}" for k in row) for row in rows.tolist()]
    lines += ["f " + " ".join(str(k + 1) for k in p) for p in TRIANGLES.polygons]
    return ("\n".join(lines) + "\n").encode()


def off_files() -> Files:
    """OFF."""

    def write(
        patch: Patch = TRIANGLES, head: str = "OFF\n", vertex: str = "", face: str = ""
    ) -> str:
        lines = [f"{len(patch.vertices)} {len(patch.polygons)} 0"]
        lines += [f"{x!r} {y!r} {z!r}{vertex}" for x, y, z in patch.vertices.tolist()]
        lines += [f"{len(p)} " + " ".join(map(str, p)) + face for p in patch.polygons]
        return head + "\n".join([*lines, ""])

    text = write()
    counts = f"81 {N} 0"
    return {
        "plain.off": (text.encode(), N),
        "quads.off": (write(QUADS).encode(), N),
        "hexagons.off": (write(HEXAGONS).encode(), N),
        "one_line.off": (write(head="OFF ").encode(), N),
        "no_keyword.off": (write(head="").encode(), N),
        "small.off": (write(head="off\n").encode(), N),
        "colours.off": (write(head="COFF\n", vertex=" 255 0 0 255").encode(), N),
        "normals.off": (write(head="NOFF\n", vertex=" 0 0 1").encode(), N),
        "face_colours.off": (write(face=" 0.5 0.5 0.5").encode(), N),
        "remarks.off": (text.replace("\n", " # here\n\n# and here\n").encode(), N),
        "crlf.off": (text.replace("\n", "\r\n").encode(), N),
        "bom.off": (b"\xef\xbb\xbf" + text.encode(), N),
        "no_edge_count.off": (text.replace(counts, counts[:-2]).encode(), N),
        "cut.off": (text[: len(text) // 2].encode(), "cut off|coordinates are due"),
        "more.off": ((text + "3 0 1 2\n").encode(), "more than that"),
        "faces_high.off": (text.replace(counts, f"81 {10**9} 0").encode(), "announced.*cut off"),
        "vertices_high.off": (text.replace(counts, f"{10**9} {N} 0").encode(), "announced"),
        "vertices_low.off": (
            text.replace(counts, f"80 {N + 1} 0").encode(),
            "a count of at least 3|whole",
        ),
        "index.off": (text.replace("\n3 0 ", "\n3 81 ", 1).encode(), "vertex 81 .*below 81"),
        "negative.off": (text.replace("\n3 0 ", "\n3 -1 ", 1).encode(), "vertex -1 "),
        "binary.off": (b"OFF BINARY\n\0\0\0\1", "binary OFF"),
        "four.off": (write(head="4OFF\n", vertex=" 1").encode(), "three coordinates"),
        "comma.off": (text.replace(".", ",").encode(), "decimal commas"),
        "nan.off": (text.replace("-3.0", "nan", 1).encode(), "not finite"),
        "no_faces.off": (text.replace(counts, "81 0 0").split("\n3 ")[0].encode(), "no faces"),
        "no_counts.off": (b"OFF\n", "counts"),
    }
