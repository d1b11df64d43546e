"""The sizing loop in memory: what the rules analyse and resize do, without files in between."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from foldshell.settings.sizing import Sizing
from foldshell.sizing.case import AnalysisCase
from foldshell.sizing.iteration import IterationTask
from foldshell.sizing.rounding import round_thickness
from foldshell.sizing.step import take_step


@dataclass(frozen=True)
class LoopResult:
    """The reports (analysis.json) of all iterations and the arrays (analysis.npz) of the last."""

    reports: list[dict[str, Any]]
    arrays: dict[str, np.ndarray]


def run_loop(case: AnalysisCase, span: float, sizing: Sizing) -> LoopResult:
    """Analyse and resize from the start thickness until a verdict ends the loop.

    Every number equals that of the loop in files, to the last bit.
    """
    thickness = round_thickness(np.full(case.model.sized_panels, sizing.start_thickness))
    reports: list[dict[str, Any]] = []
    report: dict[str, Any] = {}
    arrays: dict[str, np.ndarray] = {}
    memory: Mapping[str, np.ndarray] = {}
    while not reports or report["verdict"] == "continue":
        if reports:
            step = take_step(report, arrays, memory, sizing)
            thickness, memory = step.thickness, step.memory
        report, arrays = case.run(IterationTask(len(reports), span, thickness, report, arrays))
        reports.append(report)
    return LoopResult(reports, arrays)
