"""Parts of a page: a titled section, and a framed verdict."""

from dataclasses import dataclass
from typing import Any

from foldshell.report.markup import Cell, Table


@dataclass(frozen=True)
class Box:
    """A framed verdict: good or bad, the word that stands out, the rest, a reason below it."""

    kind: str
    words: str
    head: str = ""
    reason: str | None = None


@dataclass(frozen=True)
class Folded:
    """A table that a click on its words shows; `shown` where it is open from the start."""

    words: str
    table: Table
    shown: bool = False


@dataclass(frozen=True)
class Section:
    """A titled part of a page; what it lacks is left out."""

    title: str
    box: Box | None = None
    words: str = ""
    table: Table | None = None
    chart: str = ""
    note: str = ""
    folded: Folded | None = None


def judge_met(met: Any) -> Cell:
    """Return yes in green, no in red, a dash where there is no answer."""
    return Cell("–") if met is None else Cell("yes", "good") if met else Cell("no", "bad")
