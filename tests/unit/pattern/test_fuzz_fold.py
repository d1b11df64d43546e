"""Random damage to FOLD files: a refusal in one sentence, or just the numbers that stand there."""

import json
import math

import numpy as np
import pytest
from hypothesis import given, settings

from foldshell.files.errors import InputError
from foldshell.pattern.fold_format import describe_sheet, read_fold
from foldshell.pattern.miura import Miura
from foldshell.pattern.sheet import make_miura_sheet
from fuzzing import BYTE_EDITS, FUZZ, TREE_EDITS, edit_bytes, edit_tree, is_one_sentence

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
