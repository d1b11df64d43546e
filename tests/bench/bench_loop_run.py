"""Run a sizing loop of one commit and print its cost: `python bench_loop_run.py ROOT KIND`.

ROOT is the checkout whose library is measured, so that two commits can take turns; KIND is one of
`KINDS`. A process of its own for every row; CPU seconds of one thread.
"""

import json
import resource
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Kind:
    """A sheet: lines of folds each way, cells along a facet edge, and analyses of its loop."""

    lines: tuple[int, int]
    subdivisions: int
    analyses: int


KINDS = {
    "iteration_20k": Kind((15, 16), 4, 30),
    "iteration_80k": Kind((15, 16), 8, 6),
    "large_60k": Kind((26, 29), 4, 3),
    "large_260k": Kind((52, 58), 4, 2),
}


def corrugated_dome(lines: tuple[int, int], spacing: float = 2.0) -> dict[str, np.ndarray]:
    """Return the arrays of a sheet over a flat dome: folds of 0.8 m, skewed zig-zags."""
    zigzag, strip = (index.ravel() for index in np.indices(lines))
    x, y = spacing * strip, spacing * zigzag + 0.6 * (strip % 2)
    u, v = ((axis - axis.mean()) / np.ptp(axis) * 2 for axis in (x, y))
    rise = 0.2 * np.ptp(x) * (1 - u**2) * (1 - v**2 / 2)
    vertices = np.column_stack([x, y, 0.8 * (strip % 2) + rise])
    first = np.arange(len(x)).reshape(lines)[:-1, :-1].ravel()
    quads = np.column_stack([first, first + 1, first + lines[1] + 1, first + lines[1]])
    facets = np.stack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]], axis=1).reshape(-1, 3)
    return {
        "vertices": vertices, "quads": quads, "facets": facets, "zigzag": zigzag, "strip": strip,
        "flat": vertices * [1, 1, 0], "planarity": np.zeros(len(quads)),
        "strain": np.zeros(len(facets)),
    }  # fmt: skip


def run_kind(kind: Kind) -> dict[str, float]:
    """Return freedoms, CPU s of the model, of the first and of a later analysis, MB and kB."""
    from foldshell.settings.analysed import ANALYSED
    from foldshell.settings.stage import StageSettings
    from foldshell.shell import warm_up  # noqa: F401 - as the workflow's jobs find it
    from foldshell.shell.mesh_files import mesh_folded_sheet
    from foldshell.sizing.case import make_case
    from foldshell.sizing.iteration import IterationTask
    from foldshell.sizing.rounding import round_thickness
    from foldshell.sizing.step import take_step

    settings = StageSettings(*[group() for group in ANALYSED])
    before = read_megabytes()
    began = time.process_time()
    mesh = mesh_folded_sheet(corrugated_dome(kind.lines), "all", kind.subdivisions)
    case = make_case(mesh, settings)
    seconds = [time.process_time() - began]
    run = getattr(case, "run_in_loop", case.run)
    thickness = round_thickness(np.full(case.model.sized_panels, 0.3))
    last = arrays = memory = None
    span = float(np.ptp(case.model.mesh.nodes[:, 0]))
    while (last is None or last.goes_on) and len(seconds) <= kind.analyses:
        if last:
            step = take_step(last, arrays, memory, settings.sizing)
            thickness, memory = step.thickness, step.memory
        began = time.process_time()
        last, arrays = run(IterationTask(len(seconds) - 1, span, thickness, last, arrays))
        seconds.append(time.process_time() - began)
    return {
        "dofs": last.dofs, "build_s": seconds[0], "first_s": seconds[1],
        "iteration_s": float(np.median(seconds[2:])), "loop_s": sum(seconds),
        "analyses": len(seconds) - 1, "rss_mb": read_megabytes(),
        "kb_per_freedom": 1024 * (read_megabytes() - before) / last.dofs,
        "thickness_sum": float(thickness.sum()),
    }  # fmt: skip


def read_megabytes() -> float:
    """Return the largest resident memory of this process so far, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


if __name__ == "__main__":
    sys.path.insert(0, str(Path(sys.argv[1]) / "scripts"))
    print(json.dumps(run_kind(KINDS[sys.argv[2]])))
