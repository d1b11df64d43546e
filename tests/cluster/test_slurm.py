"""On a Slurm of one node: the files of a run on this machine, a sentence for what goes wrong."""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import openpyxl
import pytest
from one_node_slurm import count_submissions, one_node, why_not

REPOSITORY = Path(__file__).parents[2]
sys.path.insert(0, str(REPOSITORY / "tests/workflow"))

from study_runner import DESIGNS, TARGET, copy_code, make_study, results, run  # noqa: E402

pytest.importorskip("snakemake_executor_plugin_slurm")
pytestmark = [
    pytest.mark.cluster,
    pytest.mark.slow,
    pytest.mark.skipif(bool(why_not()), reason=why_not() or "-"),
]
ONE = DESIGNS.splitlines(keepends=True)[0]
LOOP = "results/tiny-dome/sizing"
TARGETS = TARGET, "results/tiny-dome/manifest.json"
CLASSES = "results/tiny-saddle/sizing/classes.json"
"""By rules made where they are asked for, in one job always."""


@pytest.fixture(scope="module")
def slurm(tmp_path_factory):
    """Return the folder of a running Slurm."""
    folder = tmp_path_factory.mktemp("slurm")
    with one_node(folder):
        yield folder


@pytest.fixture(scope="module")
def code(tmp_path_factory):
    return copy_code(tmp_path_factory.mktemp("code"))


@pytest.fixture(scope="module")
def here(code, tmp_path_factory):
    """Return the folder of a study that has run on two cores of this machine."""
    folder = make_study(tmp_path_factory.mktemp("here"))
    done = run(code, folder, *TARGETS, CLASSES)
    assert done.returncode == 0, done.stderr[-3000:]
    return folder


def submit(code, folder, *arguments):
    """Start Snakemake with the profile of Slurm, as the head of a process group of its own."""
    program = [sys.executable, "-m", "snakemake", "-s", str(code / "Snakefile"), *TARGETS]
    program += ["--profile", str(code / "profiles/slurm"), "--latency-wait", "10"]
    program += ["--slurm-init-seconds-before-status-checks", "2", *arguments]
    streams = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True}
    return subprocess.Popen(program, cwd=folder, start_new_session=True, **streams)


def finish(process):
    """Wait for the end; return the exit code and what was said."""
    said = process.communicate(timeout=900)[1]
    return process.returncode, said


def wait_for(path, process):
    while not path.exists() and process.poll() is None:
        time.sleep(0.05)
    assert path.exists(), process.communicate()[1][-3000:]


def running_jobs():
    listed = subprocess.run(
        ["squeue", "-h", "-t", "R", "-o", "%i"], capture_output=True, text=True, check=True
    )
    return listed.stdout.split()


def stop_processes(job):
    """Let every process of a job wait for ever."""
    for path in Path("/proc").glob("[0-9]*/environ"):
        try:
            mine = f"SLURM_JOB_ID={job}".encode() in path.read_bytes().split(b"\0")
        except OSError:
            continue
        if mine and "slurmstepd" not in path.with_name("cmdline").read_text():
            os.kill(int(path.parent.name), signal.SIGSTOP)


def asked_memory():
    """Return the memory (MB) of each submission so far, in their order."""
    command = ["squeue", "-h", "-t", "all", "-o", "%i %m"]
    listed = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
    pairs = zip(map(int, listed[::2]), listed[1::2], strict=True)
    return [float(memory.rstrip("M")) for _, memory in sorted(pairs)]


def sentences(said):
    return [line for line in said.splitlines() if " of the cluster " in line]


def test_files_are_those_of_this_machine_and_submissions_few(slurm, code, here, tmp_path):
    """Two for each design and one for the study, each with one Snakemake for all its rules."""
    before = count_submissions(slurm)
    folder = make_study(tmp_path / "study")
    code_, said = finish(submit(code, folder, "--slurm-keep-successful-logs"))
    assert code_ == 0, said[-3000:]
    assert count_submissions(slurm) - before == 2 * 2 + 1
    logs = [path.read_text() for path in (folder / ".snakemake/slurm_logs").rglob("*.log")]
    assert [log.count("Snakemake version") for log in logs] == [1] * 5
    assert results(folder) == results(here)
    code_, said = finish(submit(code, folder))
    assert code_ == 0 and "Nothing to be done" in said


def test_killed_there_and_ended_here(slurm, code, here, tmp_path):
    folder = make_study(tmp_path / "study")
    process = submit(code, folder)
    wait_for(folder / LOOP / "01/thickness.xlsx", process)
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
    subprocess.run(["scancel", *running_jobs()], check=True)
    while running_jobs():
        time.sleep(0.2)
    shutil.rmtree(folder / ".snakemake/locks", ignore_errors=True)
    done = run(code, folder, *TARGETS, CLASSES)
    assert done.returncode == 0, done.stderr[-3000:]
    assert results(folder) == results(here)


def test_a_cancelled_job_and_one_that_takes_too_long(slurm, code, tmp_path):
    folder = make_study(tmp_path / "study", ONE)
    times = [*(f"{rule}:runtime=0" for rule in ("pattern", "fold", "mesh")), "size:runtime=1"]
    process = submit(code, folder, "--retries", "1", "--set-resources", *times)
    wait_for(folder / "results/tiny-dome/pattern/crease_pattern.fold", process)
    subprocess.run(["scancel", *running_jobs()], check=True)
    while not (jobs := running_jobs()) and process.poll() is None:
        time.sleep(0.2)
    time.sleep(2)
    stop_processes(jobs[0])
    code_, said = finish(process)
    assert len(sentences(said)) == 2, said[-3000:]
    first, second = sentences(said)
    assert code_ and first.startswith("tiny-dome: job") and "was cancelled" in first
    assert "took longer than was asked for" in second


def test_a_job_that_takes_too_much_memory(slurm, code, tmp_path):
    folder = make_study(tmp_path / "study", ONE)
    needs = [f"{rule}:mem_mb=60" for rule in ("pattern", "fold", "mesh", "size")]
    code_, said = finish(submit(code, folder, "--retries", "0", "--set-resources", *needs))
    assert len(sentences(said)) == 1, said[-3000:]
    (sentence,) = sentences(said)
    assert code_ and "took more memory than was asked for" in sentence


def test_a_job_that_fails_says_why_and_a_retry_gets_more_memory(slurm, code, here, tmp_path):
    folder = tmp_path / "study"
    shutil.copytree(here, folder, symlinks=True)
    path = folder / LOOP / "01/thickness.xlsx"
    book = openpyxl.load_workbook(path)
    book["thickness"]["D5"].value = "thick"
    book.save(path)
    code_, said = finish(submit(code, folder, "--retries", "1"))
    assert len(sentences(said)) == 2, said[-3000:]
    first, second = sentences(said)
    assert code_ and "tiny-dome: job" in first and "failed: " in first and "D5" in second
    once, twice = asked_memory()[-2:]
    assert twice == 2 * once
