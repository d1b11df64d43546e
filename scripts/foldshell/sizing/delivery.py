"""Which state of a loop is handed on: the last, or the best where the loop found no end."""

from collections.abc import Sequence
from dataclasses import fields as fields_of
from dataclasses import replace

from foldshell.records.analysis import AnalysisRecord, LastIteration, ShellState
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.sizing.case import AnalysisCase
from foldshell.sizing.criteria import NO_LIMITS
from foldshell.sizing.iteration import IterationTask
from foldshell.sizing.panel_limits import limits_of

UNFINISHED = ("not_converged", "unstable")
"""Verdicts of loops that did not end where they wanted to."""


def choose_delivered(analyses: Sequence[AnalysisRecord]) -> int:
    """Return the number of the iteration that is handed on.

    That is the last, or, where a loop ends without a state it accepts, the lightest that met every
    limit; of those only iterations since a person last changed panels.
    """
    last = analyses[-1]
    if last.verdict not in UNFINISHED:
        return last.iteration
    sound = [one for one in analyses[last.counted_from :] if meets_limits(one)]
    return min(sound, key=lambda one: one.volume_m3, default=last).iteration


def meets_limits(analysis: AnalysisRecord) -> bool:
    """Tell whether a state has an answer and keeps every limit."""
    names = {about.key for about, _ in analysis.criteria.items()}
    return (
        bool(names) and analysis.state == "ok" and set(analysis.criteria.open_names) <= {*NO_LIMITS}
    )


def describe_delivered(
    analyses: Sequence[AnalysisRecord], delivered: AnalysisRecord
) -> AnalysisRecord:
    """Return what final.json says: a state of the loop under the verdict that the loop ended with.

    `delivered` is its analysis.
    """
    last = analyses[-1]
    if delivered.iteration == last.iteration:
        return replace(delivered, delivered_iteration=last.iteration)
    reason = (
        f"{last.reason}; delivered: iteration {delivered.iteration}, the lightest that met every "
        "limit"
    )
    own = {name: getattr(last, name) for name in ("iteration", "volume_m3", "verdict", "reason")}
    return replace(
        delivered,
        verdict=last.verdict,
        reason=reason,
        delivered_iteration=delivered.iteration,
        last=LastIteration(**own, criteria=last.criteria),
    )


def complete_delivered(
    case: AnalysisCase,
    span: float,
    delivered: tuple[AnalysisRecord, AnalysisArrays],
    before: tuple[AnalysisRecord, AnalysisArrays] | None,
) -> tuple[AnalysisRecord, AnalysisArrays]:
    """Analyse a state of the loop once more, for the fields that only the last one has.

    `before` is the iteration before it, None for the first; span m. Every number is that of a full
    analysis, which inside the loop it need not have been.
    """
    record, arrays = delivered
    previous = before or (None, None)
    own = record.edited_panels, limits_of(arrays)
    task = IterationTask(record.iteration, span, arrays.thickness, *previous, *own)
    found, fields = case.run(task, alone=True)
    known = {one.name: getattr(found, one.name) for one in fields_of(ShellState)}
    more = {name: getattr(found, name) for name in ("criteria", "model_warnings")}
    bound = found.buckling_factor_bound
    return replace(record, **known, **more, buckling_factor_bound=bound), fields


def analyse_delivered(
    case: AnalysisCase, span: float, record: AnalysisRecord, arrays: AnalysisArrays
) -> tuple[AnalysisRecord, AnalysisArrays]:
    """Analyse the thicknesses of final.json anew, under what a case has changed; span m.

    The verdict is `converged` where every limit is still met, `not_converged` where one is not.
    """
    task = IterationTask(record.iteration + 1, span, arrays.thickness, record, arrays)
    found, fields = case.run(task, alone=True)
    sound = "converged" if meets_limits(found) else "not_converged"
    verdict = "unstable" if found.state in ("unstable", "mechanism") else sound
    return replace(found, iteration=record.iteration, verdict=verdict), fields
