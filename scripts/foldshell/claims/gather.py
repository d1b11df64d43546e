"""Everything that claims rest on, read from the results folder."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from foldshell.claims.design_result import DesignResult
from foldshell.claims.read import read_design_result, read_fold, read_variant
from foldshell.files.errors import InputError
from foldshell.files.whole import read_json
from foldshell.settings.stage import StageSettings

Rows = Sequence[Mapping[str, Any]]


class Sources(NamedTuple):
    """What `judge_study` takes, in its order."""

    design_results: list[DesignResult]
    equal: list[DesignResult]
    folds: list[DesignResult]
    kinematics: Mapping[str, Any]
    flats: dict[str, Mapping[str, Any]]
    variants: dict[str, list[DesignResult]]


def read_sources(
    results: Path, designs: Mapping[str, Rows], variants: Sequence[str], settings: StageSettings
) -> Sources:
    """Read designs in full, folds, kinematics, flat sheets and runs with other settings.

    Raises
    ------
    InputError
        for a file that is missing or damaged.
    """
    try:
        both = [
            read_design_result(row, results / row["design"], settings) for row in designs["sized"]
        ]
        named = {final.name: final for final, _ in both}
        return Sources(
            [final for final, _ in both],
            [start for _, start in both],
            [read_fold(row, results / row["design"]) for row in designs["folds"]],
            read_json(results / "kinematics.json"),
            {
                row["design"]: read_json(results / row["design"] / "flat_equal.json")
                for row in designs["flats"]
            },
            {
                variant: [
                    read_variant(
                        named[row["design"]],
                        read_json(results / "sensitivity" / variant / f"{row['design']}.json"),
                    )
                    for row in designs["runs"]
                ]
                for variant in variants
            },
        )
    except (OSError, ValueError, KeyError) as error:
        raise InputError(
            f"claims: {getattr(error, 'filename', None) or error}: missing or damaged: delete it "
            "and start again, it is computed anew"
        ) from None
