"""Time and memory of the jobs of each rule, from the files of Snakemake's `benchmark`.

Wall time is exact. Processor time is 0 for short jobs where jobs are no forks, so that it is not
reported; memory is that of the largest job.
"""

from io import StringIO
from pathlib import Path

import pandas as pd


def collect_timings(folder: str | Path) -> pd.DataFrame:
    """Return one row per rule, the longest first, and one for all: jobs, wall_s, wall_mean_s,
    wall_max_s, rss_max_mb.

    Parameters
    ----------
    folder : holds `<rule>/<job>.tsv`
    """
    # one table of all files: to read two thousand one by one takes seconds
    rows = []
    for path in sorted(Path(folder).glob("*/*.tsv")):
        header, *lines = path.read_text().splitlines()
        rows += [f"{path.parent.name}\t{line}" for line in lines]
    text = "\n".join([f"rule\t{header}", *rows])
    jobs = pd.read_csv(StringIO(text), sep="\t", na_values="-")
    rules = _sum_jobs(jobs.groupby("rule")).sort_values("wall_s", ascending=False)
    everything = _sum_jobs(jobs.assign(rule="all").groupby("rule"))
    return pd.concat([rules, everything]).round(2).reset_index()


def _sum_jobs(jobs) -> pd.DataFrame:
    return jobs.agg(
        jobs=("s", "size"),
        wall_s=("s", "sum"),
        wall_mean_s=("s", "mean"),
        wall_max_s=("s", "max"),
        rss_max_mb=("max_rss", "max"),
    )
