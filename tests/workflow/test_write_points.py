"""Killed after every single write of every rule, a study goes on and ends with the same bytes."""

import json
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


def list_jobs(folder):
    """Return the files of every job, as relative paths, in the order in which jobs ended: all that
    it wrote, its record, and last the output that others wait for."""
    jobs = []
    for record in sorted(folder.glob("results/**/jobs/*.json"), key=lambda p: p.stat().st_mtime_ns):
        home = record.parents[1].relative_to(folder)
        awaited, *others = (str(home / name) for name in json.loads(record.read_text())["outputs"])
        jobs.append([*others, str(record.relative_to(folder)), awaited])
    return jobs


def kill_after(code, folder, file, loop):
    """Start, with a kill of everything once `file` has been written; tell whether it came to it."""
    process = subprocess.Popen(
        [*command(code, *targets()), "--cores", "1", "--config", f"loop={loop}"],
        cwd=folder,
        env=os.environ | {"FOLDSHELL_FAULT_POINT": file},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    code = process.wait()
    shutil.rmtree(folder / ".snakemake/locks", ignore_errors=True)
    return code == -9


@pytest.mark.parametrize("loop", ["steps", "whole"])
def test_a_kill_after_any_write_loses_nothing(code, whole, tmp_path, loop):
    folder = make_study(tmp_path / "killed", ONE)
    writes = [file for files in list_jobs(whole) for file in files]
    passed = [file for file in writes if not kill_after(code, folder, file, loop)]
    # The independent code writes its files itself; jobs side by side may end in another order.
    assert len(writes) > 70 and len(passed) < 0.15 * len(writes), passed
    done = run(code, folder, *targets(), "--config", f"loop={loop}")
    assert done.returncode == 0, done.stderr[-3000:]
    assert results(folder) == results(whole)
