"""A run of the workflow inside a rule, for a table of its own in a folder of its own."""

import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import yaml

from foldshell.files.errors import InputError
from foldshell.files.whole import write_text_if_changed
from foldshell.settings.stage import Plain


def run_table(
    table: str | Path,
    folder: str | Path,
    *,
    snakefile: str | Path,
    study: str,
    config: Plain,
    sizing: Mapping[str, object],
    cores: int,
    targets: Sequence[str] = (),
) -> None:
    """Run the study of a table of designs: settings `config`, those of `sizing` changed.

    Settings are written beside the folder. Raises `InputError` where not all of it could be made.
    """
    more = {"designs": str(table), "results": str(folder), "study": study}
    more |= {"exploration": "none", "loop": "whole", "sizing": config.get("sizing", {}) | sizing}
    settings = Path(f"{folder}.yaml")
    settings.parent.mkdir(parents=True, exist_ok=True)
    write_text_if_changed(settings, yaml.safe_dump(config | more, sort_keys=False))
    words = [sys.executable, "-m", "snakemake", "-s", str(snakefile), "--nolock"]
    words += ["--cores", str(cores), *targets, "--configfile", str(settings)]
    if subprocess.run(words).returncode:
        raise InputError(f"{folder}: not all designs of {table} were made: see above")
