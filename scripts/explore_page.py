"""Rule explore_page: all candidates of an exploration on one page that asks no host."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.files.whole import read_json, write_text_if_changed
from foldshell.records.candidate import read_candidate_record
from foldshell.records.summary import SummaryRow
from foldshell.records.table import read_rows
from foldshell.report.explore_page import make_explore_page
from foldshell.settings.exploration import restore_exploration
from foldshell.settings.stage import Plain


def main(
    page_path: str | Path,
    *,
    candidates: Sequence[str | Path],
    confirmed: str | Path,
    slopes: str | Path,
    exploration: Plain,
) -> None:
    """Write explore.html; `confirmed` is the summary of the best designs, empty without any."""
    records = [read_candidate_record(path) for path in candidates]
    rows = read_rows(confirmed, SummaryRow) if Path(confirmed).stat().st_size else []
    page = make_explore_page(restore_exploration(exploration), records, rows, read_json(slopes))
    write_text_if_changed(page_path, page)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.output.page,  # noqa: F821
            candidates=snakemake.input.candidates,  # noqa: F821
            confirmed=snakemake.input.confirmed,  # noqa: F821
            slopes=snakemake.input.slopes,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
