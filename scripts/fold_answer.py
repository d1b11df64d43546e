"""Rule fold_answer: all explorations beside Table 1 and the smooth shell, as a page and charts."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.explore.answer import list_found, read_searched
from foldshell.explore.answer_page import write_answer
from foldshell.explore.tables import join_tables
from foldshell.figures.answer_chart import draw_factors, draw_panels
from foldshell.files.whole import write_text_if_changed
from foldshell.records.summary import SummaryRow
from foldshell.records.table import read_rows


def main(
    page_path: str | Path,
    found_path: str | Path,
    pictures: Sequence[str | Path],
    *,
    tables: Sequence[str | Path],
    summary: str | Path | None = None,
    listed: Sequence[str] = (),
) -> None:
    """Write function_follows_fold.md, its two charts and found.tsv from the explore.tsv of
    explorations; `summary` is that of the study of the table, `listed` are the names of those
    that are set up."""
    searched = [read_searched(table) for table in tables]
    rows = read_rows(summary, SummaryRow) if summary else []
    draw_factors(pictures[0], searched)
    draw_panels(pictures[1], searched)
    home = Path(page_path).parent
    names = [Path(picture).relative_to(home).as_posix() for picture in pictures]
    write_text_if_changed(page_path, write_answer(searched, names, rows, listed))
    selected = [Path(table).with_name("selected.tsv") for table in tables]
    join_tables(found_path, [path for path in selected if path.is_file()], list_found(searched))


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.output.page,  # noqa: F821
            snakemake.output.found,  # noqa: F821
            snakemake.output.pictures,  # noqa: F821
            tables=snakemake.input.tables,  # noqa: F821
            summary=next(iter(snakemake.params.summary), None),  # noqa: F821
            listed=snakemake.params.listed,  # noqa: F821
        )
