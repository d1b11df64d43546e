"""Times of jobs are added up rule by rule."""

import csv
import runpy
from pathlib import Path

SCRIPT = Path(__file__).parents[3] / "scripts/timings.py"
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
        ["rule", "jobs", "wall_s", "wall_mean_s", "wall_max_s", "rss_max_mb"],
        ["analyse", "2", "6.0", "3.0", "4.0", "300.5"],
        ["fold", "1", "0.5", "0.5", "0.5", "90.0"],
        ["all", "3", "6.5", "2.17", "4.0", "300.5"],
    ]
