"""Rule slopes: how the volume of the best candidates changes with each variable."""

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.explore.rounds import choose_best
from foldshell.explore.slopes import find_slopes, size_state
from foldshell.files.whole import write_json
from foldshell.records.candidate import read_candidate_record
from foldshell.settings.exploration import restore_exploration
from foldshell.settings.stage import Plain, read_stage
from foldshell.settings.stages import SEARCHED


def main(
    json_path: str | Path, *, candidates: Sequence[str | Path], exploration: Plain, settings: Plain
) -> None:
    """Write slopes.json: one entry a design, with its slopes or the reason why it has none."""
    given, stage = restore_exploration(exploration), read_stage(settings, *SEARCHED)
    records = [read_candidate_record(path) for path in candidates]
    found = []
    for record in choose_best(given, records, given.search.slopes):
        entry = {"candidate": record.candidate, "reason": "", "residual": None, "slopes": []}
        try:
            state = size_state(record.columns, stage, given)
            slopes = find_slopes(state, stage, given)
            entry |= {"residual": state.residual, "slopes": [asdict(one) for one in slopes]}
        except ValueError as error:
            entry["reason"] = str(error)
        found.append(entry)
    write_json(json_path, found)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.output.json,  # noqa: F821
            candidates=snakemake.input.candidates,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
