"""Files are whole or absent, and what a killed writer leaves behind does not stay."""

import os
import subprocess
import sys

import pytest

from foldshell.files.whole import atomic_path


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
