"""Everything that claims rest on, read from the results folder."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple
from zipfile import BadZipFile

from foldshell.claims.design_result import DesignResult
from foldshell.claims.read import read_design_result, read_fold, read_variant
from foldshell.files.errors import InputError
from foldshell.records.design_row import DesignRow
from foldshell.records.files import REMEDY, read_record
from foldshell.records.kinematics import KinematicsRecord
from foldshell.records.measures import FlatEqualRecord
from foldshell.settings.stage import StageSettings


class Sources(NamedTuple):
    """What `judge_study` takes, in its order."""

    design_results: list[DesignResult]
    equal: list[DesignResult]
    folds: list[DesignResult]
    kinematics: KinematicsRecord
    flats: dict[str, FlatEqualRecord]
    variants: dict[str, list[DesignResult]]


def read_sources(
    results: Path,
    designs: Mapping[str, Sequence[DesignRow]],
    variants: Sequence[str],
    settings: StageSettings,
) -> Sources:
    """Read designs in full, folds, kinematics, flat sheets and runs with other settings.

    Raises
    ------
    InputError
        for a file that is missing or damaged.
    """
    with name_damage():
        return _read(results, designs, variants, settings)


@contextmanager
def name_damage() -> Iterator[None]:
    """Make an `InputError` with its name of what a missing or damaged file raises."""
    try:
        yield
    except InputError:
        raise
    except (OSError, ValueError, KeyError, BadZipFile) as error:
        found = getattr(error, "filename", None) or error
        raise InputError(f"claims: {found}: missing or damaged: {REMEDY}") from None


def read_flats(results: Path, designs: Sequence[DesignRow]) -> dict[str, FlatEqualRecord]:
    """Return what the flat sheets of equal volume do, by folded design."""
    return {
        row.design: read_record(results / row.design / "flat_equal.json", FlatEqualRecord)
        for row in designs
    }


def _read(results: Path, designs, variants, settings) -> Sources:
    both = [read_design_result(row, results / row.design, settings) for row in designs["sized"]]
    named = {final.name: final for final, _ in both}
    return Sources(
        design_results=[final for final, _ in both],
        equal=[start for _, start in both],
        folds=[read_fold(row, results / row.design) for row in designs["folds"]],
        kinematics=read_record(results / "kinematics.json", KinematicsRecord),
        flats=read_flats(results, designs["flats"]),
        variants={
            variant: [
                read_variant(
                    named[row.design], results / "sensitivity" / variant / f"{row.design}.json"
                )
                for row in designs["runs"]
            ]
            for variant in variants
        },
    )
