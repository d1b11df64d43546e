"""Times of jobs are added up rule by rule, and what ran after the last loop is told."""

import csv
import os
import runpy
from pathlib import Path

SCRIPT = Path(__file__).parents[3] / "scripts/timings.py"
TAIL = ["after_loops_s", "alone_s"]
HEADER = "s\th:m:s\tmax_rss\tmax_vms\tmax_uss\tmax_pss\tio_in\tio_out\tmean_load\tcpu_time\n"


def write(folder, name, wall, rss):
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"{HEADER}{wall}\t0:00:01\t{rss}\t1\t1\t1\t0\t0\t90\t0\n")


def test_jobs_are_added_up(tmp_path):
    write(tmp_path, "fold/a.tsv", 0.5, 90)
    write(tmp_path, "analyse/a-00.tsv", 2.0, 300.5)
    write(tmp_path, "analyse/a-01.tsv", 4.0, "NA")
    runpy.run_path(str(SCRIPT))["main"](tmp_path, tmp_path / "timings.csv")
    with (tmp_path / "timings.csv").open(newline="", encoding="utf-8") as stream:
        rows = list(csv.reader(stream))
    assert rows == [
        ["rule", "jobs", "wall_s", "wall_mean_s", "wall_max_s", "rss_max_mb", *TAIL],
        ["analyse", "2", "6.0", "3.0", "4.0", "300.5", "0.0", "0.0"],
        ["fold", "1", "0.5", "0.5", "0.5", "90.0", "0.0", "0.0"],
        ["all", "3", "6.5", "2.17", "4.0", "300.5", "0.0", "0.0"],
    ]


def test_what_ran_after_the_last_loop_and_what_of_it_alone(tmp_path):
    """Loops end at 10 and 20 s. After that: draw 15 to 24, compare 22 to 30, report 31 to 33: 4, 8
    and 2 s, of which 2 (20 to 22), 6 (24 to 30) and 2 alone. A picture of before does not count."""
    began = 1e9
    jobs = [("size/a", 5, 10), ("size/b", 5, 20), ("draw/a", 8, 18), ("draw/b", 9, 24)]
    jobs += [("compare/b", 8, 30), ("report/study", 2, 33)]
    for name, wall, end in jobs:
        write(tmp_path, f"{name}.tsv", wall, 90)
        os.utime(tmp_path / f"{name}.tsv", (began + end, began + end))
    runpy.run_path(str(SCRIPT))["main"](tmp_path, tmp_path / "timings.csv")
    with (tmp_path / "timings.csv").open(newline="", encoding="utf-8") as stream:
        found = {row["rule"]: [float(row[name]) for name in TAIL] for row in csv.DictReader(stream)}
    assert found == {
        "size": [0, 0], "draw": [4, 2], "compare": [8, 6], "report": [2, 2], "all": [14, 10]
    }  # fmt: skip
