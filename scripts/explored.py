"""Rule explored: all candidates of an exploration in tables, and the best of them chosen."""

import sys
from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.explore.rounds import choose_best
from foldshell.explore.tables import (
    describe_search,
    write_design_explorer,
    write_explored,
    write_selected,
)
from foldshell.records.candidate import read_candidate_record
from foldshell.settings.exploration import restore_exploration
from foldshell.settings.stage import Plain
from foldshell.workbook.explored import write_explored_workbook


def main(
    table_path: str | Path,
    workbook_path: str | Path,
    csv_path: str | Path,
    selected_path: str | Path,
    *,
    candidates: Sequence[str | Path],
    exploration: Plain,
) -> None:
    """Write selected.tsv, explore.xlsx, design_explorer.csv and explore.tsv.

    Raises `InputError` where no candidate keeps all limits, naming the one that excluded most;
    the tables are written all the same.
    """
    given = restore_exploration(exploration)
    records = [read_candidate_record(path) for path in candidates]
    best = choose_best(given, records, given.search.confirmed)
    write_selected(selected_path, given, best)
    write_explored_workbook(workbook_path, given, records, best)
    write_design_explorer(csv_path, given, records)
    write_explored(table_path, given, records)
    sys.stderr.write(describe_search(given, records) + "\n")


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(*snakemake.output, candidates=snakemake.input.candidates, **snakemake.params)  # noqa: F821
