"""FOLD files: what is written, what comes back, what is refused."""

import json
import math

import numpy as np
import pytest

from foldshell.files.errors import InputError
from foldshell.pattern.design import design_sheet
from foldshell.pattern.fold_format import describe_sheet, read_fold, write_fold
from foldshell.pattern.grid import find_hinges
from foldshell.pattern.miura import Miura
from foldshell.pattern.sheet import make_miura_sheet


@pytest.fixture
def sheet():
    return make_miura_sheet(Miura(1.3, 0.7, math.radians(60), 5, 6), frames=3)


def test_round_trip_keeps_every_number(tmp_path, sheet):
    write_fold(tmp_path / "a.fold", sheet, "trial")
    back = read_fold(tmp_path / "a.fold")
    assert np.array_equal(back.flat, sheet.flat) and np.array_equal(back.rest, sheet.rest)
    assert [frame.title for frame in back.path] == [frame.title for frame in sheet.path]
    assert all(
        np.array_equal(a.vertices, b.vertices) for a, b in zip(back.path, sheet.path, strict=True)
    )
    assert np.array_equal(back.grid.facets, sheet.grid.facets)


def test_fields_of_the_format(sheet):
    """FOLD 1.2: parallel arrays, inherited frames, degrees with valleys positive."""
    data = describe_sheet(sheet, "trial")
    edges = len(data["edges_vertices"])
    assert data["file_spec"] == 1.2 and data["frame_unit"] == "m"
    assert len(data["edges_assignment"]) == len(data["edges_foldAngle"]) == edges
    assert set(data["edges_assignment"]) == {"M", "V", "B", "F"}
    rest = data["file_frames"][0]
    assert data["edges_foldAngle"] == rest["edges_foldAngle"]  # what tools fold the flat sheet to
    assert rest["frame_parent"] == 0 and rest["frame_inherit"] is True
    for assignment, angle in zip(data["edges_assignment"], rest["edges_foldAngle"], strict=True):
        if assignment == "B":
            assert angle is None
        elif assignment == "F":
            assert abs(angle) < 1e-9
        else:
            assert (angle > 10) == (assignment == "V") and 10 < abs(angle) < 180
    json.dumps(data, allow_nan=False)


def test_valley_of_two_faces_is_positive():
    """A sheet folded like a V, open side up, is a valley by the format's definition."""
    from foldshell.pattern.angles import measure_hinges

    vertices = np.array([[0, 0, 0], [0, 1, 0], [-1, 0, 1.0], [1, 0, 1.0]])
    facets = np.array([[0, 1, 2], [1, 0, 3]])
    hinges = find_hinges(facets, np.array([[0, 1]]))
    # seen from above both facets are counter-clockwise
    for facet in facets:
        a, b, c = vertices[facet]
        assert np.cross(b - a, c - a)[2] > 0
    assert measure_hinges(vertices, hinges.vertices)[0] == pytest.approx(math.pi / 2)


def test_every_interior_vertex_obeys_maekawa(sheet):
    grid = sheet.grid
    sign = {"M": 1, "V": -1, "B": 0, "F": 0}
    total = np.zeros(len(grid.zigzag_index))
    for edge, assignment in zip(grid.edges, grid.assignments, strict=True):
        total[edge] += sign[assignment]
    inner = np.isin(grid.zigzag_index, [1, 2, 3]) & np.isin(grid.strip_index, [1, 2, 3, 4])
    assert (np.abs(total[inner]) == 2).all()
    assert (np.sign(total[inner]) == np.where(grid.zigzag_index[inner] % 2, 1, -1)).all()


def test_edges_are_unique_and_facets_lie_above(sheet):
    grid = sheet.grid
    assert len({tuple(sorted(edge)) for edge in grid.edges.tolist()}) == len(grid.edges)
    corners = sheet.rest[grid.facets]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (normals[:, 2] > 0).all()


def test_neutral_folds_are_the_shorter_diagonals(sheet):
    grid = sheet.grid
    corners = sheet.flat[grid.quads]
    both = np.linalg.norm(corners[:, [2, 3]] - corners[:, [0, 1]], axis=2)
    ends = sheet.flat[grid.edges[grid.neutral]]
    assert np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) == pytest.approx(both.min(axis=1))


@pytest.mark.parametrize("pattern", ["smooth", "flat"])
def test_baselines_round_trip(tmp_path, pattern):
    sheet = design_sheet(pattern, (30.0, 28.0), 5, 6, 60.0)
    write_fold(tmp_path / "a.fold", sheet, pattern)
    back = read_fold(tmp_path / "a.fold")
    assert back.kind == pattern and np.array_equal(back.flat, sheet.flat)


@pytest.mark.parametrize(
    ("change", "named"),
    [
        (lambda d: d.pop("foldshell:zigzag"), "foldshell:zigzag"),
        (lambda d: d.update({"foldshell:strip": ["a"]}), "foldshell:strip"),
        (lambda d: d["vertices_coords"].pop(), "vertices_coords"),
        (lambda d: d["vertices_coords"][0].__setitem__(0, "x"), "vertices_coords"),
        (lambda d: d["faces_vertices"][0].reverse(), "faces_vertices"),
        (lambda d: d["edges_assignment"].__setitem__(12, "M"), "edges_assignment"),
    ],
)
def test_damaged_files_are_refused_by_name(tmp_path, sheet, change, named):
    data = json.loads(json.dumps(describe_sheet(sheet, "trial")))
    change(data)
    (tmp_path / "a.fold").write_text(json.dumps(data))
    with pytest.raises(InputError, match=named):
        read_fold(tmp_path / "a.fold")


def test_what_is_not_json_is_refused(tmp_path):
    (tmp_path / "a.fold").write_text('{"file_spec": 1.2, "vert')
    with pytest.raises(InputError, match="not JSON"):
        read_fold(tmp_path / "a.fold")
    with pytest.raises(InputError, match="no such file"):
        read_fold(tmp_path / "b.fold")
