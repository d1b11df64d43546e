"""A run on a terminal: a few lines that stay, in place of Snakemake's hundreds.

The view listens to Snakemake's logger by its plug-in interface: which jobs have begun and ended.
What has gone wrong is printed above it; everything else stands in Snakemake's own log file.
"""

import logging
import shutil
import sys
import threading
import time
from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path
from typing import TextIO

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from foldshell.engine.progress import DesignProgress, estimate_left, read_progress, show_clock
from foldshell.files.errors import InputError
from foldshell.files.whole import SECONDS
from foldshell.records.analysis import AnalysisRecord, read_analysis
from foldshell.records.files import TimeRecord, read_record

PAUSE = 0.2
"""Seconds between two drawings, at least."""
GLANCE = 2.0
"""Seconds between two looks at loops that run as one job each."""
STEP, WHOLE = "analyse", "size"
"""Rules whose jobs write analyses."""


class LiveView(LogHandlerBase):
    """Designs, iteration, verdict so far, time left; what goes wrong is printed above.

    Parameters
    ----------
    results : folder of the designs
    names : of the designs of the run
    cores : on which jobs run
    show : formats a record that says what has gone wrong
    stream : of the terminal
    """

    has_filter = has_formatter = writes_to_stream = True
    writes_to_file = needs_rulegraph = False

    def __init__(
        self,
        results: str | Path,
        names: Iterable[str],
        cores: int,
        show: Callable[[logging.LogRecord], str],
        stream: TextIO = sys.stderr,
    ) -> None:
        super().__init__(None, None)
        self._results, self._cores, self._show = Path(results), cores, show
        self._stream = stream
        self._jobs: dict[int, tuple[str, str, str]] = {}
        self._designs = {name: DesignProgress(name, 0, None, 0.0) for name in names}
        self._running: dict[int, str] = {}
        self._steps = (0, 0)
        self._lines, self._drawn = 0, 0.0
        self._begun: dict[str, float] = {}
        self._ended = threading.Event()
        threading.Thread(target=self._watch, daemon=True).start()

    def emit(self, record: logging.LogRecord) -> None:
        """Take note of a record of Snakemake, and draw anew."""
        event = getattr(record, "event", None)
        if record.levelno >= logging.WARNING:
            self.print_above(self._show(record))
        elif event == LogEvent.JOB_INFO:
            self._begin(record)
        elif event == LogEvent.JOB_FINISHED:
            self._end(record.job_id)
        elif event == LogEvent.PROGRESS:
            self._steps = record.done, record.total
            self._draw()

    def _begin(self, record: logging.LogRecord) -> None:
        wildcards = dict(record.wildcards or {})
        design = str(wildcards.get("design", ""))
        self._jobs[record.jobid] = record.rule_name, design, str(wildcards.get("iteration", ""))
        self._running[record.jobid] = f"{record.rule_name} {design}".strip()
        if record.rule_name == WHOLE:
            self._begun[design] = time.time() - 1
        self._draw()

    def _end(self, job: int) -> None:
        self._running.pop(job, None)
        rule, design, iteration = self._jobs.pop(job, ("", "", ""))
        if rule == STEP:
            self._take(design, int(iteration))
        elif rule == WHOLE and design in self._begun:
            self._advance(design, self._begun.pop(design))

    def _watch(self) -> None:
        """Look for new analyses of loops that run as one job each."""
        while not self._ended.wait(GLANCE):
            with self.lock:
                for design, since in self._begun.items():
                    self._advance(design, since)
                if self._begun:
                    self._draw()

    def _advance(self, design: str, since: float) -> None:
        """Take the analyses that a loop has written since it began."""
        number = self._designs[design].iterations if design in self._designs else 0
        path = self._results / design / "sizing" / f"{number:02d}" / "analysis.json"
        while path.is_file() and path.stat().st_mtime >= since and self._take(design, number):
            number += 1
            path = path.parents[1] / f"{number:02d}" / path.name

    def _take(self, design: str, iteration: int) -> bool:
        """Take note of an analysis; return whether it can be read."""
        folder = self._results / design / "sizing" / f"{iteration:02d}"
        try:
            last = read_analysis(folder / "analysis.json")
            seconds = read_record(folder / SECONDS, TimeRecord).elapsed
        except InputError:
            return False
        known = self._designs.get(design, DesignProgress(design, 0, None, 0.0))
        self._designs[design] = replace(
            known, iterations=iteration + 1, last=last, seconds=known.seconds + seconds
        )
        return True

    def print_above(self, text: str) -> None:
        """Print what is to stay, above the view."""
        self._erase()
        if text:
            self._stream.write(text.rstrip("\n") + "\n")
        self._draw(anyway=True)

    def close(self) -> None:
        """Take the view away."""
        self._ended.set()
        self._erase()
        self._stream.flush()
        super().close()

    def _erase(self) -> None:
        if self._lines:
            self._stream.write(f"\x1b[{self._lines}F\x1b[J")
        self._lines = 0

    def _draw(self, anyway: bool = False) -> None:
        now = time.monotonic()
        if not anyway and now < self._drawn + PAUSE:
            return
        self._drawn = now
        width, height = shutil.get_terminal_size()
        lines = [line[: width - 1] for line in self.describe(height - 4)]
        self._erase()
        self._stream.write("".join(f"{line}\n" for line in lines))
        self._stream.flush()
        self._lines = len(lines)

    def describe(self, most: int = 20) -> list[str]:
        """Return the lines of the view: designs in their loop first, at most so many."""
        designs = list(self._designs.values())
        begun = [item for item in designs if item.last and not item.done]
        ended = [item for item in designs if item.done]
        rows = [_describe(item) for item in [*begun, *reversed(ended)]]
        shown = rows[: max(1, most)]
        left = estimate_left([item for item in designs if item.last], self._cores)
        words = [f"{len(ended)} of {len(designs)} designs sized"]
        words += ["{} of {} steps".format(*self._steps)]
        words += [f"left: about {show_clock(left)}"] if left else []
        more = [f"... and {len(rows) - len(shown)} more"] if len(rows) > len(shown) else []
        now = ", ".join(list(self._running.values())[:3])
        return [*shown, *more, ", ".join(words), f"now: {now}" if now else "now: -"]


def _describe(item: DesignProgress) -> str:
    last: AnalysisRecord | None = item.last
    verdict = last.verdict if last else "-"
    used, volume = (last.utilization_panel_mean_max, last.volume_m3) if last else (None, None)
    return (
        f"{item.design:<40.40} {max(0, item.iterations - 1):>3}  {verdict:<20}"
        f" {_number(used):>8}  {_number(volume):>9} m3"
        + ("  model warning" if last and last.warning else "")
    )


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.3f}"


def describe_results(results: str | Path, designs: list[str], study: str | Path) -> str:
    """Return a table of designs and verdicts, and where the page of the study or of a design is."""
    progress = read_progress(results, designs)
    pages = [Path(study, "report.html"), *(Path(results, name, "page.html") for name in designs)]
    there = [path for path in pages if path.is_file()]
    head = f"{'design':<40} {'it':>3}  {'verdict':<20} {'util':>8}  {'volume':>9}"
    return "\n".join([head, *map(_describe, progress), *(f"open {path}" for path in there[:1])])
