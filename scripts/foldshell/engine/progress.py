"""How far a study is: one line per iteration, a table of its designs, what is left."""

import statistics
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.files.whole import SECONDS
from foldshell.records.analysis import AnalysisRecord, read_analysis
from foldshell.records.files import TimeRecord, read_record

USUAL_ITERATIONS = 15
"""Iterations a design is taken to need until one of the study is done."""

_NUMBERS = (
    ("volume", "volume_m3", "{:.2f} m3"),
    ("largest panel mean of utilization", "utilization_panel_mean_max", "{:.3f}"),
    ("displacement", "displacement_vertical_max_m", "{:.4f} m"),
)


@dataclass(frozen=True)
class DesignProgress:
    """Iterations done of a design, the last analysis (None before the first), seconds of all, and
    the bytes of its mesh (None before it is made), to which the time of an analysis is about
    proportional."""

    design: str
    iterations: int
    last: AnalysisRecord | None
    seconds: float
    size: int | None = None

    @property
    def done(self) -> bool:
        """True once a verdict has ended the loop."""
        return self.last is not None and not self.last.goes_on


def print_line(text: str) -> None:
    """Print a line for people at once, so that lines of jobs do not mix."""
    sys.stderr.write(text + "\n")


def describe_iteration(design: str, analysis: AnalysisRecord) -> str:
    """Return one line: iteration, volume, utilization, displacement, factor, verdict, reason, and
    what the model does not hold."""
    words = [f"{design} iteration {analysis.iteration:02d}:"]
    for label, key, form in _NUMBERS:
        value = getattr(analysis, key)
        words.append(f"{label} {'-' if value is None else form.format(value)},")
    factor = analysis.least_factor
    words.append(f"buckling factor {'-' if factor is None else f'{factor:.2f}'},")
    words.append(f"{analysis.verdict}: {analysis.reason}")
    words += [f"(model: {analysis.warning})"] if analysis.warning else []
    return " ".join(words)


def read_progress(results: str | Path, designs: Iterable[str]) -> list[DesignProgress]:
    """Read the iterations of designs, up to the first missing, half-written or last one."""
    return [_read_design(Path(results) / name, name) for name in designs]


def _read_design(folder: Path, name: str) -> DesignProgress:
    last, number, seconds = None, 0, 0.0
    mesh = folder / "shell/mesh.npz"
    size = mesh.stat().st_size if mesh.exists() else None
    while last is None or last.goes_on:
        try:
            last = read_analysis(folder / f"sizing/{number:02d}/analysis.json")
        except InputError:
            break
        seconds += _read_seconds(folder / f"sizing/{number:02d}" / SECONDS)
        number += 1
    return DesignProgress(name, number, last, seconds, size)


def _read_seconds(path: Path) -> float:
    try:
        return read_record(path, TimeRecord).elapsed
    except InputError:
        return 0.0


def estimate_left(progress: Iterable[DesignProgress], cores: int) -> float | None:
    """Return the seconds that the analyses still to come take on `cores`, None before the first.

    Open designs are taken to need as many iterations as the median of those done, at least one
    more; an iteration takes the mean time so far for each byte of mesh, since the largest designs
    come first. A design without a mesh counts as a mean one. Other jobs of the study are not
    counted.
    """
    progress = list(progress)
    known = [item.size for item in progress if item.size]
    usual_size = statistics.mean(known) if known else 1
    work = sum(item.iterations * (item.size or usual_size) for item in progress)
    if not work:
        return None
    each = sum(item.seconds for item in progress) / work
    done = [item.iterations for item in progress if item.done]
    usual = statistics.median(done) if done else USUAL_ITERATIONS
    left = sum(
        max(1, usual - item.iterations) * (item.size or usual_size)
        for item in progress
        if not item.done
    )
    return each * left / max(1, cores)


def show_progress(progress: Iterable[DesignProgress], cores: int) -> str:
    """Return the text that a person looks at: one line per design, then totals."""
    progress = list(progress)
    lines = [
        describe_iteration(item.design, item.last) if item.last else f"{item.design}: not begun"
        for item in progress
    ]
    done = sum(item.done for item in progress)
    total = sum(item.iterations for item in progress)
    left = estimate_left(progress, cores)
    time = "unknown" if left is None else f"about {show_clock(left)}"
    lines.append(f"{done} of {len(progress)} designs sized, {total} iterations; left: {time}")
    return "\n".join(lines)


def show_clock(seconds: float) -> str:
    """Return a time in seconds as a person says it."""
    minutes = round(seconds / 60)
    if minutes < 1:
        return f"{round(seconds)} s"
    return f"{minutes} min" if minutes < 120 else f"{minutes / 60:.1f} h"
