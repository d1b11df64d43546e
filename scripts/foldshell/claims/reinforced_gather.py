"""What the claims on reinforced shells rest on, read from the results folder."""

from collections.abc import Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import NamedTuple

from foldshell.claims.design_result import DesignResult
from foldshell.claims.gather import name_damage, read_flats
from foldshell.claims.read import read_design_result
from foldshell.claims.reinforced_state import list_errors
from foldshell.records.design_row import DesignRow
from foldshell.records.files import read_record
from foldshell.records.measures import FlatEqualRecord, Geometry
from foldshell.records.reinforced_claims import ReinforcedRecord
from foldshell.settings.stage import StageSettings

FOLDER = "sensitivity/reinforced"
"""Below the results: <design>.json of each."""


class ReinforcedSources(NamedTuple):
    """Results sized by the paper's criteria, the same designs reinforced, start states, both flat
    sheets by folded design, and the records of the second."""

    paper: list[DesignResult]
    reinforced: list[DesignResult]
    equal: list[DesignResult]
    flats: dict[str, tuple[FlatEqualRecord, FlatEqualRecord]]
    states: list[ReinforcedRecord]


def read_reinforced_sources(
    results: Path,
    designs: Sequence[DesignRow],
    flats: Sequence[DesignRow],
    settings: StageSettings,
) -> ReinforcedSources:
    """Read designs as they were sized before, and as they stand reinforced.

    Raises
    ------
    InputError
        for a file that is missing or damaged.
    """
    with name_damage():
        both = [read_design_result(row, results / row.design, settings) for row in designs]
        states = [read_record(results / FOLDER / f"{row.design}.json", ReinforcedRecord)
                  for row in designs]  # fmt: skip
        equal_volume = read_flats(results, flats)
    paper = [final for final, _ in both]
    return ReinforcedSources(
        paper=paper,
        reinforced=[stand(one, state) for one, state in zip(paper, states, strict=True)],
        equal=[start for _, start in both],
        flats={state.design: (equal_volume[state.design], state.flat) for state in states
               if state.flat and state.design in equal_volume},
        states=states,
    )  # fmt: skip


def stand(paper: DesignResult, state: ReinforcedRecord) -> DesignResult:
    """Return a design as it stands reinforced: its folding is that of before."""
    geometry = {one.name: getattr(paper.values, one.name) for one in fields(Geometry)}
    return replace(
        paper,
        values=replace(state.measures, **geometry),
        errors=list_errors(state.mesh_errors, paper.errors),
        panels=None,
        warning=None,
        strips=None,
    )
