"""How long a study takes on many cores: its jobs, with the time that each has taken, by priority.

`critical_path.py FOLDER ...`: folders of results with benchmarks. No machine of so many cores is
needed: the times measured on one core stand in the graph of the jobs of `loop: whole`.
"""

import csv
import heapq
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

BEFORE = ("pattern", "fold", "mesh")
LOOP = ("start", "analyse", "resize", "group", "size")
AFTER = {
    "draw": ("size",),
    "neutral_model": ("size",),
    "mesh_convergence": ("size",),
    "check": ("mesh_convergence",),
    "reinforcement": ("check",),
    "design_workbook": ("check",),
    "compare": ("neutral_model", "mesh_convergence"),
    "page": ("draw", "compare", "reinforcement"),
    "sheet": ("draw", "compare", "check"),
}
"""Jobs after the loop of a design, and what each waits for."""


@dataclass(frozen=True)
class Job:
    """A job: seconds it takes, priority, and the jobs that it waits for."""

    seconds: float
    priority: int
    waits: tuple[str, ...]


def read_seconds(results: Path) -> dict[str, dict[str, float]]:
    """Return {design: {rule: seconds}} from the benchmarks of a folder, loops summed up."""
    found: dict[str, dict[str, float]] = {}
    for path in results.glob("benchmarks/*/*.tsv"):
        rule, name = path.parent.name, path.stem
        name = name.rpartition("-")[0] if rule in ("analyse", "resize") else name
        with path.open() as stream:
            seconds = float(next(csv.DictReader(stream, delimiter="\t"))["cpu_time"])
        rule = "size" if rule in LOOP else rule
        times = found.setdefault(name, {})
        times[rule] = times.get(rule, 0.0) + seconds
    return {name: times for name, times in found.items() if "mesh" in times}


def make_jobs(
    designs: Mapping[str, Mapping[str, float]], start: float, last: Sequence[float], groups: bool
) -> dict[str, Job]:
    """Return the jobs of a study: of each design, and `last` (s) one after the other.

    Each job takes `start` (s) more; `groups` are two for each design, as on a cluster.
    """
    jobs, ends = {}, []
    for name, seconds in designs.items():
        if groups:
            before = sum(seconds.get(rule, 0.0) for rule in (*BEFORE, "size"))
            after = sum(seconds.get(rule, 0.0) for rule in AFTER)
            jobs[f"{name} loop"] = Job(before + start, 0, ())
            jobs[f"{name} post"] = Job(after + start, 1, (f"{name} loop",))
            ends.append(f"{name} post")
            continue
        waits: tuple[str, ...] = ()
        for rule in (*BEFORE, "size"):
            jobs[f"{name} {rule}"] = Job(seconds.get(rule, 0.0) + start, int(rule in BEFORE), waits)
            waits = (f"{name} {rule}",)
        for rule, needs in AFTER.items():
            names = tuple(f"{name} {need}" for need in needs)
            jobs[f"{name} {rule}"] = Job(seconds.get(rule, 0.0) + start, 2, names)
        ends += [f"{name} {rule}" for rule in ("page", "sheet", "design_workbook")]
    for number, one in enumerate(last):
        jobs[f"study {number}"] = Job(one + start, 2, tuple(ends))
        ends = [f"study {number}"]
    return jobs


def simulate(jobs: Mapping[str, Job], cores: int, each: float = 0.0) -> float:
    """Return the wall time (s) of jobs on so many cores, ready ones by priority, longest first.

    `each` (s) is what Snakemake itself takes for a job, one after the other.
    """
    left = {name: len(job.waits) for name, job in jobs.items()}
    after: dict[str, list[str]] = {}
    for name, job in jobs.items():
        for need in job.waits:
            after.setdefault(need, []).append(name)
    rank = {name: (-job.priority, -job.seconds, name) for name, job in jobs.items()}
    ready = [rank[name] for name, count in left.items() if not count]
    heapq.heapify(ready)
    running: list[tuple[float, str]] = []
    now = free = 0.0
    while ready or running:
        while ready and len(running) < cores:
            name = heapq.heappop(ready)[-1]
            free = max(free, now) + each
            heapq.heappush(running, (free + jobs[name].seconds, name))
        now, done = heapq.heappop(running)
        for name in after.get(done, []):
            left[name] -= 1
            if not left[name]:
                heapq.heappush(ready, rank[name])
    return now


def find_longest(jobs: Mapping[str, Job]) -> float:
    """Return the time (s) of the longest chain of jobs: no number of cores is quicker."""
    ends: dict[str, float] = {}
    for name, job in jobs.items():  # what a job waits for stands before it
        ends[name] = job.seconds + max((ends[need] for need in job.waits), default=0.0)
    return max(ends.values())


if __name__ == "__main__":
    for folder in sys.argv[1:]:
        measured = read_seconds(Path(folder))
        study = make_jobs(measured, 0.05, (5.0,), False)
        total = sum(job.seconds for job in study.values())
        print(
            f"{folder}: {len(measured)} designs, {total:.0f} s, chain {find_longest(study):.1f} s"
        )
        for cores in (1, 2, 8, 32):
            print(f"{cores} cores: {simulate(study, cores, 0.018):.1f} s")
        names = list(measured)
        many = {f"{i}": measured[names[i % len(names)]] for i in range(1000)}
        study = make_jobs(many, 6.0, (71.0,), True)
        print(
            f"1000 designs: {sum(job.seconds for job in study.values()):.0f} s of jobs on a cluster"
        )
        print(f"100 cores of a cluster: {simulate(study, 100, 0.094):.1f} s")
        print(f"longest chain {find_longest(study):.1f} s")
