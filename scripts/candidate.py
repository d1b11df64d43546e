"""Rule candidate: one design of an exploration, from its pattern to its thicknesses."""

import sys
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.explore.evaluate import evaluate
from foldshell.explore.tables import describe_candidate, read_candidate
from foldshell.records.candidate import write_candidate_record
from foldshell.settings.exploration import restore_exploration
from foldshell.settings.stage import Plain, read_stage
from foldshell.settings.stages import SEARCHED


def main(
    table_path: str | Path,
    json_path: str | Path,
    *,
    name: str,
    exploration: Plain,
    settings: Plain,
) -> None:
    """Size the candidate `name` of candidates.tsv; write candidate.json, whatever became of it."""
    row = read_candidate(table_path, name)
    given = read_stage(settings, *SEARCHED)
    record = evaluate(name, row, given, restore_exploration(exploration))
    write_candidate_record(json_path, record)
    sys.stderr.write(describe_candidate(record) + "\n")


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.table,  # noqa: F821
            snakemake.output.json,  # noqa: F821
            name=f"{snakemake.wildcards.round}-{snakemake.wildcards.place}",  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
