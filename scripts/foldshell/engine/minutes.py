"""How long jobs take, for queues of clusters: a limit that a job in order never reaches."""

import math
from collections.abc import Mapping
from types import MappingProxyType

SECONDS_AND_PER_NODE: Mapping[str, tuple[float, float]] = MappingProxyType({
    "fold": (1.0, 1e-4),
    "mesh": (0.5, 2e-5),
    "analyse": (0.5, 8e-5),
    "mesh_convergence": (1.0, 3e-4),
    "compare": (2.0, 1e-3),
    "draw": (5.0, 1e-4),
    "page": (1.0, 5e-5),
})  # fmt: skip
"""By rule: processor time (s) without a mesh, and for each node of the mesh that designs are sized
on: as measured on meshes of 5,400 to 40,400 nodes, rounded up."""

SAFETY = 10
"""Between a processor of the machine of the measurements and the slowest that is thought of."""
LEAST = 10
"""Minutes that every job may take: starting Python from a busy file system may take some."""


def estimate_minutes(rule: str, nodes: int, times: int = 1) -> int:
    """Return the minutes after which a job of a rule, on a mesh of so many nodes, is taken to
    hang; `times` as long where it does its work so often."""
    base, each = SECONDS_AND_PER_NODE[rule]
    return max(LEAST, math.ceil(SAFETY * times * (base + each * nodes) / 60))
