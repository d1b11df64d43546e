"""Random damage to mesh files: a refusal in one sentence, or what a plain reading finds.

The plain readings below know nothing of the library's: they take a file for what it plainly says,
and fail where it is not plain. What the library accepts must be the same vertices and polygons.
"""

import faulthandler
import functools
import os
import struct
import sys
import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from data.mesh_files.library_formats import msh_files, vtk_files, xml_files
from data.mesh_files.patch import make_patch
from data.mesh_files.ply_files import pack, write_text
from data.mesh_files.text_formats import pack_stl, write_obj, write_stl
from foldshell.files.errors import InputError
from foldshell.files.meshes import child
from foldshell.files.meshes.read import read_mesh
from foldshell.files.meshes.triangles import make_triangles
from fuzzing import BYTE_EDITS, FUZZ, LINE_EDITS, edit_bytes, edit_lines, is_one_sentence

SMALL, SQUARES = make_patch(3, 4), make_patch(4, 4)
HEAD = f"OFF\n{len(SQUARES.vertices)} {len(SQUARES.polygons)} 0\n"
OFF = HEAD + "\n".join(
    [" ".join(map(repr, row)) for row in SQUARES.vertices.tolist()]
    + ["4 " + " ".join(map(str, p)) for p in SQUARES.polygons] + [""]
)  # fmt: skip
TEXTS = {
    ".stl": write_stl(SMALL),
    ".obj": write_obj(SQUARES, corner="{0}//{0}"),
    ".ply": write_text(SQUARES),
    ".off": OFF,
}
BINARIES = {".stl": pack_stl(SMALL), ".ply": pack(SQUARES)}


def read_plain_stl(data):
    """Corners of all facets, three rows a polygon."""
    if len(data) >= 84 and len(data) == 84 + 50 * struct.unpack("<I", data[80:84])[0]:
        rows = [struct.unpack("<12f", data[k : k + 48])[3:] for k in range(84, len(data), 50)]
        return np.array(rows).reshape(-1, 3), None
    words = [line.split() for line in data.decode("latin-1").replace("\r", "\n").split("\n")]
    rows = [
        list(map(float, w[1:4]))
        for w in " ".join(
            " ".join(w) for w in words if w and w[0].lower() not in ("solid", "endsolid")
        )
        .lower()
        .replace("vertex", "\nvertex")
        .split("\n")
        for w in [w.split()]
        if w[:1] == ["vertex"]
    ]
    return np.array(rows), None


def read_plain_obj(data):
    """Vertices, and polygons as lists."""
    vertices, polygons = [], []
    text = data.decode("latin-1").replace("\r\n", "\n").replace("\r", "\n").replace("\\\n", " ")
    for line in text.split("\n"):
        words = line.split("#")[0].split()
        if words[:1] == ["v"]:
            vertices.append([float(k) for k in words[1:4]])
        elif words[:1] in (["f"], ["fo"]):
            corners = [int(k.split("/")[0]) for k in words[1:]]
            polygons.append([k - 1 if k > 0 else len(vertices) + k for k in corners])
    return np.array(vertices), polygons


def read_plain_off(data):
    """Vertices, and polygons as lists."""
    text = data.decode("latin-1").replace("\r\n", "\n").replace("\r", "\n")
    lines = [w for w in (line.split("#")[0].split() for line in text.split("\n")) if w]
    if lines[0][0].upper().endswith("OFF"):
        lines = ([lines[0][1:]] if lines[0][1:] else []) + lines[1:]
    first, faces = int(lines[0][0]), int(lines[0][1])
    vertices = [[float(k) for k in line[:3]] for line in lines[1 : 1 + first]]
    rows = lines[1 + first : 1 + first + faces]
    return np.array(vertices), [[int(k) for k in row[1 : 1 + int(row[0])]] for row in rows]


def read_plain_ply(data):
    """Vertices and polygons of files with the header of the two that are damaged here."""
    start = data.lower().index(b"end_header")
    end = start + len(b"end_header")
    end += 2 if data[end : end + 2] == b"\r\n" else 1
    head = (
        data[:start].decode("latin-1").replace("\r\n", "\n").replace("\r", "\n").lower().split("\n")
    )
    names = [line.split()[1:] for line in head if line.split()[:1] == ["element"]]
    counts = {name: int(number) for name, number in names}
    if any("ascii" in line for line in head if line.split()[:1] == ["format"]):
        text = data[end:].decode("latin-1").replace("\r", "\n")
        lines = [w for w in (line.split() for line in text.split("\n")) if w and w[0] != "comment"]
        vertices = [[float(k) for k in w[:3]] for w in lines[: counts["vertex"]]]
        return np.array(vertices), [[int(k) for k in w[1:]] for w in lines[counts["vertex"] :]]
    order = "<" if any("little" in line for line in head) else ">"
    vertices = np.frombuffer(data, f"{order}f8", 3 * counts["vertex"], end).reshape(-1, 3)
    place, polygons = end + 24 * counts["vertex"], []
    for _ in range(counts["face"]):
        size = data[place]
        polygons.append(list(struct.unpack_from(f"{order}{size}i", data, place + 1)))
        place += 1 + 4 * size
    return vertices, polygons


PLAIN = {
    ".stl": read_plain_stl,
    ".obj": read_plain_obj,
    ".off": read_plain_off,
    ".ply": read_plain_ply,
}


def usual_header(data):
    """Whether a damaged PLY still has the types that the plain reading knows."""
    try:
        head = data[: data.lower().index(b"end_header")].decode("latin-1")
    except ValueError:
        return False
    lines = [" ".join(line.split()).lower() for line in head.replace("\r", "\n").split("\n")]
    wanted = [f"property double {axis}" for axis in "xyz"]
    wanted += ["property list uchar int vertex_indices"]
    return [k for k in lines if k.startswith("property")] == wanted


def check_damaged(path, suffix, data):
    path = path.with_suffix(suffix)
    path.write_bytes(data)
    try:
        mesh = read_mesh(path)
    except InputError as error:
        assert is_one_sentence(error, path), str(error)[:500]
        return
    make_triangles_quietly(mesh)
    if suffix == ".ply" and not usual_header(data):
        return
    vertices, polygons = PLAIN[suffix](data)
    assert np.array_equal(mesh.vertices, vertices)
    if polygons is not None:
        assert np.split(mesh.corners, mesh.starts[1:-1])[0].tolist() == polygons[0]
        assert mesh.corners.tolist() == [k for polygon in polygons for k in polygon]
        assert np.diff(mesh.starts).tolist() == [len(polygon) for polygon in polygons]


def make_triangles_quietly(mesh):
    """Triangles of whatever was accepted: nothing but a refusal may come of it."""
    try:
        made = make_triangles(mesh)
    except ValueError as error:
        assert type(error).__name__ == "MeshError"
    else:
        assert np.isfinite(made.vertices).all() and len(made.triangles)


@pytest.mark.parametrize("suffix", TEXTS)
@settings(max_examples=40, **FUZZ)
@given(edits=LINE_EDITS)
def test_lines_and_words(tmp_path, suffix, edits):
    text = edit_lines(TEXTS[suffix], edits)
    check_damaged(tmp_path / "a", suffix, text.encode("utf-8", "surrogatepass"))


@pytest.mark.parametrize("suffix", TEXTS)
@settings(max_examples=40, **FUZZ)
@given(edits=BYTE_EDITS)
def test_bytes_of_texts(tmp_path, suffix, edits):
    check_damaged(tmp_path / "a", suffix, edit_bytes(TEXTS[suffix].encode(), edits))


@pytest.mark.parametrize("suffix", BINARIES)
@settings(max_examples=40, **FUZZ)
@given(edits=BYTE_EDITS)
def test_bytes_of_binaries(tmp_path, suffix, edits):
    check_damaged(tmp_path / "a", suffix, edit_bytes(BINARIES[suffix], edits))


@pytest.mark.slow
@pytest.mark.parametrize("suffix", TEXTS)
@settings(max_examples=400, **FUZZ)
@given(edits=LINE_EDITS)
def test_lines_and_words_at_length(tmp_path, suffix, edits):
    text = edit_lines(TEXTS[suffix], edits)
    check_damaged(tmp_path / "a", suffix, text.encode("utf-8", "surrogatepass"))


@pytest.mark.slow
@pytest.mark.parametrize("suffix", TEXTS)
@settings(max_examples=300, **FUZZ)
@given(edits=BYTE_EDITS)
def test_bytes_of_texts_at_length(tmp_path, suffix, edits):
    check_damaged(tmp_path / "a", suffix, edit_bytes(TEXTS[suffix].encode(), edits))


@pytest.mark.slow
@pytest.mark.parametrize("suffix", BINARIES)
@settings(max_examples=300, **FUZZ)
@given(edits=BYTE_EDITS)
def test_bytes_of_binaries_at_length(tmp_path, suffix, edits):
    check_damaged(tmp_path / "a", suffix, edit_bytes(BINARIES[suffix], edits))


def read_in_fork(path, out):
    """Run the reader of the libraries in a fork, as it runs in a process of its own: exit code."""
    pid = os.fork()
    if pid == 0:
        code = 70
        try:
            os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
            faulthandler.disable()
            sys.stdout = sys.stderr = open(os.devnull, "w")  # noqa: SIM115
            code = child.main(str(path), str(out))
        finally:
            os._exit(code)
    _, status = os.waitpid(pid, 0)
    return os.waitstatus_to_exitcode(status)


@functools.cache
def good_files():
    """Good files of the formats that libraries read."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        files = {**vtk_files(folder), **xml_files(folder, ".vtu"), **xml_files(folder, ".vtp")}
        files |= msh_files(folder)
    return {name: data for name, (data, due) in files.items() if isinstance(due, int)}


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="forks")
@settings(max_examples=1000, **FUZZ)
@given(data=st.data(), edits=BYTE_EDITS)
def test_bytes_of_files_that_libraries_read(tmp_path, data, edits):
    """It may crash: what matters is that it ends, and that what it hands over is a mesh."""
    import meshio  # noqa: F401  (loaded once, not in each fork)
    import vtk  # noqa: F401

    name = data.draw(st.sampled_from(sorted(good_files())))
    path, out = tmp_path / f"a{name[name.rindex('.') :]}", tmp_path / "a.npz"
    path.write_bytes(edit_bytes(good_files()[name], edits))
    out.unlink(missing_ok=True)
    code = read_in_fork(path, out)
    assert code in (0, child.REFUSED) or code < 0, code
    if code == 0:
        with np.load(out) as arrays:
            assert arrays["sizes"].sum() == len(arrays["corners"])
