"""A study of the project on a Slurm of one node: few submissions, the files of `--cores 2`, and the
same where it is killed there in the middle and ended here.

`FOLDSHELL_CLUSTER_STUDY` names the study (supports; table1 takes an hour on two cores), and
`FOLDSHELL_CLUSTER_RESULTS` a folder of its results by this version, made on this machine with the
same SOURCE_DATE_EPOCH (`MINUTE`): the report names the minute of its making.
"""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from one_node_slurm import count_submissions, one_node, why_not

REPOSITORY = Path(__file__).parents[2]
sys.path.insert(0, str(REPOSITORY / "tests/workflow"))

from study_runner import copy_code, results, run  # noqa: E402

STUDY = os.environ.get("FOLDSHELL_CLUSTER_STUDY", "supports")
KNOWN = os.environ.get("FOLDSHELL_CLUSTER_RESULTS", "")
OPTIONS = ("--config", f"study={STUDY}")
SUBMISSIONS_MAX = 90
MINUTE = "1700000000"

pytest.importorskip("snakemake_executor_plugin_slurm")
pytestmark = [
    pytest.mark.cluster,
    pytest.mark.slow,
    pytest.mark.skipif(bool(why_not()), reason=why_not() or "-"),
]


@pytest.fixture(scope="module", autouse=True)
def minute():
    """Let every report be of the same minute."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("SOURCE_DATE_EPOCH", MINUTE)
        yield


@pytest.fixture(scope="module")
def slurm(tmp_path_factory):
    """Return the folder of a running Slurm."""
    folder = tmp_path_factory.mktemp("slurm")
    with one_node(folder):
        yield folder


@pytest.fixture(scope="module")
def here(tmp_path_factory):
    """Return {name: SHA-256} of the results of two cores of this machine."""
    folder = copy_code(tmp_path_factory.mktemp("here"))
    if KNOWN:
        (folder / "results").symlink_to(Path(KNOWN).resolve())
        return what_counts(folder)
    done = run(folder, folder, *OPTIONS)
    assert done.returncode == 0, done.stderr[-3000:]
    return what_counts(folder)


def what_counts(folder):
    """Return the results {name: SHA-256}, less times and the copies that are left at the end."""
    left_out = ("timings.csv", "copies.json")
    return {
        name: digest
        for name, digest in results(folder).items()
        if not name.endswith(left_out) and name.count("/") > 1
    }


def submit(folder):
    """Start the study with the profile of Slurm, as the head of a process group of its own."""
    program = [sys.executable, "-m", "snakemake", "--profile", "profiles/slurm", *OPTIONS]
    with (folder / "run.log").open("w") as log:
        streams = {"stdout": log, "stderr": log, "start_new_session": True}
        return subprocess.Popen(program, cwd=folder, **streams)


def end_jobs():
    command = ["squeue", "-h", "-o", "%i"]
    while jobs := subprocess.run(
        command, capture_output=True, text=True, check=True
    ).stdout.split():
        subprocess.run(["scancel", *jobs], capture_output=True)
        time.sleep(0.5)


def test_on_the_cluster_alone(slurm, here, tmp_path):
    folder = copy_code(tmp_path / "study")
    before = count_submissions(slurm)
    assert submit(folder).wait() == 0, (folder / "run.log").read_text()[-3000:]
    assert what_counts(folder) == here
    assert count_submissions(slurm) - before <= SUBMISSIONS_MAX


def test_killed_in_the_middle_and_ended_here(slurm, here, tmp_path):
    """Once half of the designs are sized. What the head had not yet seen ended, up to one round of
    asking for states, is made again: the same files, not the same times."""
    folder = copy_code(tmp_path / "study")
    designs = {Path(name).parts[1] for name in here if name.endswith("/sizing/final.json")}
    before = count_submissions(slurm)
    process = submit(folder)
    while process.poll() is None:
        sized = [d for d in designs if (folder / f"results/{d}/sizing/final.json").exists()]
        if len(sized) > len(designs) / 2:
            break
        time.sleep(0.2)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    end_jobs()
    shutil.rmtree(folder / ".snakemake/locks", ignore_errors=True)
    done = run(folder, folder, *OPTIONS)
    assert done.returncode == 0, done.stderr[-3000:]
    assert what_counts(folder) == here
    assert count_submissions(slurm) - before <= SUBMISSIONS_MAX
