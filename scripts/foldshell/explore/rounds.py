"""The rounds of a search: which designs are tried next, cheap answers first."""

from collections.abc import Sequence

import numpy as np

from foldshell.explore.evaluate import screen
from foldshell.explore.fronts import find_front, rank_by
from foldshell.explore.names import name_candidate
from foldshell.explore.propose import choose_batch, gather, propose_points, to_columns
from foldshell.records.candidate import CandidateRecord, ScreenedRecord
from foldshell.settings.exploration import Exploration
from foldshell.settings.field import Plain
from foldshell.settings.stage import StageSettings


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
    cheap_first = number > 1 and search.method != "sobol" and search.screened > count
    if not cheap_first:
        points = propose_points(exploration, records, number, count)
        return _name(exploration, number, points), []
    points = propose_points(exploration, records, number, search.screened)
    rows = [exploration.make_row("screened", to_columns(exploration, point)) for point in points]
    answers = [screen(row, settings, exploration) for row in rows]
    chosen = _choose(exploration, records, points, answers, count, search.seed + number)
    return _name(exploration, number, chosen), answers


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


def _name(exploration: Exploration, number: int, points: np.ndarray) -> list[Plain]:
    return [
        exploration.make_row(name_candidate(number, place), to_columns(exploration, point))
        for place, point in enumerate(points)
    ]


def choose_best(
    exploration: Exploration, records: Sequence[CandidateRecord], count: int
) -> list[CandidateRecord]:
    """Return the best designs: of one aim in order, of two the front first; none alike."""
    kept = [record for record in records if record.feasible and record.candidate[:2] != "00"]
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
