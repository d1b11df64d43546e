"""Rule claims_page: claims.md as a page for the report."""

from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.files.whole import atomic_path
from foldshell.report.study_pages import write_markdown_page


def main(claims: str | Path, page: str | Path) -> None:
    """Write the page of claims.md."""
    text = Path(claims).read_text(encoding="utf-8")
    with atomic_path(page) as temporary:
        temporary.write_text(write_markdown_page("Claims", text), encoding="utf-8")


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(snakemake.input.claims, snakemake.output.page)  # noqa: F821
