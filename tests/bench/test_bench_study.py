"""Processor time of a study's jobs by rule, against another commit: `make bench`.

BENCH_STUDY names the tag of the designs (by default one small design; `supports` are the nine),
BENCH_AGAINST the commit. Written to results/bench/study.csv.
"""

import csv
import os
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest
from test_bench_loop import RESULTS, ROOT, name_against, other  # noqa: F401 - a fixture

sys.path.insert(0, str(ROOT / "tests" / "workflow"))
from study_runner import copy_code

pytestmark = pytest.mark.bench
STUDY = os.environ.get("BENCH_STUDY", "demo")


def run_study(code: Path) -> Counter[str]:
    """Return the CPU s of the jobs of each rule, from nothing, one job at a time.

    `code` is a folder of its own, without results.
    """
    command = [sys.executable, "-m", "snakemake", "--cores", "1", "--config", f"study={STUDY}"]
    done = subprocess.run(command, cwd=code, capture_output=True, text=True)
    assert not done.returncode, done.stderr[-3000:]
    return sum_jobs(code / "results" / "benchmarks")


def sum_jobs(folder: Path) -> Counter[str]:
    """Return the CPU s of each rule from the files of Snakemake's `benchmark`."""
    found: Counter[str] = Counter()
    for path in folder.glob("*/*.tsv"):
        with path.open(encoding="utf-8") as stream:
            for row in csv.DictReader(stream, delimiter="\t"):
                found[path.parent.name] += float(row["cpu_time"])
    return found


def test_share_of_each_rule_in_a_study(other, tmp_path):  # noqa: F811
    own, before = run_study(copy_code(tmp_path / "own")), run_study(other)
    total, against = own.total(), name_against()
    RESULTS.mkdir(parents=True, exist_ok=True)
    with (RESULTS / "study.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow(["rule", "cpu_s", "share", f"cpu_s at {against}"])
        for rule, seconds in own.most_common():
            figures = f"{seconds:.2f}", f"{seconds / total:.3f}", f"{before[rule]:.2f}"
            writer.writerow([rule, *figures])
        writer.writerow(["all", f"{total:.2f}", "1", f"{before.total():.2f}"])
    shared = set(own) & set(before)
    ratio = sum(own[rule] for rule in shared) / sum(before[rule] for rule in shared)
    print(f"{STUDY}: {total:.1f} s, {ratio:.2f} of {against} in the rules of both")
    assert ratio < 1.25
