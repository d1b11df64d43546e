"""Rule schemas: JSON Schemas of the result files, beside the results."""

from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.records.schema import write_schemas


def main(paths: list[str]) -> None:
    """Write `<name>.schema.json` of every result file into the folder of `paths`."""
    written = write_schemas(Path(paths[0]).parent)
    if sorted(map(str, written)) != sorted(map(str, paths)):
        raise ValueError(f"schemas: {written} were written where {paths} are declared")


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(list(snakemake.output))  # noqa: F821
