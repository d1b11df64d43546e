"""Rule propose: the designs of one round of an exploration, and the cheap answers behind them."""

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.explore.rounds import propose_round
from foldshell.explore.tables import write_candidates
from foldshell.files.libraries import need_library
from foldshell.files.whole import write_json
from foldshell.records.candidate import read_candidate_record
from foldshell.settings.exploration import restore_exploration
from foldshell.settings.stage import Plain, read_stage
from foldshell.settings.stages import SEARCHED


def main(
    table_path: str | Path,
    screened_path: str | Path,
    *,
    number: int,
    earlier: Sequence[str | Path],
    references: Sequence[Plain],
    exploration: Plain,
    settings: Plain,
) -> None:
    """Write candidates.tsv of a round, after screened.json, from the candidates of those before.

    Round 0 holds the `references`: rows of the table of designs like the base, the smooth shell.
    """
    rows, answers = list(references), []
    if number:
        need_library("sklearn", "explore")
        records = [read_candidate_record(path) for path in earlier]
        given = read_stage(settings, *SEARCHED)
        found = restore_exploration(exploration)
        rows, answers = propose_round(found, records, number, given)
    write_json(screened_path, [asdict(answer) for answer in answers])
    write_candidates(table_path, rows)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.output.table,  # noqa: F821
            snakemake.output.screened,  # noqa: F821
            number=int(snakemake.wildcards.round),  # noqa: F821
            earlier=snakemake.input.get("earlier", ()),  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
