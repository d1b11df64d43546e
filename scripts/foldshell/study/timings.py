"""Time and memory of the jobs of each rule, from the files of Snakemake's `benchmark`.

Wall time is exact; memory is polled, and CPU time too, which leaves it out for jobs below a second:
it is not reported.
"""

import csv
from collections.abc import Iterable
from pathlib import Path

COLUMNS = ("rule", "jobs", "wall_s", "wall_mean_s", "wall_max_s", "rss_max_mb")
"""Columns of timings.csv: sums over the jobs of a rule, then mean and largest of one job."""


def collect_timings(folder: str | Path) -> list[dict[str, object]]:
    """Return a row a rule and one for all, the costliest rule first.

    Parameters
    ----------
    folder : holds `<rule>/<job>.tsv`
    """
    names = sorted(path.name for path in Path(folder).iterdir() if path.is_dir())
    rows = [_sum_jobs(name, read_jobs(Path(folder, name).glob("*.tsv"))) for name in names]
    rows.sort(key=lambda row: -row["wall_s"])
    everything = read_jobs(Path(folder).glob("*/*.tsv"))
    return [*rows, _sum_jobs("all", everything)]


def read_jobs(paths: Iterable[Path]) -> list[dict[str, float]]:
    """Return wall seconds and resident MB of each job; 0 where too short to be polled."""
    jobs = []
    for path in paths:
        with path.open(newline="", encoding="utf-8") as stream:
            for row in csv.DictReader(stream, delimiter="\t"):
                keys = {"wall": "s", "rss": "max_rss"}
                jobs.append({name: _number(row.get(key)) for name, key in keys.items()})
    return jobs


def _number(text: str | None) -> float:
    try:
        return float(text or 0)
    except ValueError:
        return 0.0


def _sum_jobs(rule: str, jobs: list[dict[str, float]]) -> dict[str, object]:
    wall = [job["wall"] for job in jobs]
    return {
        "rule": rule,
        "jobs": len(jobs),
        "wall_s": round(sum(wall), 1),
        "wall_mean_s": round(sum(wall) / max(len(wall), 1), 2),
        "wall_max_s": round(max(wall, default=0.0), 2),
        "rss_max_mb": round(max((job["rss"] for job in jobs), default=0.0), 1),
    }
