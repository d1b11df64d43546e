"""Time and memory of the jobs of each rule, from the files of Snakemake's `benchmark`.

Wall time is exact. Processor time is 0 for short jobs where jobs are no forks, so that it is not
reported; memory is that of the largest job. When a job ended is told by the time of its file, which
Snakemake writes then: what ran after the last loop, and what of it ran alone, follows.
"""

import itertools
from collections.abc import Sequence
from io import StringIO
from pathlib import Path

import numpy as np
import pandas as pd

LOOP = "size"
"""The rule whose last job ends the last loop."""


def collect_timings(folder: str | Path) -> pd.DataFrame:
    """Return one row per rule, the longest first, and one for all: jobs, wall_s, wall_mean_s,
    wall_max_s, rss_max_mb, after_loops_s, alone_s.

    Parameters
    ----------
    folder : holds `<rule>/<job>.tsv`
    """
    # one table of all files: to read two thousand one by one takes seconds
    rows, ends = [], []
    for path in sorted(Path(folder).glob("*/*.tsv")):
        header, *lines = path.read_text().splitlines()
        rows += [f"{path.parent.name}\t{line}" for line in lines]
        ends += [path.stat().st_mtime] * len(lines)
    text = "\n".join([f"rule\t{header}", *rows])
    jobs = pd.read_csv(StringIO(text), sep="\t", na_values="-").assign(end=ends)
    jobs = jobs.assign(**find_tail(jobs["rule"], jobs["end"] - jobs["s"], jobs["end"]))
    rules = _sum_jobs(jobs.groupby("rule")).sort_values("wall_s", ascending=False)
    everything = _sum_jobs(jobs.assign(rule="all").groupby("rule"))
    return pd.concat([rules, everything]).round(2).reset_index()


def find_tail(
    rules: Sequence[str], begin: Sequence[float], end: Sequence[float]
) -> dict[str, np.ndarray]:
    """Return how long each job ran after the last loop had ended, and how long of it alone.

    `begin` (J,) and `end` (J,) are times; their unit is s. Nothing where there was no loop.
    """
    begin, end = np.asarray(begin, dtype=float), np.asarray(end, dtype=float)
    loops = end[np.asarray(rules) == LOOP]
    start = loops.max() if len(loops) else end.max()
    begin = np.clip(begin, start, None)
    after = np.clip(end - begin, 0.0, None)
    alone = np.zeros(len(end))
    ran = after > 0
    cuts = np.unique(np.concatenate([begin[ran], end[ran]]))
    for low, high in itertools.pairwise(cuts):
        running = np.flatnonzero(ran & (begin < high) & (end > low))
        if len(running) == 1:
            alone[running] += high - low
    return {"after_loops": after, "alone": alone}


def _sum_jobs(jobs) -> pd.DataFrame:
    return jobs.agg(
        jobs=("s", "size"),
        wall_s=("s", "sum"),
        wall_mean_s=("s", "mean"),
        wall_max_s=("s", "max"),
        rss_max_mb=("max_rss", "max"),
        after_loops_s=("after_loops", "sum"),
        alone_s=("alone", "sum"),
    )
