"""Rule export_index: the page that lists a design's files for other programs."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.exchange.index_page import write_index
from foldshell.files.whole import atomic_path, read_json


def main(record_paths: Sequence[str | Path], page_path: str | Path, *, design: str) -> None:
    """Write exports/index.html from the records of the formats."""
    records = [read_json(path) for path in record_paths]
    text = write_index(Path(page_path).parent, design, records)
    with atomic_path(page_path) as temporary:
        temporary.write_text(text, encoding="utf-8")


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.records,  # noqa: F821
            snakemake.output.page,  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
        )
