"""The sizing loop in memory: what the rules analyse and resize do, without files in between."""

from dataclasses import dataclass

from foldshell.records.analysis import AnalysisRecord
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.settings.sizing import Sizing
from foldshell.sizing.case import AnalysisCase
from foldshell.sizing.delivery import choose_delivered, complete_delivered, describe_delivered
from foldshell.sizing.iteration import IterationTask
from foldshell.sizing.panel_limits import PanelLimits
from foldshell.sizing.start import start_thicknesses
from foldshell.sizing.step import take_step


@dataclass(frozen=True)
class LoopResult:
    """The analyses of all iterations; what is delivered, as in final.json, and its arrays."""

    analyses: list[AnalysisRecord]
    final: AnalysisRecord
    arrays: AnalysisArrays


def run_loop(
    case: AnalysisCase, span: float, sizing: Sizing, limits: PanelLimits | None = None
) -> LoopResult:
    """Analyse and resize from the start thickness until a verdict ends the loop.

    Every number equals that of the loop in files, to the last bit. `limits` are what the columns of
    thickness.xlsx ask of panels.
    """
    thickness = start_thicknesses(case.model.sized_panels, sizing, limits)
    analyses: list[AnalysisRecord] = []
    states: list[AnalysisArrays] = []
    last = arrays = memory = None
    while last is None or last.goes_on:
        if last:
            step = take_step(last, arrays, memory, sizing)
            thickness, memory = step.thickness, step.memory
        task = IterationTask(len(analyses), span, thickness, last, arrays, limits=limits)
        last, arrays = case.run_in_loop(task)
        analyses.append(last)
        states.append(arrays)
    both = list(zip(analyses, states, strict=True))
    number = choose_delivered(analyses)
    final, arrays = both[number]
    if number < last.iteration:
        before = both[number - 1] if number else None
        final, arrays = complete_delivered(case, span, both[number], before)
    return LoopResult(analyses, describe_delivered(analyses, final), arrays)
