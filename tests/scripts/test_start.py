"""Entry script of rule start."""

import numpy as np
import pytest

import start
from foldshell.records.edits import is_edited
from foldshell.workbook.panels import make_panel_grid
from foldshell.workbook.read_thickness import read_thickness
from sizing_case import stage


def _run(folder, **values):
    known = {
        "design": "small", "zigzag": 4, "strip": 5, "settings": stage("start", **values),
        "settings_hash": "0" * 12,
    }  # fmt: skip
    start.main(folder / "00/thickness.xlsx", folder / "00/written.json", **known)
    return folder / "00/thickness.xlsx"


def test_every_panel_starts_alike(tmp_path):
    """The workbook gives back what was asked for, bit by bit, and counts as not edited."""
    path = _run(tmp_path, start_thickness=0.1 + 0.2 / 7)
    read = read_thickness(path, make_panel_grid(4, 5), 0.04, 1.0)
    assert np.array_equal(read, np.full(12, round(0.1 + 0.2 / 7, 12)))
    assert not is_edited(path)
    assert sorted(p.name for p in path.parent.iterdir()) == ["thickness.xlsx", "written.json"]


def test_same_values_same_bytes(tmp_path):
    assert _run(tmp_path / "a").read_bytes() == _run(tmp_path / "b").read_bytes()


def test_start_outside_the_bounds_writes_nothing(tmp_path):
    with pytest.raises(ValueError, match=r"0\.04"):
        _run(tmp_path, start_thickness=0.03)
    assert not (tmp_path / "00/thickness.xlsx").exists()
