"""Rule fold_answer: all explorations beside Table 1 and the smooth shell, as a page and a chart."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.explore.answer import read_searched, write_answer
from foldshell.figures.answer_chart import draw_answer
from foldshell.files.whole import write_text_if_changed


def main(page_path: str | Path, picture_path: str | Path, *, tables: Sequence[str | Path]) -> None:
    """Write function_follows_fold.md and .png from the explore.tsv of explorations."""
    searched = [read_searched(table) for table in tables]
    draw_answer(picture_path, searched)
    write_text_if_changed(page_path, write_answer(searched, Path(picture_path).name))


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.output.page,  # noqa: F821
            snakemake.output.picture,  # noqa: F821
            tables=snakemake.input.tables,  # noqa: F821
        )
