"""A scheduler that looks at a few of the jobs that could run, not at all of a thousand designs."""

import heapq
from collections.abc import Callable
from typing import Any

FEW = 64
"""Jobs that are looked at, at least. Snakemake asks the system for every input of each of them
after each job: with all the first jobs of a thousand designs that grows with their square."""


def look_at_few(
    owner: Any, ready: str, remaining: str, rank: Callable[[Any], Any], few: int
) -> None:
    """Let a scheduler's property `ready` return its `few` jobs of the highest rank, and `remaining`
    none: the greedy choice does not use it."""
    kind = type(owner)
    found = getattr(kind, ready).fget

    def pick(self: Any) -> list[Any]:
        """Return the first of the jobs that could run."""
        jobs = found(self)
        return jobs if len(jobs) <= few else heapq.nlargest(few, jobs, key=rank)

    properties = {ready: property(pick), remaining: property(lambda self: [])}
    owner.__class__ = type(kind.__name__, (kind,), properties)
