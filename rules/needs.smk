# What jobs need: memory, and time for a cluster's queue, from panels and subdivisions. They take one
# thread; analyses of large designs two, with parts that hang on the design alone: the same bytes.

from foldshell.engine.few_jobs import FEW
from foldshell.engine.memory import (
    check_room,
    choose_threads,
    estimate_memory,
    find_free_memory,
    find_memory,
    guess_nodes,
    share_memory,
)
from foldshell.engine.minutes import estimate_minutes

# For jobs that run and for processes that wait; elsewhere a cluster knows what there is.
MEMORY = share_memory(find_free_memory() if runs_here() else None)
SNAKEMAKE_MB = 0 if runs_here() else 500
"""Of a cluster's job: the processes of Snakemake, and that whose forks run scripts."""


@functools.cache
def nodes_of(name):
    """Return the nodes of a design's mesh."""
    design = BY_NAME[name]
    counts, files = (design.zigzag, design.strip), design.files
    return guess_nodes(counts, files, choose_subdivisions(SETTINGS, design))


def memory_of(kind):
    """Return a function of the wildcards: the memory (MB) that a job of a design takes, more with
    each attempt, at most all there is for one: it then runs alone."""

    def find(wildcards, attempt):
        need = attempt * (SNAKEMAKE_MB + estimate_memory(kind, nodes_of(wildcards.design)))
        return min(need, MEMORY[0] or need)

    return find


def minutes_of(kind, times=1):
    """Return a function of the wildcards: the time (min) after which a job of a design is taken to
    hang, more with each attempt; `times` as long where it has so many steps."""

    def find(wildcards, attempt):
        return attempt * estimate_minutes(kind, nodes_of(wildcards.design), times)

    return find


def needs_of(kind, times=1):
    """Return the resources of a rule."""
    return {"mem_mb": memory_of(kind), "runtime": minutes_of(kind, times)}


def threads_of(wildcards):
    """Return the threads of an analysis of a design."""
    return choose_threads(nodes_of(wildcards.design))


def check_memory(names):
    """End with a sentence where the memory of this machine is too small for a design."""
    memory = find_memory() if runs_here() else None
    with user_errors():
        for name in names:
            check_room(name, BY_NAME[name].panels, nodes_of(name), memory)
    return names


def rank_of(job):
    """Return what a job comes before others by: its priority, then the panels of its design."""
    design = BY_NAME.get(getattr(job, "wildcards_dict", {}).get("design"))
    return job.priority, design.zigzag * design.strip if design else 0


def count_few():
    """Return how many jobs that could run are looked at: more than there is room for."""
    return FEW + 2 * max(setting_of("resource_settings", name) or 0 for name in ("cores", "nodes"))
