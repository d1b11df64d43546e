"""Rule rivals: what the best of an exploration is held against, sized for several factors."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.explore.rivals import choose_rivals, describe_exploration, resize
from foldshell.explore.tables import write_selected
from foldshell.files.whole import write_json
from foldshell.records.candidate import read_candidate_record
from foldshell.records.rivals import ResizedRow
from foldshell.records.table import write_rows
from foldshell.settings.exploration import restore_exploration
from foldshell.settings.stage import Plain, read_stage
from foldshell.settings.stages import SEARCHED


def main(
    table_path: str | Path,
    about_path: str | Path,
    resized_path: str | Path,
    *,
    candidates: Sequence[str | Path],
    exploration: Plain,
    settings: Plain,
) -> None:
    """Write rivals.tsv (a table of designs), about.json and resized.csv."""
    given, stage = restore_exploration(exploration), read_stage(settings, *SEARCHED)
    records = [read_candidate_record(path) for path in candidates]
    write_selected(table_path, given, choose_rivals(given, records))
    write_json(about_path, describe_exploration(given, records, stage))
    write_rows(resized_path, ResizedRow, resize(given, records, stage))


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(*snakemake.output, candidates=snakemake.input.candidates, **snakemake.params)  # noqa: F821
