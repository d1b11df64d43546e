"""Gather one row per design into summary.csv and summary.xlsx."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.files.errors import InputError
from foldshell.records.summary import SummaryRow
from foldshell.records.table import write_rows
from foldshell.results.summary import hash_study, make_summary_row
from foldshell.settings.design import Row
from foldshell.settings.stage import Plain, read_stage
from foldshell.settings.stages import STAGES
from foldshell.workbook.summary import write_summary


def main(
    designs: Sequence[Row],
    results: str | Path,
    settings: Plain,
    csv: str | Path,
    xlsx: str | Path,
) -> None:
    """Write both summaries of the designs, in their order.

    `designs` holds the columns of designs.tsv, `results` is the folder
    with one folder per design, and `settings` are the plain parameters of the stage `study`.
    """
    if not designs:
        raise InputError("summary: designs: none given: at least one is due")
    rows = [make_summary_row(row, Path(results) / row["design"]) for row in designs]
    write_rows(csv, SummaryRow, rows)
    write_summary(xlsx, rows, read_stage(settings, *STAGES["study"]), hash_study(rows))


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            designs=snakemake.params.designs,  # noqa: F821
            results=snakemake.params.results,  # noqa: F821
            settings=snakemake.params.settings,  # noqa: F821
            csv=snakemake.output.csv,  # noqa: F821
            xlsx=snakemake.output.xlsx,  # noqa: F821
        )
