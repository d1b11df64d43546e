"""The rounds of a search: which designs are tried next, cheap answers first."""

from collections.abc import Sequence

import numpy as np

from foldshell.explore.evaluate import screen
from foldshell.explore.found import gather, to_columns, to_point
from foldshell.explore.fronts import find_front, rank_by
from foldshell.explore.names import name_candidate
from foldshell.explore.propose import choose_batch, propose_points
from foldshell.explore.slopes import find_slopes, size_state
from foldshell.records.candidate import CandidateRecord, ScreenedRecord, is_found
from foldshell.settings.exploration import Exploration
from foldshell.settings.field import Plain
from foldshell.settings.stage import StageSettings

STEP = 0.1
"""Length of a step down the slopes, in ranges of the variables."""


def propose_round(
    exploration: Exploration,
    records: Sequence[CandidateRecord],
    number: int,
    settings: StageSettings,
) -> tuple[list[Plain], list[ScreenedRecord]]:
    """Return the rows of round `number`, from 1, and the cheap answers that chose them.

    `records` are those of all rounds before; `settings` Pattern, Fold and those of an analysis.
    """
    count, search = exploration.count_batch(number), exploration.search
    step = _go_down(exploration, records, settings) if number > 1 and search.gradient_step else []
    count -= len(step)
    cheap_first = number > 1 and search.method != "sobol" and search.screened > count
    if not cheap_first:
        points = propose_points(exploration, records, number, count)
        return _name(exploration, number, [*points, *step]), []
    points = propose_points(exploration, records, number, search.screened)
    rows = [exploration.make_row("screened", to_columns(exploration, point)) for point in points]
    answers = [screen(row, settings, exploration) for row in rows]
    chosen = _choose(exploration, records, points, answers, count, search.seed + number)
    return _name(exploration, number, [*chosen, *step]), answers


def _choose(
    exploration: Exploration,
    records: Sequence[CandidateRecord],
    points: np.ndarray,
    answers: Sequence[ScreenedRecord],
    count: int,
    seed: int,
) -> np.ndarray:
    """Return the points (count, d) to size: those that keep the limits of geometry, by promise."""
    good = np.array([one.cheap_m3 is not None and not one.broken for one in answers])
    if good.sum() <= count:
        return points[np.argsort(~good, kind="stable")][:count]
    found = gather(exploration, records)
    logs = np.log([one.cheap_m3 for one, kept in zip(answers, good, strict=True) if kept])
    return choose_batch(exploration, found, points[good], count, seed, logs)


def _go_down(
    exploration: Exploration, records: Sequence[CandidateRecord], settings: StageSettings
) -> list[np.ndarray]:
    """Return the point (d,) a step from the best so far down its slopes, none where it has none."""
    best = choose_best(exploration, records, 1)
    if not best:
        return []
    try:
        state = size_state(best[0].columns, settings, exploration)
        slopes = find_slopes(state, settings, exploration)
    except ValueError:
        return []
    names = [variable.name for variable in exploration.variables]
    downward = np.zeros(len(names))
    for slope in slopes:
        downward[names.index(slope.variable)] = -slope.per_range
    point = to_point(exploration, best[0])
    blocked = ((point >= 1) & (downward > 0)) | ((point <= 0) & (downward < 0))
    downward[blocked] = 0
    length = float(np.linalg.norm(downward))
    return [np.clip(point + STEP * downward / length, 0, 1)] if length > 0 else []


def _name(exploration: Exploration, number: int, points: Sequence[np.ndarray]) -> list[Plain]:
    return [
        exploration.make_row(name_candidate(number, place), to_columns(exploration, point))
        for place, point in enumerate(points)
    ]


def choose_best(
    exploration: Exploration, records: Sequence[CandidateRecord], count: int
) -> list[CandidateRecord]:
    """Return the best designs: of one aim in order, of two the front first; none alike."""
    kept = [record for record in records if record.feasible and is_found(record.candidate)]
    if len(exploration.aims) == 2:
        front = find_front(kept, exploration.aims)
        kept = [*front, *(record for record in rank_by(kept, exploration.aims[0])
                          if record not in front)]  # fmt: skip
    else:
        kept = rank_by(kept, exploration.aims[0])
    seen, best = [], []
    for record in kept:
        columns = tuple(record.columns.items())
        if columns not in seen:
            seen.append(columns)
            best.append(record)
    return best[:count]
