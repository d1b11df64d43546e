"""Rule snakemake_report: Snakemake's own report of what is done, in one HTML file."""

import subprocess
import sys
import tempfile
from pathlib import Path

import yaml

from foldshell.engine.job import run_job
from foldshell.files.errors import InputError
from foldshell.files.whole import atomic_path
from foldshell.settings.field import Plain


def main(
    report: str | Path,
    stylesheet: str | Path,
    snakefile: str,
    target: str,
    config: Plain,
) -> None:
    """Let a second Snakemake, which runs no job, gather what is flagged below `target`.

    It works in the same folder while the first one holds the lock, and gets all settings that the
    first one has, wherever they came from, in a file. `stylesheet` is added to Snakemake's own.
    """
    with atomic_path(report) as temporary, tempfile.TemporaryDirectory() as folder:
        settings = Path(folder) / "config.yaml"
        settings.write_text(yaml.safe_dump(dict(config)), encoding="utf-8")
        command = [sys.executable, "-m", "snakemake", "--nolock", "--cores", "1", "-s", snakefile]
        command += ["--report", str(temporary), target, "--configfile", str(settings)]
        command += ["--report-stylesheet", str(stylesheet)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode or not temporary.stat().st_size:
            last = (done.stderr.strip().splitlines() or ["no message"])[-1]
            raise InputError(f"{report}: snakemake --report: {last}: it must end without an error")


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.output.report,  # noqa: F821
            snakemake.input.stylesheet,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
