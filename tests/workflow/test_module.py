"""The workflow as a module of another one: its folder, its settings and table, with a prefix."""

import os
import subprocess
import sys

import pytest
import yaml
from study_runner import DESIGNS, HEADER, SETTINGS, results

SNAKEFILE = """
configfile: "other.yaml"

module shells:
    snakefile: "{code}/Snakefile"
    config: config["shells"]{prefix}

use rule * from shells as shells_*

rule roofs:
    default_target: True
    input: "{place}results/roofs/tiny-dome/manifest.json"
    output: "roofs.txt"
    shell: "cp {{input}} {{output}}"
"""


def make_other(code, folder, prefix):
    """Write another workflow, which has ours as a module."""
    (folder / "tables").mkdir(parents=True)
    (folder / "tables/roofs.tsv").write_text(HEADER + DESIGNS)
    place = f"{prefix}/" if prefix else ""
    line = f'\n    prefix: "{prefix}"' if prefix else ""
    text = SNAKEFILE.format(code=code, prefix=line, place=place)
    (folder / "Snakefile").write_text(text)
    config = SETTINGS | {"designs": "tables/roofs.tsv"}
    (folder / "other.yaml").write_text(yaml.safe_dump({"mine": 1, "shells": config}))
    return folder


CONDA = """#!/bin/sh
case "$*" in
    *info*) echo '{"conda_version": "24.9.0", "platform": "linux-64", "conda_prefix": "/tmp"}' ;;
    *config*) echo '{"get": {"channel_priority": "strict"}}' ;;
    *) echo "conda 24.9.0" ;;
esac
"""
"""What a dry run asks of conda: which one it is."""


def add_conda(folder):
    """Put a conda that answers into a folder; return the environment with it on the path."""
    folder.mkdir()
    (folder / "conda").write_text(CONDA)
    (folder / "conda").chmod(0o755)
    return os.environ | {"PATH": f"{folder}:{os.environ['PATH']}"}


def run_other(folder, *arguments, env=None):
    command = [sys.executable, "-m", "snakemake", "--cores", "2", *arguments]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=env)
    assert done.returncode == 0, done.stderr[-3000:]
    return done.stdout + done.stderr


@pytest.mark.parametrize("prefix", ["", "ours"])
def test_dry_run_from_another_folder(code, tmp_path, prefix):
    """With the environments of conda too."""
    folder = make_other(code, tmp_path / "other", prefix)
    said = run_other(folder, "-n", "--sdm", "conda", env=add_conda(tmp_path / "bin"))
    assert "shells_analyse" in said and "shells_pattern" in said
    assert "envs/foldshell.yaml will be created" in said


def test_a_design_below_a_prefix_has_the_same_files(code, finished, tmp_path):
    """Those that hang on no settings of the study: the same design by the same settings."""
    folder = make_other(code, tmp_path / "other", "ours")
    run_other(folder)
    assert "Nothing to be done" in run_other(folder)
    made = tmp_path / "compared"
    made.mkdir()
    (folder / "ours/results/roofs").rename(made / "results")
    ours = {name: one for name, one in results(made).items() if "tiny-dome/sizing" in name}
    alone = results(finished)
    assert len(ours) > 20 and ours == {name: alone[name] for name in ours}
