"""Entry script of rule unfold."""

import json

import ezdxf
import numpy as np
import pytest

import fold
import pattern
import unfold
from entry_defaults import DRAWINGS, fold_parameters, pattern_parameters
from foldshell.files.errors import InputError
from foldshell.files.whole import read_arrays
from foldshell.pattern.fold_format import read_fold


def _run(folder, mode):
    pattern.main(
        folder / "a.fold", design="x", **pattern_parameters(surface="hypar", zigzag=8, strip=9)
    )
    fold.main(
        folder / "a.fold", folder / "f.npz", folder / "f.vtu", folder / "q.json",
        design="x", **fold_parameters(surface="hypar", fold_mode=mode),
    )  # fmt: skip
    unfold.main(
        folder / "a.fold", folder / "f.npz", folder / "t.fold", folder / "t.dxf",
        folder / "t.svg", design="x", fold_mode=mode, settings=DRAWINGS,
    )  # fmt: skip
    return read_arrays(folder / "f.npz"), read_fold(folder / "t.fold")


def test_rigid_pattern_and_path_are_written(tmp_path):
    folded, sheet = _run(tmp_path, "rigid")
    assert json.loads((tmp_path / "q.json").read_text())["state"] == "ok"
    assert np.array_equal(sheet.flat[:, :2], folded["flat"][:, :2])
    assert len(sheet.path) == 10 and sheet.path[-1].title == "folded"
    assert np.ptp(sheet.path[0].vertices[:, 2]) < 1e-9  # starts flat
    assert sheet.settings == {}  # the given sheet's sides and angle are not those of this one
    lengths = [
        np.linalg.norm(np.diff(frame.vertices[sheet.grid.edges], axis=1), axis=-1)
        for frame in sheet.path
    ]
    assert all(np.abs(one - lengths[0]).max() < 1e-9 for one in lengths)
    # No state jumps: the last step onto the folded sheet is like the steps before it.
    steps = [
        np.linalg.norm(b.vertices - a.vertices, axis=1).max()
        for a, b in zip(sheet.path, sheet.path[1:], strict=False)
    ]
    assert steps[-1] < 1.2 * max(steps[:-1])
    assert (
        np.abs(sheet.path[0].vertices.mean(axis=0) - folded["vertices"].mean(axis=0)).max() < 1e-9
    )
    assert len(ezdxf.readfile(tmp_path / "t.dxf").modelspace().query("LINE")) > 50


def test_soft_sheet_has_no_rigid_path(tmp_path):
    folded, sheet = _run(tmp_path, "elastic")
    title = json.loads((tmp_path / "t.fold").read_text())["file_title"]
    assert "given pattern" in title and "stretch" in title
    assert "given pattern" in (tmp_path / "t.svg").read_text()
    assert [frame.title for frame in sheet.path] == ["folded"]
    assert sheet.settings == read_fold(tmp_path / "a.fold").settings
    assert np.array_equal(sheet.path[0].vertices, folded["vertices"])


def test_folded_sheet_of_another_design_is_refused(tmp_path):
    _run(tmp_path, "elastic")
    pattern.main(tmp_path / "b.fold", design="y", **pattern_parameters(zigzag=5, strip=6))
    with pytest.raises(InputError, match="must be 30"):
        unfold.main(
            tmp_path / "b.fold", tmp_path / "f.npz", tmp_path / "u.fold", tmp_path / "u.dxf",
            tmp_path / "u.svg", design="y", fold_mode="exact", settings=DRAWINGS,
        )  # fmt: skip
    assert not (tmp_path / "u.fold").exists()
