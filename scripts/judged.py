"""Rule judged: the best of an exploration and its rivals by the ordinary rules, one measure."""

from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.engine.nested import run_table
from foldshell.records.rivals import JudgedRow
from foldshell.records.table import write_rows
from foldshell.results.rivals import read_judged
from foldshell.settings.stage import Plain

STUDY = "found"


def main(
    table_path: str | Path,
    judged_path: str | Path,
    *,
    snakefile: str | Path,
    folder: str | Path,
    sizing: Plain,
    config: Plain,
    cores: int,
) -> None:
    """Size, cross-check and judge the designs of rivals.tsv; write what came out as a table."""
    summary = f"{folder}/studies/{STUDY}/summary.csv"
    run_table(
        table_path, folder, snakefile=snakefile, study=STUDY, config=config, sizing=sizing,
        cores=cores, targets=[summary],
    )  # fmt: skip
    write_rows(judged_path, JudgedRow, read_judged(summary, folder))


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.table,  # noqa: F821
            snakemake.output.judged,  # noqa: F821
            cores=snakemake.threads,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
