"""Patterns and folded sheets of other programs: read as they are, mended, or refused."""

import json
import math
from itertools import pairwise

import ezdxf
import numpy as np
import pytest

from data.mesh_files.patch import Patch
from data.mesh_files.text_formats import pack_stl, write_obj
from foldshell.files.errors import InputError
from foldshell.pattern.drawings import draw_pattern, write_dxf, write_svg
from foldshell.pattern.fold_format import describe_sheet
from foldshell.pattern.miura import Miura
from foldshell.pattern.panel_graph import find_sides, measure_area
from foldshell.pattern.read_panels import read_panels
from foldshell.pattern.sheet import make_miura_sheet

SHEET = make_miura_sheet(Miura(0.9, 0.7, math.radians(63), 4, 5), 2)
GRID = SHEET.grid
PANELS = 12


def letters_of(mesh, points):
    """Letters of a mesh's edges by their middles, which do not depend on numbering."""
    middles = points[mesh.edges].mean(axis=1)
    return {
        tuple(np.round(m[:2] - points[:, :2].min(axis=0), 6) + 0.0): letter
        for m, letter in zip(middles, mesh.assignments, strict=True)
    }


def expected_letters():
    """The same of the sheet itself, without its neutral folds."""
    keep = GRID.assignments != "F"
    middles = SHEET.flat[GRID.edges[keep]].mean(axis=1)
    low = SHEET.flat.min(axis=0)
    return {
        tuple(np.round(m[:2] - low[:2], 6) + 0.0): letter
        for m, letter in zip(middles, GRID.assignments[keep], strict=True)
    }


def plain_fold(**changes):
    """The sheet as a FOLD file that knows nothing of this project: quadrilaterals, no labels."""
    keep = GRID.assignments != "F"
    data = {
        "file_spec": 1.1,
        "vertices_coords": SHEET.flat[:, :2].tolist(),
        "edges_vertices": GRID.edges[keep].tolist(),
        "edges_assignment": GRID.assignments[keep].tolist(),
        "faces_vertices": GRID.quads.tolist(),
    }
    data |= changes
    return {key: value for key, value in data.items() if value is not None}


def read_fold_data(tmp_path, data, unit=None):
    path = tmp_path / "a.fold"
    path.write_text(json.dumps(data))
    return read_panels(path, unit)


@pytest.mark.parametrize("suffix", [".fold", ".svg", ".dxf"])
def test_the_projects_own_files_come_back(tmp_path, suffix):
    path = tmp_path / f"a{suffix}"
    if suffix == ".fold":
        path.write_text(json.dumps(describe_sheet(SHEET, "a")))
    else:
        write = write_svg if suffix == ".svg" else write_dxf
        write(path, draw_pattern(SHEET.flat, GRID))
    mesh = read_panels(path)
    assert len(mesh.panels) == PANELS and (np.diff(mesh.panels.starts) == 4).all()
    found = letters_of(mesh, mesh.flat)
    assert {key: value for key, value in found.items() if value != "F"} == expected_letters()
    size = np.ptp(mesh.flat, axis=0)
    assert size == pytest.approx(np.ptp(SHEET.flat, axis=0), abs=1e-9)  # metres again
    if suffix == ".fold":
        assert np.array_equal(mesh.rest, SHEET.rest)


def test_an_anonymous_fold_file(tmp_path):
    """Shuffled, turned over, standing in the xz plane, without faces: the same pattern."""
    rng = np.random.default_rng(4)
    order = rng.permutation(len(SHEET.flat))
    place = np.argsort(order)
    standing = SHEET.flat[order][:, [0, 2, 1]] + [3.0, -2.0, 7.0]
    keep = GRID.assignments != "F"
    edges = place[GRID.edges[keep]]
    mix = rng.permutation(len(edges))
    data = plain_fold(
        vertices_coords=standing.tolist(),
        edges_vertices=edges[mix][:, ::-1].tolist(),
        edges_assignment=[k.lower() for k in GRID.assignments[keep][mix]],
        faces_vertices=None,
    )
    mesh = read_fold_data(tmp_path, data)
    assert len(mesh.panels) == PANELS and mesh.components.max() == 0
    assert all(measure_area(mesh.flat[row][:, :2]) > 0 for row in mesh.panels)
    length = np.linalg.norm(mesh.flat[edges[:, 0]] - mesh.flat[edges[:, 1]], axis=1)
    due = np.linalg.norm(standing[edges[:, 0]] - standing[edges[:, 1]], axis=1)
    assert length == pytest.approx(due, abs=1e-12)
    assert sum(mesh.assignments == "M") == sum(GRID.assignments == "M")
    assert any("turned into the plane" in note for note in mesh.notes)
    assert [len(loop) for loop in mesh.borders] == [14]


def test_frames_inherit_and_a_folded_form_may_stand_first(tmp_path):
    frames = [
        {"frame_parent": 0, "frame_inherit": True, "vertices_coords": SHEET.flat[:, :2].tolist()}
    ]
    data = plain_fold(vertices_coords=SHEET.rest.tolist(), frame_classes=["foldedForm"],
                      file_frames=frames)  # fmt: skip
    mesh = read_fold_data(tmp_path, data)
    assert np.array_equal(mesh.folded, SHEET.rest)
    assert np.array_equal(mesh.flat[:, :2], SHEET.flat[:, :2])


def test_units_are_read_agreed_on_and_refused(tmp_path):
    flat = np.ptp(SHEET.flat, axis=0)
    for declared, given, factor in ((None, None, 1), (None, "mm", 1e-3), ("cm", None, 1e-2),
                                    ("in", "inch", 0.0254), ("unit", "feet", 0.3048)):  # fmt: skip
        mesh = read_fold_data(tmp_path, plain_fold(frame_unit=declared), given)
        assert np.ptp(mesh.flat, axis=0) == pytest.approx(factor * flat)
    with pytest.raises(InputError, match="declares centimetres, file_unit says metres"):
        read_fold_data(tmp_path, plain_fold(frame_unit="cm"), "m")
    with pytest.raises(InputError, match="file_unit: 'ell'"):
        read_fold_data(tmp_path, plain_fold(), "ell")


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"vertices_coords": None}, "vertices_coords: missing"),
        ({"vertices_coords": [[0, 0], [1, "1"]]}, "row 1"),
        ({"edges_vertices": [[0, 99]]}, "edges_vertices: row 0: .*0 to 19 are allowed"),
        ({"edges_assignment": ["M"]}, "one letter for each of"),
        ({"faces_vertices": [[0, 1, 1]]}, "a vertex stands twice"),
        ({"faces_vertices": [[0, 1]]}, "3 or more"),
        ({"frame_unit": "furlong"}, "frame_unit: 'furlong'"),
        ({"edges_vertices": None, "faces_vertices": None}, "edges_vertices"),
        ({"file_frames": [{"frame_parent": 1, "frame_inherit": True}]}, "frame_parent 1"),
        ({"file_frames": 7}, "file_frames"),
        ({"edges_foldAngle": [400.0] * 31}, "-360 to"),
    ],
)
def test_faults_of_fold_files_are_named(tmp_path, changes, named):
    with pytest.raises(InputError, match=named) as caught:
        read_fold_data(tmp_path, plain_fold(**changes))
    assert "\n" not in str(caught.value)


def make_roof():
    """A folded plate roof: the Miura sheet in its rest state, as polygons."""
    return Patch(SHEET.rest, GRID.quads.tolist())


def read_mesh_text(tmp_path, patch, name="a.obj", unit=None):
    path = tmp_path / name
    path.write_bytes(pack_stl(patch) if name.endswith(".stl") else write_obj(patch).encode())
    return read_panels(path, unit)


def same_panels(one, two, tolerance=1e-9):
    """Whether both hold the same panels, by their middles."""
    middles = [
        np.array(sorted(tuple(np.round(m.vertices[row].mean(axis=0), 5)) for row in m.panels))
        for m in (one, two)
    ]
    return len(one.panels) == len(two.panels) and np.abs(middles[0] - middles[1]).max() <= tolerance


def test_a_good_folded_mesh_is_taken_as_it_is(tmp_path):
    mesh = read_mesh_text(tmp_path, make_roof())
    assert mesh.notes == () and np.array_equal(mesh.folded, SHEET.rest)
    assert len(mesh.facets) == 2 * PANELS and (np.diff(mesh.facet_panel) >= 0).all()
    assert (mesh.assignments == "B").sum() == 14
    millimetres = read_mesh_text(tmp_path, Patch(1000 * SHEET.rest, GRID.quads.tolist()), unit="mm")
    assert np.abs(millimetres.folded - mesh.folded).max() < 1e-12


def test_turned_panels_are_turned_back(tmp_path):
    roof = make_roof()
    turned = [p[::-1] if k % 2 else p for k, p in enumerate(roof.polygons)]
    mesh = read_mesh_text(tmp_path, Patch(roof.vertices, turned))
    assert mesh.notes == ("6 panels turned over to face as their neighbours",)
    normal = [np.cross(*(mesh.vertices[r[[1, 2]]] - mesh.vertices[r[0]]))[2] for r in mesh.panels]
    assert min(normal) > 0


def test_hanging_vertices_are_welded(tmp_path):
    """A side of one panel is cut in two, its neighbour does not know."""
    roof = make_roof()
    a, b = GRID.quads[0][1], GRID.quads[0][2]  # shared with panel 1
    middle = len(roof.vertices)
    vertices = np.vstack([roof.vertices, roof.vertices[[a, b]].mean(axis=0)])
    first = [int(a), middle, int(b), *(int(k) for k in GRID.quads[0][[3, 0]])]
    mesh = read_mesh_text(tmp_path, Patch(vertices, [first, *roof.polygons[1:]]))
    assert "1 vertex on sides of neighbours welded in" in mesh.notes[0]
    assert sorted(np.diff(mesh.panels.starts)) == [4] * 10 + [5, 5]
    assert (find_sides(mesh.panels)[2] == 1).sum() == 14  # the border alone


def test_soups_doubles_flat_panels_and_stray_vertices_are_cleaned(tmp_path):
    roof = make_roof()
    soup = Patch(roof.vertices[np.array(roof.polygons).ravel()],
                 np.arange(4 * PANELS).reshape(-1, 4).tolist())  # fmt: skip
    shaken = soup.vertices + np.random.default_rng(1).uniform(-1e-7, 1e-7, soup.vertices.shape)
    mesh = read_mesh_text(tmp_path, Patch(shaken, soup.polygons))
    assert len(mesh.vertices) == 20 and "28 vertices merged" in mesh.notes[0]
    extra = [*roof.polygons, roof.polygons[3][::-1], [0, 1, 1, 0]]
    stray = np.vstack([[[50.0, 50, 50]], roof.vertices])
    shifted = [[k + 1 for k in p] for p in extra]
    mesh = read_mesh_text(tmp_path, Patch(stray, shifted))
    said = "; ".join(mesh.notes)
    assert "1 vertex of no panel" in said and "1 panel without area" in said
    assert "1 panel that stood twice" in said and len(mesh.panels) == PANELS


def test_triangles_of_stl_become_the_panels_again(tmp_path):
    roof = make_roof()
    shuffled = [roof.polygons[k] for k in np.random.default_rng(2).permutation(PANELS)]
    stl = read_mesh_text(tmp_path, Patch(roof.vertices, shuffled), "a.stl")
    assert same_panels(stl, read_mesh_text(tmp_path, roof), 1e-5)


@pytest.mark.parametrize(
    ("make", "named"),
    [
        (lambda v, p: (v, [*p[:5], *p[6:]]), None),
        (lambda v, p: (np.vstack([v, v[:3] + np.array([9, 0, 0])]), [*p, [20, 21, 22]]), "of 1 p"),
        (lambda v, p: (np.where(np.arange(20)[:, None] == 7, np.nan, v), p), "not finite|'nan'"),
        (lambda v, p: (v, [*p, [0, 1, 77]]), "vertex 78"),
    ],
)  # fmt: skip
def test_what_cannot_be_mended_is_refused(tmp_path, make, named):
    vertices, polygons = make(SHEET.rest, make_roof().polygons)
    if named is None:  # a panel is missing: a hole is no fault
        mesh = read_mesh_text(tmp_path, Patch(vertices, polygons))
        assert len(mesh.panels) == PANELS - 1
        return
    with pytest.raises(InputError, match=named):
        read_mesh_text(tmp_path, Patch(vertices, polygons))


def test_a_band_with_a_twist_is_refused(tmp_path):
    turn = np.linspace(0, 2 * np.pi, 13)[:-1]
    half = turn / 2
    middle = np.column_stack([3 * np.cos(turn), 3 * np.sin(turn), 0 * turn])
    out = np.column_stack([np.cos(half) * np.cos(turn), np.cos(half) * np.sin(turn), np.sin(half)])
    vertices = np.vstack([middle - out, middle + out])
    quads = [[k, k + 1, k + 13, k + 12] for k in range(11)] + [[11, 12, 0, 23]]
    with pytest.raises(InputError, match="one side only"):
        read_mesh_text(tmp_path, Patch(vertices, quads))


def test_warped_and_obtuse_panels_are_said_or_refused(tmp_path):
    roof = make_roof()
    warped = roof.vertices + np.outer(np.arange(20) == 6, [0, 0, 0.08])
    mesh = read_mesh_text(tmp_path, Patch(warped, roof.polygons))
    assert any("warped, by up to" in note for note in mesh.notes)
    flat = np.array([[0, 0, 0], [4, 0, 0], [2, 0.3, 0], [2, -2, 1.0]])
    with pytest.raises(InputError, match="angle of 163 deg"):
        read_mesh_text(tmp_path, Patch(flat, [[0, 1, 2], [1, 0, 3]]))


SQUARE = '<rect x="0" y="0" width="200" height="100" stroke="#000000"/>'


def read_svg_text(tmp_path, body, head='width="200mm" height="100mm" viewBox="0 0 200 100"'):
    path = tmp_path / "a.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" {head}>{body}</svg>')
    return read_panels(path)


def test_svg_of_other_programs(tmp_path):
    """Classes, inherited strokes, turned groups, relative paths; y runs downwards there."""
    body = (
        "<style>.m{stroke:#F00} .v , .w {stroke:rgb(0, 0, 255); fill:none}</style>"
        "<defs><path d='M0 0C1 1 2 2 3 3' stroke='#123456'/></defs><text>roof</text>"
        f'<g stroke="red" transform="translate(50,0)"><line x1="0" y1="0" x2="0" y2="100"/></g>'
        f'{SQUARE}<path class="v" d="M100,0v100"/>'
        '<g transform="rotate(90 150 50)"><path class="m" d="m 100 50 l 100 0"/></g>'
    )
    mesh = read_svg_text(tmp_path, body)
    assert len(mesh.panels) == 4
    assert np.ptp(mesh.flat, axis=0) == pytest.approx([0.2, 0.1, 0])
    inner = {
        round(float(mesh.flat[edge, 0].mean()), 9): letter
        for edge, letter in zip(mesh.edges, mesh.assignments, strict=True)
        if letter != "B"
    }
    assert inner == {0.05: "M", 0.1: "V", 0.15: "M"}


def test_lines_that_cross_overlap_and_nearly_meet(tmp_path):
    """A crossing without a vertex, a border in pieces, a crease drawn twice, a gap of 1e-6."""
    body = SQUARE + (
        '<line x1="0" y1="0" x2="200" y2="100" stroke="red"/>'
        '<line x1="0" y1="100" x2="199.9998" y2="0" stroke="blue"/>'
        '<line x1="100" y1="50" x2="0" y2="0" stroke="red"/>'
        '<line x1="0" y1="0" x2="60" y2="0" stroke="black"/>'
    )
    mesh = read_svg_text(tmp_path, body)
    assert len(mesh.panels) == 4 and len(mesh.flat) == 6  # four corners, the crossing, a foot
    counts = {letter: int((mesh.assignments == letter).sum()) for letter in "BMV"}
    assert counts == {"B": 5, "M": 2, "V": 2}


@pytest.mark.parametrize(
    ("body", "named"),
    [
        ("", "holds no line"),
        (SQUARE + '<line x1="50" y1="0" x2="50" y2="80" stroke="red"/>', "1 line end met by no"),
        (SQUARE + '<line x1="50" y1="0" x2="50" y2="100" stroke="#123456"/>', "stroke '#123456'"),
        (SQUARE + '<path d="M0 0C1 1 2 2 200 100" stroke="red"/>', "path command 'C'"),
        (SQUARE + '<circle r="5" stroke="red"/>', "straight lines are allowed"),
        (SQUARE + '<rect x="50" y="30" width="9" height="9" stroke="black"/>', "not joined"),
        (SQUARE + '<line x1="50" y1="0" x2="50" y2="100" stroke="black"/>', "border line inside"),
        (SQUARE + '<line x1="5" y1="0" x2="5" y2="100" stroke="red"/>'
         '<line x1="5" y1="0" x2="5" y2="100" stroke="blue"/>', "drawn as"),
        (SQUARE + '<path d="M0 0L" stroke="red"/>', "without its 2 numbers"),
        (SQUARE + '<line x1="5%" y2="100" stroke="red"/>', "x1"),
        ('<g transform="spin(3)"/>', "spin"),
        ('<image href="x.png"/>', "stand in the drawing themselves"),
    ],
)  # fmt: skip
def test_faults_of_svg_are_named(tmp_path, body, named):
    with pytest.raises(InputError, match=named) as caught:
        read_svg_text(tmp_path, body)
    assert str(caught.value).startswith(str(tmp_path / "a.svg"))


def write_dxf_of(path, draw, unit=4):
    document = ezdxf.new("R2010")
    document.header["$INSUNITS"] = unit
    for name, colour in (("Mountain folds", 3), ("VALLEY", 1), ("0", 7), ("walls", 4)):
        if name not in document.layers:
            document.layers.add(name, color=colour)
    space = document.modelspace()
    corners = [(0, 0), (200, 0), (200, 100), (0, 100)]
    space.add_lwpolyline(corners, close=True, dxfattribs={"layer": "0"})
    draw(space)
    document.saveas(path)
    return read_panels(path)


def test_dxf_of_other_programs(tmp_path):
    """Layers by words in their names, colours where the layer says nothing, old polylines."""

    def draw(space):
        space.add_line((50, 0), (50, 100), dxfattribs={"layer": "Mountain folds"})
        space.add_polyline2d([(100, 0), (100, 40), (100, 100)], dxfattribs={"layer": "VALLEY"})
        space.add_line((150, 0), (150, 100), dxfattribs={"layer": "0", "color": 5})
        space.add_text("roof")

    mesh = write_dxf_of(tmp_path / "a.dxf", draw)
    assert len(mesh.panels) == 4 and np.ptp(mesh.flat, axis=0)[0] == pytest.approx(0.2)
    assert mesh.notes == ("passed over: TEXT",)
    letters = [letter for letter in mesh.assignments if letter != "B"]
    assert sorted(letters) == ["M", "V", "V", "V"]


@pytest.mark.parametrize(
    ("draw", "named"),
    [
        (lambda s: s.add_arc((50, 0), 5, 0, 90), "ARC: lines and polylines"),
        (lambda s: s.add_line((50, 0), (50, 100), dxfattribs={"layer": "walls"}), "layer 'walls'"),
        (lambda s: s.add_line((50, 0, 4), (50, 100, 4)), "at height 4"),
        (lambda s: s.add_lwpolyline([(0, 0, 0, 0, 1), (50, 100)]), "with arcs"),
        (lambda s: s.add_blockref("x", (0, 0)), "explode blocks"),
    ],
)
def test_faults_of_dxf_are_named(tmp_path, draw, named):
    with pytest.raises(InputError, match=named):
        write_dxf_of(tmp_path / "a.dxf", draw)


def test_damaged_and_foreign_drawings_are_refused(tmp_path):
    for name, data, named in (
        ("a.dxf", b"AC1032\0\0", "DWG"),
        ("b.dxf", b"AutoCAD Binary DXF\r\n\x1a\0", "binary DXF"),
        ("c.dxf", b"not a drawing", "damaged"),
        ("d.svg", b"<html/>", "begins with <html>"),
        ("e.svg", b"<svg", "damaged"),
        ("f.svg", b'<!DOCTYPE a [<!ENTITY b "c">]><svg/>', "document type"),
        ("g.pdf", b"%PDF", "suffix '.pdf'"),
    ):
        (tmp_path / name).write_bytes(data)
        with pytest.raises(InputError, match=named):
            read_panels(tmp_path / name)


def test_border_loops_run_around(tmp_path):
    mesh = read_mesh_text(tmp_path, make_roof())
    (loop,) = mesh.borders
    assert len(set(loop.tolist())) == 14
    sides = {tuple(sorted(edge)) for edge in mesh.edges[mesh.assignments == "B"].tolist()}
    assert {tuple(sorted(pair)) for pair in pairwise([*loop.tolist(), int(loop[0])])} == sides
