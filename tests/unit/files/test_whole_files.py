"""Files are whole or absent, and what a killed writer leaves behind does not stay."""

import os
import subprocess
import sys

import numpy as np
import pytest

from foldshell.files.whole import atomic_path, held_back, read_json, write_arrays, write_json


def test_a_block_that_raises_leaves_the_older_file_and_nothing_else(tmp_path):
    path = tmp_path / "a.json"
    path.write_text("old")
    with pytest.raises(RuntimeError), atomic_path(path) as temporary:
        temporary.write_text("ne")
        raise RuntimeError
    assert path.read_text() == "old" and os.listdir(tmp_path) == ["a.json"]


def test_what_a_killed_writer_left_is_removed_but_not_what_another_still_writes(tmp_path):
    gone = subprocess.Popen([sys.executable, "-c", ""])
    gone.wait()
    alive = os.getppid()
    names = [f".writing-{gone.pid}-a.xlsx", f".writing-{alive}-a.xlsx", f".writing-{gone.pid}-b"]
    for name in names:
        (tmp_path / name).write_text("half")
    with atomic_path(tmp_path / "a.xlsx") as temporary:
        assert temporary.suffix == ".xlsx"
        temporary.write_text("whole")
    assert sorted(os.listdir(tmp_path)) == sorted([*names[1:], "a.xlsx"])
    assert (tmp_path / "a.xlsx").stat().st_mode & 0o777 == 0o666 & ~current_umask()


def current_umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def test_a_file_held_back_comes_into_place_after_all_others(tmp_path):
    """What others wait for is there only once everything else is."""
    awaited, other = tmp_path / "analysis.json", tmp_path / "analysis.npz"
    with held_back(awaited) as content:
        write_json(awaited, {"x": 1})
        write_arrays(other, {"x": np.ones(2)})
        assert not awaited.exists() and other.exists()
        assert read_json(content()) == {"x": 1}
    assert read_json(awaited) == {"x": 1} and len(list(tmp_path.iterdir())) == 2


def test_a_block_that_raises_leaves_what_stood_there(tmp_path):
    awaited = tmp_path / "analysis.json"
    write_json(awaited, {"x": 0})
    with pytest.raises(RuntimeError), held_back(awaited):
        write_json(awaited, {"x": 1})
        raise RuntimeError
    assert read_json(awaited) == {"x": 0} and len(list(tmp_path.iterdir())) == 1
