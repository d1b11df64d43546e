"""Killed after every single write of every rule, a study goes on and ends with the same bytes."""

import os
import shutil
import subprocess

import pytest
from study_runner import DESIGNS, TARGET, command, make_study, results, run

pytestmark = [pytest.mark.slow, pytest.mark.workflow]

ONE = DESIGNS.splitlines(keepends=True)[0]


@pytest.fixture(scope="module")
def whole(code, tmp_path_factory):
    """Return the folder of one design that has run undisturbed to its summary and manifest."""
    folder = make_study(tmp_path_factory.mktemp("whole"), ONE)
    done = run(code, folder, *targets(), "--cores", "1")
    assert done.returncode == 0, done.stderr[-3000:]
    return folder


def targets():
    return TARGET, "results/tiny-dome/manifest.json"


def written_files(folder):
    """Return the relative paths of all results, in the order in which they were written."""
    files = [path for path in (folder / "results").rglob("*") if path.is_file()]
    files = [path for path in files if "benchmarks" not in path.parts and "logs" not in path.parts]
    files.sort(key=lambda path: path.stat().st_mtime_ns)
    return [path.relative_to(folder).as_posix() for path in files]


def kill_after(code, folder, file):
    """Start, with a kill of everything once `file` has been written; tell whether it came to it."""
    process = subprocess.Popen(
        [*command(code, *targets()), "--cores", "1"],
        cwd=folder,
        env=os.environ | {"FOLDSHELL_FAULT_POINT": file},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    code = process.wait()
    shutil.rmtree(folder / ".snakemake/locks", ignore_errors=True)
    return code == -9


def test_a_kill_after_any_write_loses_nothing(code, whole, tmp_path):
    folder = make_study(tmp_path / "killed", ONE)
    files = written_files(whole)
    kills = sum(kill_after(code, folder, file) for file in files if not (folder / file).exists())
    assert kills > 0.8 * len(files)
    done = run(code, folder, *targets(), "--cores", "1")
    assert done.returncode == 0, done.stderr[-3000:]
    assert results(folder) == results(whole)
