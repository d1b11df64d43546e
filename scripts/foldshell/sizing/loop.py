"""The sizing loop in memory: what the rules analyse and resize do, without files in between."""

from dataclasses import dataclass

import numpy as np

from foldshell.records.analysis import AnalysisRecord
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.settings.sizing import Sizing
from foldshell.sizing.case import AnalysisCase
from foldshell.sizing.delivery import choose_delivered, complete_delivered, describe_delivered
from foldshell.sizing.iteration import IterationTask
from foldshell.sizing.rounding import round_thickness
from foldshell.sizing.step import take_step


@dataclass(frozen=True)
class LoopResult:
    """The analyses of all iterations; what is delivered, as in final.json, and its arrays."""

    analyses: list[AnalysisRecord]
    final: AnalysisRecord
    arrays: AnalysisArrays


def run_loop(case: AnalysisCase, span: float, sizing: Sizing) -> LoopResult:
    """Analyse and resize from the start thickness until a verdict ends the loop.

    Every number equals that of the loop in files, to the last bit.
    """
    thickness = round_thickness(np.full(case.model.sized_panels, sizing.start_thickness))
    analyses: list[AnalysisRecord] = []
    states: list[AnalysisArrays] = []
    last = arrays = memory = None
    while last is None or last.goes_on:
        if last:
            step = take_step(last, arrays, memory, sizing)
            thickness, memory = step.thickness, step.memory
        last, arrays = case.run_in_loop(IterationTask(len(analyses), span, thickness, last, arrays))
        analyses.append(last)
        states.append(arrays)
    both = list(zip(analyses, states, strict=True))
    number = choose_delivered(analyses)
    final, arrays = both[number]
    if number < last.iteration:
        before = both[number - 1] if number else None
        final, arrays = complete_delivered(case, span, both[number], before)
    return LoopResult(analyses, describe_delivered(analyses, final), arrays)
