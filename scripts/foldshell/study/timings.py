"""Time and memory of the jobs of each rule, from the files of Snakemake's `benchmark`.

Wall time is exact. Memory is polled, as CPU time is, which is 0 for jobs below a second: CPU time
is not reported, memory is that of the largest job.
"""

from pathlib import Path

import pandas as pd


def collect_timings(folder: str | Path) -> pd.DataFrame:
    """Return a row a rule, the longest first, and one for all: jobs, wall_s, wall_mean_s,
    wall_max_s, rss_max_mb.

    Parameters
    ----------
    folder : holds `<rule>/<job>.tsv`
    """
    jobs = pd.concat(
        pd.read_csv(path, sep="\t", na_values="-").assign(rule=path.parent.name)
        for path in sorted(Path(folder).glob("*/*.tsv"))
    )
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
