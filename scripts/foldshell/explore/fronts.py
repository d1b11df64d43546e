"""Which designs no other beats, and by what rank."""

from collections.abc import Sequence

from foldshell.records.candidate import CandidateRecord
from foldshell.settings.exploration import AIMS


def rank_by(records: Sequence[CandidateRecord], aim: str) -> list[CandidateRecord]:
    """Return candidates by an aim, best first; those without a value come last."""

    def key(record: CandidateRecord) -> tuple[bool, float, str]:
        """Order by the aim; candidates that are alike in it by name."""
        value = getattr(record, aim)
        return value is None, AIMS[aim] * (value or 0.0), record.candidate

    return sorted(records, key=key)


def find_front(records: Sequence[CandidateRecord], aims: Sequence[str]) -> list[CandidateRecord]:
    """Return the candidates that none is better than in one of two aims and as good in the other,
    by the first aim."""
    first, second = aims
    front: list[CandidateRecord] = []
    for record in rank_by(records, first):
        values = getattr(record, first), getattr(record, second)
        if None in values:
            continue
        least = min((AIMS[second] * getattr(one, second) for one in front), default=float("inf"))
        if AIMS[second] * values[1] < least:
            same = front and getattr(front[-1], first) == values[0]
            front = [*(front[:-1] if same else front), record]
    return front
