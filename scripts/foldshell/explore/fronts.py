"""Which designs no other beats, and by what rank."""

from collections.abc import Callable, Iterable, Sequence
from typing import TypeVar

from foldshell.records.candidate import CandidateRecord
from foldshell.settings.exploration import AIMS

Tried = TypeVar("Tried")


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
    known = [one for one in records if all(getattr(one, aim) is not None for aim in aims)]
    first, second = ((aim, AIMS[aim]) for aim in aims)
    return sweep_front(
        sorted(known, key=lambda one: one.candidate),
        lambda one: first[1] * getattr(one, first[0]),
        lambda one: second[1] * getattr(one, second[0]),
    )


def sweep_front(
    tried: Iterable[Tried], first: Callable[[Tried], float], second: Callable[[Tried], float]
) -> list[Tried]:
    """Return what none beats in both of two numbers that are to be small, by the first number; of
    those that are alike in both the one that comes first."""
    front: list[Tried] = []
    for one in sorted(tried, key=lambda one: (first(one), second(one))):
        if not front or second(one) < second(front[-1]):
            front.append(one)
    return front
