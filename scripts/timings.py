"""Rule timings: what the jobs of each rule took."""

from pathlib import Path

from foldshell.engine.timings import collect_timings
from foldshell.files.whole import atomic_path


def main(folder: str | Path, csv_path: str | Path) -> None:
    """Write timings.csv, one row per rule; times differ from run to run, results do not."""
    with atomic_path(csv_path) as temporary:
        collect_timings(folder).to_csv(temporary, index=False)


if "snakemake" in globals():
    main(snakemake.params.folder, snakemake.output.csv)  # noqa: F821
