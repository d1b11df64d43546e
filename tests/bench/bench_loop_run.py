"""Run a sizing loop of one commit and print its cost: `python bench_loop_run.py ROOT KIND`.

ROOT is the checkout whose library is measured, so that two commits can take turns; KIND is one of
`KINDS`. A process of its own for every row; CPU seconds of all its threads.
"""

import contextlib
import hashlib
import json
import os
import resource
import sys
import time
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Kind:
    """A sheet: lines of folds each way, cells along a facet edge, analyses of its loop, and the
    thickness (m) that it begins with."""

    lines: tuple[int, int]
    subdivisions: int
    analyses: int
    thickness: float = 0.3


KINDS = {
    "iteration_20k": Kind((15, 16), 4, 30),
    "iteration_80k": Kind((15, 16), 8, 6),
    "large_60k": Kind((26, 29), 4, 3),
    "large_260k": Kind((52, 58), 4, 2),
    "large_800k": Kind((90, 100), 4, 1, 0.6),
    "million": Kind((102, 112), 4, 1, 0.6),
}
PAIRED = ("iteration_20k", "iteration_80k", "large_60k", "large_260k")
"""Those that are measured against another commit; the largest are measured alone."""


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


class Loop:
    """A sizing loop by the library of today; its threads are those of FOLDSHELL_THREADS, or one."""

    def __init__(self, arrays: dict[str, np.ndarray], subdivisions: int) -> None:
        from foldshell.settings.analysed import ANALYSED
        from foldshell.settings.stage import StageSettings
        from foldshell.shell import warm_up  # noqa: F401 - as the workflow's jobs find it
        from foldshell.shell.mesh_files import mesh_folded_sheet
        from foldshell.sizing.case import make_case

        with contextlib.suppress(ImportError):  # commits before it
            from foldshell.files.threads import use_threads

            use_threads(int(os.environ.get("FOLDSHELL_THREADS", "1")))
        self.settings = StageSettings(*[group() for group in ANALYSED])
        self.begin()
        self.case = make_case(mesh_folded_sheet(arrays, "all", subdivisions), self.settings)

    def begin(self) -> None:
        self.before, self.began = read_megabytes(), (time.process_time(), time.perf_counter())

    def analyse(self, *task):
        """Return record and arrays of an analysis, and whether the loop goes on."""
        from foldshell.sizing.iteration import IterationTask

        run = getattr(self.case, "run_in_loop", self.case.run)
        record, arrays = run(IterationTask(*task))
        return record, arrays, record.goes_on

    def step(self, last, arrays, memory):
        from foldshell.sizing.step import take_step

        return take_step(last, arrays, memory, self.settings.sizing)


class OldLoop(Loop):
    """The same by the library up to commit 792766a and some after it, whose settings are plain."""

    def __init__(self, arrays: dict[str, np.ndarray], subdivisions: int) -> None:
        import foldshell.shell.ready  # noqa: F401
        import yaml
        from foldshell.study.settings import make_settings
        from foldshell.study.stages import stage_parameters

        from foldshell.shell.mesh_files import mesh_folded_sheet
        from foldshell.sizing.case import make_case

        text = Path(sys.argv[1], "config", "config.yaml").read_text(encoding="utf-8")
        self.plain = stage_parameters(make_settings(yaml.safe_load(text), "config"), "size")
        self.begin()
        self.case = make_case(mesh_folded_sheet(arrays, "all", subdivisions), self.plain)

    def analyse(self, number, span, thickness, last, arrays):
        from foldshell.sizing.iteration import IterationTask

        task = IterationTask(number, span, thickness, last or {}, arrays or {})
        record, found = self.case.run(task)
        return record, found, record["verdict"] == "continue"

    def step(self, last, arrays, memory):
        from foldshell.sizing.step import take_step

        return take_step(last, arrays, memory or {}, self.plain["sizing"])


def run_kind(kind: Kind) -> dict[str, float]:
    """Return freedoms, CPU and wall s of the model and of analyses, MB and kB."""
    old = find_spec("foldshell.settings") is None
    loop = (OldLoop if old else Loop)(corrugated_dome(kind.lines), kind.subdivisions)
    model = loop.case.model
    seconds, goes_on = [time.process_time() - loop.began[0]], True
    thickness = np.round(np.full(model.sized_panels, kind.thickness), 4)
    last = arrays = memory = None
    span = float(np.ptp(model.mesh.nodes[:, 0]))
    while goes_on and len(seconds) <= kind.analyses:
        if last:
            step = loop.step(last, arrays, memory)
            thickness, memory = step.thickness, step.memory
        began = time.process_time()
        last, arrays, goes_on = loop.analyse(len(seconds) - 1, span, thickness, last, arrays)
        seconds.append(time.process_time() - began)
    return {
        "dofs": model.pattern.size, "build_s": seconds[0], "first_s": seconds[1],
        "iteration_s": float(np.median(seconds[2:] or seconds[1:])), "loop_s": sum(seconds),
        "wall_s": time.perf_counter() - loop.began[1], "analyses": len(seconds) - 1,
        "rss_mb": read_megabytes(),
        "kb_per_freedom": 1024 * (read_megabytes() - loop.before) / model.pattern.size,
        "thickness_sum": float(thickness.sum()),
        "bytes": hashlib.sha256(np.ascontiguousarray(arrays_of(arrays)).tobytes()).hexdigest()[:12],
    }  # fmt: skip


def arrays_of(arrays) -> np.ndarray:
    """Return the modes that an analysis found."""
    return arrays["buckling_modes"] if isinstance(arrays, dict) else arrays.buckling_modes


def read_megabytes() -> float:
    """Return the largest resident memory of this process so far, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


if __name__ == "__main__":
    sys.path.insert(0, str(Path(sys.argv[1]) / "scripts"))
    print(json.dumps(run_kind(KINDS[sys.argv[2]])))
