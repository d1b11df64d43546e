"""How much memory jobs take, and how much there is: large designs run one after the other.

Measured as the largest resident memory of jobs on meshes of 5,400, 22,800 and 40,400 nodes; what
all forks have in common counts for each of them.
"""

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from types import MappingProxyType

from foldshell.files.errors import InputError
from foldshell.files.threads import LARGE, MOST
from foldshell.shell.mesh import split_subdivisions

MB_AND_PER_NODE: Mapping[str, tuple[float, float]] = MappingProxyType({
    "fold": (200, 0.002),
    "mesh": (200, 0.002),
    "analyse": (420, 0.031),
    "mesh_convergence": (250, 0.072),
    "compare": (220, 0.082),
    "draw": (640, 0.002),
    "page": (175, 0.010),
})  # fmt: skip
"""By rule: memory (MB) without a mesh, and for each node of the mesh that designs are sized on."""

FREEDOMS_A_NODE, KB_A_FREEDOM, EMPTY_MB = 3.6, 8.0, 300
"""Of an analysis of a large design, measured at 60,000 to a million freedoms; MB before it."""

BYTES_A_PANEL = 60
"""Of a file of a folded sheet or a pattern; those in binary have fewer."""
SHARE = 0.9
"""Of the memory that is free at the start, for all jobs and the processes that are kept."""
KEPT_SHARE = 0.2
"""Of that, for processes that wait for their next job with all that they hold."""
_LIMITS = ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes")


def count_nodes(zigzag_count: int, strip_count: int, subdivisions: int) -> int:
    """Return the nodes of the shell mesh of a sheet of so many polylines.

    A facet edge has k p + 1 nodes, with k elements of order p: V + E (k p - 1) + F (k p - 1)
    (k p - 2) / 2 with the vertices, edges and facets of a sheet without holes, E = V + F - 1.
    """
    splits, order = split_subdivisions(subdivisions)
    inner = splits * order - 1
    vertices, facets = zigzag_count * strip_count, 2 * (zigzag_count - 1) * (strip_count - 1)
    return vertices + (vertices + facets - 1) * inner + facets * inner * (inner - 1) // 2


def guess_nodes(counts: tuple[int, int], files: Iterable[str], subdivisions: int) -> int:
    """Return the nodes of a sheet of so many polylines; where there are none, of one with as many
    panels as files of that size may hold."""
    if not all(counts):
        panels = sum(Path(name).stat().st_size for name in files) / BYTES_A_PANEL
        counts = (3 + round(panels**0.5),) * 2
    return count_nodes(*counts, subdivisions)


def estimate_memory(rule: str, nodes: int) -> int:
    """Return the memory (MB) that a job of a rule takes on a mesh of so many nodes."""
    base, each = MB_AND_PER_NODE[rule]
    return round(base + each * nodes)


def choose_threads(nodes: int) -> int:
    """Return on how many parts of an analysis of so many nodes a job works at once."""
    return MOST if FREEDOMS_A_NODE * nodes >= LARGE else 1


def check_room(name: str, panels: int, nodes: int, memory: int | None) -> None:
    """Raise `InputError` for a design whose analysis takes more than the machine's memory (MB).

    Nothing is known without a memory. panels and nodes are those of the design's mesh.
    """
    freedoms = FREEDOMS_A_NODE * nodes
    need = EMPTY_MB + KB_A_FREEDOM * freedoms / 1024
    if memory is not None and need > memory:
        raise InputError(
            f"design {name}: {panels} panels have some {freedoms:.3g} freedoms, whose analysis "
            f"takes {need / 1024:.1f} GB of memory: this machine has {memory / 1024:.1f} GB; fewer "
            "panels or subdivisions are allowed, or a machine with more"
        )


def find_memory() -> int | None:
    """Return the memory (MB) of this machine, at most what this process's group may have."""
    known = _read_limits()
    if hasattr(os, "sysconf") and "SC_PHYS_PAGES" in os.sysconf_names:
        known.append(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2**20)
    return min(known) if known else None


def find_free_memory() -> int | None:
    """Return the memory (MB) that is free: what the system says, at most what this process's group
    may have; None where neither is known."""
    known = _read_limits()
    try:
        lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
        found = dict(line.split(":") for line in lines)
        known.append(int(found["MemAvailable"].split()[0]) // 1024)
    except (OSError, ValueError, KeyError):
        if hasattr(os, "sysconf") and "SC_PHYS_PAGES" in os.sysconf_names:
            known.append(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2**20)
    return min(known) if known else None


def _read_limits() -> list[int]:
    """Return the memory (MB) that groups of processes may have, where one is set."""
    known = []
    for path in _LIMITS:
        try:
            known.append(int(Path(path).read_text(encoding="ascii")) // 2**20)
        except (OSError, ValueError):  # no limit is written as a word
            continue
    return known


def share_memory(free: int | None) -> tuple[int | None, int | None]:
    """Return the memory (MB) for jobs that run and for processes that wait, of what is free."""
    if free is None:
        return None, None
    kept = int(free * SHARE * KEPT_SHARE)
    return int(free * SHARE) - kept, kept
