"""Rule timings: what the jobs of each rule took."""

import csv
from pathlib import Path

from foldshell.study.files import atomic_path
from foldshell.study.timings import COLUMNS, collect_timings


def main(folder: str | Path, csv_path: str | Path) -> None:
    """Write timings.csv, a row a rule; times differ from run to run, results do not."""
    with atomic_path(csv_path) as path, path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS)
        writer.writeheader()
        writer.writerows(collect_timings(folder))


if "snakemake" in globals():
    main(snakemake.params.folder, snakemake.output.csv)  # noqa: F821
