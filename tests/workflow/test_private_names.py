"""The private names of Snakemake that rules/engine.smk uses: there, and missed without harm."""

import csv
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[2]
ENGINE = (REPOSITORY / "rules/engine.smk").read_text()
SCRIPTS = ["execute_script", "_execute_cmd", "conda_env", "shadow_dir", "bench_record"]
RUNS = ["job_rate_limiter", "global_resources", "finished_jobs", "_finished", "_needrun", "_len"]
NAMES = [*SCRIPTS, *RUNS, "data_collected", "targets", "main_snakefile"]
NAMES += ["DefaultStreamHandler"]
SNAKEFILE = """
import os, sys, time
from types import SimpleNamespace

SCRIPTS = {scripts!r}
sys.path.insert(0, SCRIPTS)
from foldshell.engine.environment import ONE_THREAD

MEMORY = (100, 50)
SETTINGS = SimpleNamespace(jobs=SimpleNamespace(fork=True))
include: "server.smk"
include: "engine.smk"

def count_few():
    return 64

def rank_of(job):
    return job.priority

def begin_run():
    print("handler:", terminal_handler())

def stored_beside(job):
    import contextlib
    return contextlib.nullcontext()

def show_job(log, failed):
    from foldshell.engine.job_end import show_log
    show_log(log)

def last_made(wildcards):
    print("known:", is_target("end"), is_target("other"), MAIN_SNAKEFILE)
    return checkpoints.analyse.get(design="a", iteration="00").output.json

rule end:
    input: last_made
    output: "end.txt"
    log: "end.log"
    benchmark: "end.tsv"
    script: "job.py"

rule large:
    output: "large{{number}}.txt"
    resources: mem_mb=60
    shell: "date +%s.%N > {{output}}; sleep 0.5; date +%s.%N >> {{output}}"

checkpoint analyse:
    output: json="{{design}}/{{iteration}}.json"
    shell: "touch {{output}}"

"""
JOB = """
import os
from pathlib import Path
print("said")
parent = Path(f"/proc/{os.getppid()}/cmdline").read_bytes().decode()
Path(snakemake.output[0]).write_text(parent)
"""


def run_tiny(folder, engine, *targets, cores="1"):
    """Run a checkpoint and a script by a Snakefile that includes this engine.smk."""
    (folder / "engine.smk").write_text(engine)
    shutil.copy(REPOSITORY / "rules/server.smk", folder)
    (folder / "job.py").write_text(JOB)
    (folder / "Snakefile").write_text(SNAKEFILE.format(scripts=str(REPOSITORY / "scripts")))
    command = [sys.executable, "-m", "snakemake", "--cores", cores, *(targets or ["end"])]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-3000:]
    return done


def test_this_snakemake_has_every_private_name(tmp_path):
    """Fails when a name is gone: jobs then start anew, or slower, or nothing is known of them."""
    done = run_tiny(tmp_path, ENGINE)
    assert "warning: this Snakemake has no" not in done.stderr
    known = f"known: True False {tmp_path}/Snakefile"
    assert known in done.stdout.splitlines()
    assert (tmp_path / "end.log").read_text() == "said\n" and "said" in done.stderr.splitlines()
    assert "fork_server.py" in (tmp_path / "end.txt").read_text()
    (record,) = csv.DictReader((tmp_path / "end.tsv").open(), delimiter="\t")
    assert float(record["max_rss"]) > 1 and float(record["s"]) > 0
    assert "2 of 2 steps (100%) done" in done.stderr


def test_jobs_that_need_all_memory_run_one_after_the_other(tmp_path):
    """Two of 60 MB where there are 100 MB for jobs, on two cores."""
    run_tiny(tmp_path, ENGINE, "large1.txt", "large2.txt", cores="2")
    spans = [(tmp_path / f"large{n}.txt").read_text().split() for n in (1, 2)]
    first, second = sorted([float(time) for time in span] for span in spans)
    assert first[1] <= second[0]


@pytest.mark.parametrize("gone", [*((name,) for name in NAMES[::4]), tuple(NAMES)], ids="-".join)
def test_a_name_that_is_gone_is_said_in_one_line_and_the_run_goes_on(tmp_path, gone):
    """Another name stands for one that a later Snakemake no longer has."""
    engine = ENGINE
    for name in gone:
        engine, count = re.subn(rf"(?<![\w.]){name}(?=[ \"])", f"{name}_gone", engine)
        assert count, f"{name}: not looked up in engine.smk"
    done = run_tiny(tmp_path, engine)
    warnings = [line for line in done.stderr.splitlines() if "this Snakemake has no" in line]
    assert len(warnings) == 1
    assert all(f".{name}_gone" in warnings[0] for name in gone)


def test_no_other_file_knows_a_private_name():
    """Of those of engine.smk, as far as they are no common words."""
    words = "|".join([
        *("job_rate_limiter", "finished_jobs", "data_collected"),
        *(r"\._finished", r"\._needrun", "PythonScript", r"dag\._", r"scheduler\._"),
        *(r"workflow\.main_snakefile", r"import snakemake\.script", r"dag_settings"),
    ])  # fmt: skip
    known = {"engine.smk", Path(__file__).name}
    paths = [
        path
        for folder in ("rules", "scripts", "tests")
        for path in REPOSITORY.glob(f"{folder}/**/*")
    ]
    for path in [REPOSITORY / "Snakefile", *paths]:
        if path.suffix in (".py", ".smk", "") and path.is_file() and path.name not in known:
            found = re.search(words, path.read_text(encoding="utf-8"))
            assert not found, f"{path}: {found[0]}"
