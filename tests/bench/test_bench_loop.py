"""A loop's analyses against those of another commit: `make bench`; BENCH_AGAINST names the commit.

Both take turns in one sitting, three times each; what counts is the ratio of the medians. Written
to results/bench/loop.csv with processor and kernels, and as a line for docs/benchmarks.md.
"""

import csv
import json
import math
import os
import subprocess
import sys
from pathlib import Path
from statistics import linear_regression, median

import pytest
from bench_loop_run import PAIRED

from foldshell.engine.environment import KEEP_MEMORY, ONE_THREAD, SMALL_PAGES
from foldshell.files.blas_kernels import name_kernels
from foldshell.report.provenance import describe_machine

pytestmark = pytest.mark.bench
ROOT = Path(__file__).parents[2]
RESULTS = ROOT / "results" / "bench"
AGAINST = os.environ.get("BENCH_AGAINST", "HEAD~1")
MEASURED = ("first_s", "iteration_s", "loop_s", "rss_mb", "kb_per_freedom")
LARGEST = os.environ.get("BENCH_LARGEST", "million")
LARGEST_MB, EXPONENT = 8000, 1.2
"""Of a million freedoms; docs/benchmarks.md says why 1.23 is what is reached."""


@pytest.fixture(scope="module")
def other(tmp_path_factory):
    """Return a checkout of the commit to compare with."""
    folder = tmp_path_factory.mktemp("against") / "code"
    git = ["git", "-C", str(ROOT), "worktree"]
    subprocess.run([*git, "add", "--detach", str(folder), AGAINST], check=True, capture_output=True)
    yield folder
    subprocess.run([*git, "remove", "--force", str(folder)], check=True)


def name_against() -> str:
    """Return the abbreviated hash of the commit to compare with: what HEAD~1 means changes."""
    git = ["git", "-C", str(ROOT), "rev-parse", "--short", AGAINST]
    return subprocess.run(git, check=True, capture_output=True, text=True).stdout.strip()


def run(root: Path, kind: str, threads: int = 1) -> dict[str, float]:
    done = subprocess.run(
        [sys.executable, str(Path(__file__).with_name("bench_loop_run.py")), str(root), kind],
        env={**os.environ, **ONE_THREAD, **KEEP_MEMORY, **SMALL_PAGES,
             "FOLDSHELL_THREADS": str(threads)},
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    return json.loads(done.stdout)


@pytest.mark.parametrize("kind", PAIRED)
def test_a_loop_costs_no_more_than_at_the_commit_before(other, kind):
    """Half of the time is due against commit 792766a; against any other no more than it took."""
    pairs = [(run(ROOT, kind), run(other, kind)) for _ in range(3)]
    row = {"kind": kind, "against": name_against(), "kernels": name_kernels(), **describe_machine()}
    for name in ("dofs", "analyses", *MEASURED):
        row[name] = median(own[name] for own, _ in pairs)
    for name in MEASURED:
        row[f"{name}_ratio"] = median(own[name] / before[name] for own, before in pairs)
    write(row)
    print({name: round(value, 3) for name, value in row.items() if name.endswith("_ratio")})
    assert row["iteration_s_ratio"] < 1.1
    assert row["kb_per_freedom_ratio"] < 1.1


def test_large_designs_take_little_memory_and_two_cores():
    """A million freedoms, the exponent of an analysis, and two threads with the same bytes."""
    kinds = ["iteration_20k", "large_260k", LARGEST]
    alone = {kind: run(ROOT, kind) for kind in kinds}
    both = run(ROOT, LARGEST, threads=2)
    sizes, seconds = (
        [math.log(alone[kind][name]) for kind in kinds] for name in ("dofs", "first_s")
    )
    exponent = linear_regression(sizes, seconds).slope
    faster = alone[LARGEST]["wall_s"] / both["wall_s"]
    print(f"{alone[LARGEST]}; exponent {exponent:.2f}; two threads {faster:.2f} times as fast")
    for kind in kinds:
        write({"kind": kind, "against": "", "kernels": name_kernels(), **describe_machine(),
               **{name: alone[kind][name] for name in ("dofs", "analyses", *MEASURED)},
               **{f"{name}_ratio": "" for name in MEASURED}})  # fmt: skip
    assert both["bytes"] == alone[LARGEST]["bytes"]
    assert alone[LARGEST]["rss_mb"] < LARGEST_MB
    assert exponent < EXPONENT


def write(row: dict[str, object]) -> None:
    """Add a row to loop.csv."""
    RESULTS.mkdir(parents=True, exist_ok=True)
    path = RESULTS / "loop.csv"
    new = not path.exists()
    with path.open("a", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, list(row))
        if new:
            writer.writeheader()
        writer.writerow(row)
