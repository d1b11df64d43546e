"""What the best of an exploration is held against: its base in the table, the smooth shell."""

from collections.abc import Sequence
from dataclasses import replace

from foldshell.explore.alike import MEASURE, RULE, size_alike
from foldshell.explore.bounds import list_bounds
from foldshell.explore.evaluate import evaluate
from foldshell.explore.fronts import rank_by
from foldshell.explore.rounds import choose_best
from foldshell.records.candidate import SIZED, CandidateRecord, is_found
from foldshell.records.rivals import ResizedRow, name_kind
from foldshell.settings.exploration import PAPER, Exploration
from foldshell.settings.field import Plain
from foldshell.settings.stage import StageSettings

COUNTS = ("zigzag", "strip")
FACTORS = (6.0, 12.0)
"""Buckling factors that shells are sized for, besides the limit of the search."""


def choose_rivals(
    exploration: Exploration, records: Sequence[CandidateRecord]
) -> list[CandidateRecord]:
    """Return the best design that was found, the row of the table that is the base itself (where
    there is none the lightest), the smooth shell."""
    first = [record for record in records if not is_found(record.candidate)]
    rows = [r for r in first if r.state == SIZED and _is_density(exploration, r)]
    smooth = [record for record in first if record.columns["pattern"] == "smooth"]
    own = [r for r in rows if all(r.columns[key] == exploration.base[key] for key in COUNTS)]
    table = (own or rank_by(rows, "volume_m3"))[:1]
    return [*choose_best(exploration, records, 1), *table, *smooth[:1]]


def _is_density(exploration: Exploration, record: CandidateRecord) -> bool:
    """Tell whether a row of the table differs from the base in its counts and variables alone."""
    free = {*COUNTS, *exploration.columns}
    same = (record.columns.get(key, value) == value for key, value in exploration.base.items()
            if key not in free)  # fmt: skip
    return record.columns["pattern"] != "smooth" and all(same)


def describe_exploration(
    exploration: Exploration, records: Sequence[CandidateRecord], settings: StageSettings
) -> Plain:
    """Return what was searched, and which ranges end where the best design stands."""
    best = choose_best(exploration, records, 1)
    return {
        "exploration": exploration.to_plain(),
        "bounds": [[name, end] for name, end in list_bounds(exploration, best)],
        "least_thickness_m": settings.sizing.least_thickness,
    }


def list_factors(exploration: Exploration, rivals: Sequence[CandidateRecord]) -> list[float]:
    """Return the factors to size for: the limit of the search, that of the best, a few more."""
    limit = exploration.limits.buckling_factor_min
    found = [r.buckling_factor_min for r in rivals if is_found(r.candidate)]
    more = [round(factor, 2) for factor in found if factor is not None]
    return sorted({limit, *(factor for factor in (*FACTORS, *more) if factor > limit)})


def resize(
    exploration: Exploration, records: Sequence[CandidateRecord], settings: StageSettings
) -> list[ResizedRow]:
    """Size each rival anew for each buckling factor by the rule `optimality`, on one mesh.

    A shell that keeps the next factor already is not sized again: that limit does not hold it; nor
    is one that a search by this rule has sized for its limit.
    """
    rows = []
    for rival in (rivals := choose_rivals(exploration, records)):
        known = rival if exploration.search.rule == RULE else None
        for factor in list_factors(exploration, rivals):
            if not _keeps(known, factor):
                known = _size_for(factor, rival, exploration, settings)
            rows.append(
                ResizedRow(
                    candidate=rival.candidate,
                    kind=name_kind(rival.candidate, rival.columns["pattern"]),
                    factor_due=factor, state=known.state, volume_m3=known.volume_m3,
                    buckling_factor_min=known.buckling_factor_min, iterations=known.iterations,
                )
            )  # fmt: skip
    return rows


def _keeps(known: CandidateRecord | None, factor: float) -> bool:
    sized = known is not None and known.state == SIZED
    return sized and (known.buckling_factor_min or 0.0) >= size_alike(factor)["buckling_factor_min"]


def _size_for(
    factor: float, rival: CandidateRecord, exploration: Exploration, settings: StageSettings
) -> CandidateRecord:
    given = replace(
        exploration,
        aims=("volume_m3",),
        limits=exploration.limits.changed(buckling_factor_min=factor, verdicts=PAPER),
        search=exploration.search.changed(rule=RULE, measure=MEASURE),
    )
    row = {**rival.columns, "design": rival.candidate}
    sizing = settings.sizing.changed(**size_alike(factor))
    return evaluate(rival.candidate, row, settings.changed(sizing), given)
