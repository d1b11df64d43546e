"""Random damage to FOLD files: a refusal in one sentence, or just the numbers that stand there."""

import functools
import io
import json
import math

import ezdxf
import numpy as np
import pytest
from hypothesis import given, settings

from foldshell.files.errors import InputError
from foldshell.pattern.fold_format import describe_sheet, read_fold
from foldshell.pattern.miura import Miura
from foldshell.pattern.read_panels import read_panels
from foldshell.pattern.sheet import make_miura_sheet
from fuzzing import (
    BYTE_EDITS,
    FUZZ,
    LINE_EDITS,
    TREE_EDITS,
    edit_bytes,
    edit_lines,
    edit_tree,
    is_one_sentence,
)

SHEET = make_miura_sheet(Miura(0.9, 0.7, math.radians(63), 3, 4), 1)
TREE = json.loads(json.dumps(describe_sheet(SHEET, "small")))
TEXT = json.dumps(TREE)


def check_fold(path, data):
    path.write_bytes(data)
    try:
        sheet = read_fold(path)
    except InputError as error:
        assert is_one_sentence(error, path), str(error)[:500]
        return
    tree = json.loads(data.decode("utf-8-sig"))
    flat = np.array(tree["vertices_coords"], dtype=float)
    assert np.array_equal(sheet.flat[:, : flat.shape[1]], flat)
    assert not sheet.flat[:, flat.shape[1] :].any()
    assert sheet.grid.edges.tolist() == tree["edges_vertices"]
    assert sheet.grid.facets.tolist() == tree["faces_vertices"]
    assert sheet.grid.assignments.tolist() == tree["edges_assignment"]
    frames = [
        np.array(frame["vertices_coords"], dtype=float) for frame in tree.get("file_frames", [])
    ]
    held = [sheet.rest, *(frame.vertices for frame in sheet.path)]
    assert all(any(np.array_equal(k[:, : f.shape[1]], f) for k in held) for f in frames)


def write_tree(edits):
    tree = edit_tree(TREE, edits)
    return json.dumps(tree).encode("utf-8", "surrogatepass")


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("[" * 100_000, "nested too deeply|not JSON"),
        ('{"a": ' + "9" * 5000 + "}", "not JSON"),
        ('{"vertices_coords": NaN}', "NaN: finite numbers"),
        ('{"a": 1, "a": 2}', "stands twice"),
        (TEXT.replace('"vertices_coords": [[0.0', '"vertices_coords": [["0.0"', 1), "coordinates"),
        (TEXT.replace('"vertices_coords": [[0.0', '"vertices_coords": [[true', 1), "coordinates"),
        (TEXT.replace('"foldshell:zigzag": [0', '"foldshell:zigzag": [900000000', 1), "as many"),
        (TEXT.replace('"foldshell:zigzag": [0', f'"foldshell:zigzag": [{10**30}', 1), "integers"),
        (TEXT.replace('"file_frames": [', '"file_frames": [7, ', 1), "frame 1: 7: an object"),
        (TEXT.replace('"miura"', '"yoshimura"'), "one of miura"),
    ],
)
def test_each_kind_is_named(tmp_path, text, named):
    (tmp_path / "a.fold").write_text(text)
    with pytest.raises(InputError, match=named) as caught:
        read_fold(tmp_path / "a.fold")
    assert is_one_sentence(caught.value, tmp_path / "a.fold")


@settings(max_examples=100, **FUZZ)
@given(edits=TREE_EDITS)
def test_values(tmp_path, edits):
    check_fold(tmp_path / "a.fold", write_tree(edits))


@settings(max_examples=60, **FUZZ)
@given(edits=BYTE_EDITS)
def test_bytes(tmp_path, edits):
    check_fold(tmp_path / "a.fold", edit_bytes(TEXT.encode(), edits))


@pytest.mark.slow
@settings(max_examples=1000, **FUZZ)
@given(edits=TREE_EDITS)
def test_values_at_length(tmp_path, edits):
    check_fold(tmp_path / "a.fold", write_tree(edits))


@pytest.mark.slow
@settings(max_examples=700, **FUZZ)
@given(edits=BYTE_EDITS)
def test_bytes_at_length(tmp_path, edits):
    check_fold(tmp_path / "a.fold", edit_bytes(TEXT.encode(), edits))


SVG = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="200mm" viewBox="0 0 200 100">\n'
    '<style>.m {stroke: #f00}</style>\n<g transform="translate(1, 2) rotate(90)" stroke="blue">\n'
    '<line x1="50" y1="0" x2="50" y2="100"/>\n<path class="m" d="M 0 0 L 200 100 h 3 z"/>\n</g>\n'
    '<polygon points="0,0 200,0 200,100 0,100" stroke="black"/>\n</svg>\n'
)


@functools.cache
def dxf_text():
    """A small drawing."""
    document = ezdxf.new("R2010")
    document.layers.add("MOUNTAIN", color=1)
    space = document.modelspace()
    space.add_lwpolyline([(0, 0), (2, 0), (2, 1), (0, 1)], close=True)
    space.add_line((1, 0), (1, 1), dxfattribs={"layer": "MOUNTAIN"})
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue()


def check_panels(path, data):
    path.write_bytes(data)
    try:
        mesh = read_panels(path)
    except InputError as error:
        assert is_one_sentence(error, path), str(error)[:500]
        return
    assert np.isfinite(mesh.vertices).all() and len(mesh.panels)
    assert len(mesh.edges) == len(mesh.assignments) == len(mesh.fold_angles)


def check_drawings(tmp_path, edits, lines):
    check_panels(tmp_path / "a.svg", edit_lines(SVG, lines).encode("utf-8", "surrogatepass"))
    check_panels(tmp_path / "b.svg", edit_bytes(SVG.encode(), edits))
    check_panels(tmp_path / "a.dxf", edit_lines(dxf_text(), lines).encode("utf-8", "surrogatepass"))
    check_panels(tmp_path / "a.fold", edit_bytes(TEXT.encode(), edits))


@settings(max_examples=15, **FUZZ)
@given(edits=BYTE_EDITS, lines=LINE_EDITS)
def test_drawings(tmp_path, edits, lines):
    check_drawings(tmp_path, edits, lines)


@settings(max_examples=60, **FUZZ)
@given(edits=TREE_EDITS)
def test_values_of_any_fold(tmp_path, edits):
    check_panels(tmp_path / "a.fold", write_tree(edits))


@pytest.mark.slow
@settings(max_examples=250, **FUZZ)
@given(edits=BYTE_EDITS, lines=LINE_EDITS)
def test_drawings_at_length(tmp_path, edits, lines):
    check_drawings(tmp_path, edits, lines)


@pytest.mark.slow
@settings(max_examples=1000, **FUZZ)
@given(edits=TREE_EDITS)
def test_values_of_any_fold_at_length(tmp_path, edits):
    check_panels(tmp_path / "a.fold", write_tree(edits))
