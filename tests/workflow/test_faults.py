"""A tiny study under faults: kills, Ctrl-C, a full disk, a second start, other settings."""

import contextlib
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest
from study_runner import (
    TARGET,
    change_setting,
    command,
    find_jobs,
    make_study,
    results,
    run,
    run_and_kill,
    run_until_files,
)

pytestmark = pytest.mark.slow

ONE_DESIGN = "results/tiny-dome/design.xlsx"
KILLS = 100


def end_like(code, folder, other):
    """Run a study to its end, and compare all its results with those of another folder."""
    done = run(code, folder, TARGET)
    assert done.returncode == 0, done.stderr[-3000:]
    assert results(folder) == results(other)


def remove_locks(folder):
    """Do what `snakemake --unlock` does, without the start of another Snakemake."""
    shutil.rmtree(folder / ".snakemake/locks", ignore_errors=True)


def kill_something(process, chance):
    """Kill by signal 9 the scheduler with its jobs, the scheduler alone, or one job."""
    jobs = find_jobs(process)
    victim = chance.choice(["all", "scheduler", "job"])
    try:
        if victim == "job" and jobs:
            os.kill(chance.choice(jobs), signal.SIGKILL)
            process.wait()
        elif victim == "scheduler":
            os.kill(process.pid, signal.SIGKILL)
        else:
            os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        return None
    process.wait()
    return victim


def test_a_hundred_kills_leave_the_results_of_an_undisturbed_run(code, finished, tmp_path):
    """Scheduler and jobs die at random moments until the study is done; then another one."""
    chance, kills, studies = random.Random(5), 0, 0
    while kills < KILLS:
        studies += 1
        folder = make_study(tmp_path / f"killed{studies}")
        while kills < KILLS and not (folder / TARGET).exists():
            moment = chance.randrange(1, 6), chance.uniform(0, 0.4)
            process = run_until_files(code, folder, *moment, TARGET)
            if process.poll() is None and kill_something(process, chance):
                kills += 1
            remove_locks(folder)
        end_like(code, folder, finished)


def test_after_ctrl_c_the_next_start_goes_on(code, finished, tmp_path):
    """Snakemake takes its lock away; what a stopped job had begun is not taken as done."""
    folder = make_study(tmp_path / "stopped")
    process = run_until_files(code, folder, 12, 0.1, TARGET)
    os.killpg(process.pid, signal.SIGINT)
    assert process.wait() != 0
    end_like(code, folder, finished)


def test_a_second_start_is_refused_and_harms_nothing(code, finished, tmp_path):
    folder = make_study(tmp_path / "twice")
    first = run_until_files(code, folder, 3, 0, TARGET)
    second = run(code, folder, TARGET)
    assert second.returncode != 0
    assert "cannot be locked" in second.stderr and "--unlock" in second.stderr
    assert first.wait() == 0
    assert results(folder) == results(finished)


def test_a_full_disk_is_said_and_nothing_is_lost_once_it_is_freed(code, finished, tmp_path):
    """A limit on the size of files stands for a disk without space."""
    folder, limit = make_study(tmp_path / "full"), (20_000, 20_000)
    done = subprocess.run(
        command(code, TARGET),
        cwd=folder,
        capture_output=True,
        text=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, limit),
    )
    assert done.returncode != 0
    assert "free some space and start again" in done.stderr
    assert not list((folder / "results").rglob(".writing-*"))
    end_like(code, folder, finished)


def test_settings_changed_half_way_give_what_they_give_from_scratch(code, tmp_path):
    """Iterations that were sized by the old settings are not mixed with new ones."""
    folder, fresh = make_study(tmp_path / "changed"), make_study(tmp_path / "fresh")
    run_and_kill(code, folder, folder / "results/tiny-dome/sizing/02/thickness.xlsx", ONE_DESIGN)
    remove_locks(folder)
    for place in (folder, fresh):
        change_setting(place, "sizing", "step", 0.2)
        done = run(code, place, ONE_DESIGN)
        assert done.returncode == 0, done.stderr[-3000:]
    assert results(folder) == results(fresh)


def test_verify_finds_and_mends_what_snakemake_does_not_notice(code, finished, tmp_path):
    """A deleted analysis in the middle, a cut mesh, a number changed in the final state."""
    folder = tmp_path / "spoilt"
    shutil.copytree(finished, folder, symlinks=True, copy_function=shutil.copy2)
    spoilt = [
        folder / "results/tiny-dome" / name
        for name in ("sizing/01/analysis.json", "shell/mesh.npz", "sizing/final.json")
    ]
    spoilt[0].unlink()
    os.truncate(spoilt[1], 1000)
    final = json.loads(spoilt[2].read_text())
    spoilt[2].write_text(json.dumps(final | {"volume_m3": 1.0}))
    verify = [start_script(code, folder), start_script(code, folder, "--repair")]
    for done in verify:
        assert done.returncode == 1
        assert all(str(path.relative_to(folder)) in done.stdout for path in spoilt)
    end_like(code, folder, finished)
    assert start_script(code, folder).returncode == 0


def start_script(code, folder, *arguments):
    """Run scripts/verify.py in a study's folder."""
    program = command(code)[0]
    return subprocess.run(
        [program, str(code / "scripts/verify.py"), *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
    )


@pytest.mark.parametrize("pause", [0.0, 0.05, 0.3])
def test_ctrl_c_again_and_again_is_no_traceback(code, tmp_path, pause):
    """The first one ends the run; what is done is kept."""
    folder = make_study(tmp_path / "stopped")
    process = subprocess.Popen(
        command(code, TARGET),
        cwd=folder,
        stderr=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        text=True,
        start_new_session=True,
    )
    while not list(folder.glob("results/*/sizing/00/analysis.json")):
        time.sleep(0.02)
    for _ in range(3):
        os.killpg(process.pid, signal.SIGINT)
        time.sleep(pause)
    said = process.communicate(timeout=60)[1]
    assert process.returncode != 0
    assert "Traceback" not in said and "Terminating processes on user request" in said


def test_a_killed_job_names_its_signal_and_a_hint_at_memory(code, tmp_path):
    """The others go on; the process was killed by nobody that it knows."""
    folder = make_study(tmp_path / "killed")
    process = subprocess.Popen(
        command(code, TARGET),
        cwd=folder,
        stderr=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        text=True,
        start_new_session=True,
    )
    while process.poll() is None:  # until an analysis is killed before it ends by itself
        for job in find_jobs(process):
            with contextlib.suppress(OSError):
                if "analyse" in Path(f"/proc/{job}/comm").read_text():
                    os.kill(job, signal.SIGKILL)
    said = process.communicate(timeout=300)[1]
    assert process.returncode != 0
    assert "killed by signal 9 (SIGKILL)" in said and "memory ran short" in said
    assert "start again, what is done is kept" in said
