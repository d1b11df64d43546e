"""Why jobs of a cluster ended: a sentence each, from what Snakemake and the cluster wrote."""

import re
from collections.abc import Callable
from dataclasses import dataclass

_LOG = re.compile(r"^[ \t]*log: (.*?slurm_logs/\S*?(\w+)\.log)(?: \(check log|$)", re.M)
_STATE = re.compile(r"SLURM-job '(\w+)' failed, SLURM status is: '([A-Z_]+)'")
_DESIGN = re.compile(r"/logs/\w+/([a-z0-9_-]+)\.log")
_REASON = re.compile(r"^error: (.+)$", re.M)
_NEAR = 4000
"""Characters after the log of a cluster's job, within which Snakemake names those of the rules."""
MEMORY = ("exceeded memory limit", "oom-kill", "oom_kill", "out of memory", "out-of-memory")
TIME = ("due to time limit",)
CANCELLED = ("cancelled at",)
AGAIN = "; start again, what is done is kept"
SENTENCES = {
    "memory": "took more memory than was asked for: ask for more by --set-resources RULE:mem_mb=N",
    "time": "took longer than was asked for: ask for more by --set-resources RULE:runtime=MINUTES",
    "cancelled": "was cancelled, by a person or the cluster",
    "node": "was lost with its node",
    "failed": "failed",
}
"""What is said of a job, by the kind of its end."""
STATES = {
    "OUT_OF_MEMORY": "memory",
    "TIMEOUT": "time",
    "DEADLINE": "time",
    "CANCELLED": "cancelled",
    "PREEMPTED": "cancelled",
    "REVOKED": "cancelled",
    "NODE_FAIL": "node",
    "BOOT_FAIL": "node",
}


@dataclass(frozen=True)
class ClusterEnd:
    """A job of a cluster that has not ended well: number, its log, the design that it was about,
    and its state where Snakemake tells it (of groups it does not)."""

    job: str
    log: str
    design: str = ""
    state: str = ""


def describe_cluster_ends(text: str, read: Callable[[str], str]) -> list[str]:
    """Return a sentence for each job that a cluster has ended, in order.

    `text` is what Snakemake wrote about the run, `read` returns the content of a job's log, empty
    where there is none.
    """
    return [describe_cluster_end(end, read(end.log)) for end in find_cluster_ends(text)]


def find_cluster_ends(text: str) -> list[ClusterEnd]:
    """Return the jobs that a cluster has ended, from what Snakemake wrote about a run."""
    states = dict(_STATE.findall(text))
    found: dict[str, ClusterEnd] = {}
    for match in _LOG.finditer(text):
        path, job = match.groups()
        design = _DESIGN.search(text, match.start(), match.end() + _NEAR)
        path = path.rpartition(", ")[2]  # the rule's own log stands before it
        end = ClusterEnd(job, path, design[1] if design else "", states.get(job, ""))
        found.setdefault(job, end)
    return list(found.values())


def describe_cluster_end(end: ClusterEnd, log: str) -> str:
    """Return why a job has ended, what to do, and where more stands; `log` is what it wrote."""
    words, kind = log.lower(), STATES.get(end.state, "failed")
    marks = (("memory", MEMORY), ("time", TIME), ("cancelled", CANCELLED))
    if kind in ("failed", "cancelled"):
        kinds = [name for name, known in marks if any(word in words for word in known)]
        kind = kinds[0] if kinds else kind
    reasons = _REASON.findall(log) if kind == "failed" else []
    reason = f": {reasons[-1]}" if reasons else ""
    about = f"{end.design}: " if end.design else ""
    return f"{about}job {end.job} of the cluster {SENTENCES[kind]}{reason} ({end.log}){AGAIN}"
