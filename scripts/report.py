"""Rule report: the report of the study, one HTML file that asks no host for anything."""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.files.whole import atomic_path
from foldshell.report.provenance import find_provenance
from foldshell.report.study_report import read_study, write_study_report
from foldshell.settings.stage import Plain, read_stage
from foldshell.settings.stages import STAGES


def main(
    paths: Mapping[str, str | Path | Sequence[str]],
    figures: Mapping[str, str | Path],
    report: str | Path,
    *,
    study: str,
    results: str | Path,
    project: str | Path,
    settings: Plain,
    left_out: Mapping[str, str],
    beside: Mapping[str, Sequence[str]] | None = None,
) -> None:
    """Write the report.

    Parameters
    ----------
    paths : summary (csv), tiles (json), verification (md), claims and reinforced (json) where they
        are judged, and fold (the answer of explorations as md, its charts) where there are any
    figures : charts, PNG files by name
    study : tag of the study
    results : folder with one folder per design
    project : folder of the workflow, for its commit
    settings : plain parameters of stage `study`
    left_out : charts that were not made, with the reason
    beside : summaries of other studies by tag, each a path first
    """
    others = {tag: path for tag, (path, *_) in (beside or {}).items()}
    files = read_study(study, paths, results, figures, others)
    way = Path(os.path.relpath(results, Path(report).parent)).as_posix()
    page = write_study_report(
        files, read_stage(settings, *STAGES["study"]), find_provenance(project), way, left_out
    )
    with atomic_path(report) as temporary:
        temporary.write_text(page, encoding="utf-8")


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            {name: path for name, path in snakemake.input.items() if path},  # noqa: F821
            {Path(path).stem: path for path in snakemake.input.figures},  # noqa: F821
            snakemake.output.report,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
