"""Rule confirm: the best candidates of an exploration as ordinary designs, sized and checked."""

import shutil
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.engine.nested import run_table
from foldshell.files.whole import atomic_path, write_text_if_changed
from foldshell.settings.stage import Plain


def main(
    selected_path: str | Path,
    summary_path: str | Path,
    *,
    snakefile: str | Path,
    folder: str | Path,
    sizing: Plain,
    config: Plain,
    cores: int,
) -> None:
    """Run the workflow for the table of selected designs in a folder of its own; copy its summary.

    Settings are those of this run, with `sizing` of the search in place of its own: rule, measure,
    buckling factor. Without a selected design the summary is empty.
    """
    if len(Path(selected_path).read_text(encoding="utf-8").splitlines()) < 2:
        return write_text_if_changed(summary_path, "")
    run_table(
        selected_path, folder, snakefile=snakefile, study="found", config=config, sizing=sizing,
        cores=cores,
    )  # fmt: skip
    with atomic_path(summary_path) as temporary:
        shutil.copyfile(Path(folder, "studies/found/summary.csv"), temporary)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.selected,  # noqa: F821
            snakemake.output.summary,  # noqa: F821
            cores=snakemake.threads,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
