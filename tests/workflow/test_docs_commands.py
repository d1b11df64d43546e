"""Commands of README and docs: each is tried, what makes results as a dry run."""

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from study_runner import REPOSITORY

PAGES = ("README.md", "CONTRIBUTING.md", "docs/tutorial.md")
NOT_TRIED = ("pip install",)
"""The wheel has its own test (`test_wheel.py`)."""


def list_commands(page):
    """Return the blocks of a page as lists of commands without their remarks."""
    text = (REPOSITORY / page).read_text(encoding="utf-8")
    blocks = re.findall(r"```sh\n(.*?)```", text, re.S)
    lines = [[line.split("  #")[0].strip() for line in block.splitlines()] for block in blocks]
    return [line for block in lines for line in block if line]


def try_command(line, folder):
    """Run a command of a page from `folder`; return the folder that it leaves one in."""
    words = shlex.split(line)
    if line.startswith(NOT_TRIED):
        return folder
    if words[0] == "cd":
        return folder / words[1]
    if words[:2] == ["foldshell", "look"]:  # there is no page yet: it says so in one sentence
        done = start(["-m", "foldshell", *words[1:]], folder)
        assert done.returncode == 1 and "run the study first" in done.stderr
        return folder
    if words[0] == "foldshell":
        dry = ["-n", "-q"] if words[1] == "run" else []
        done = start(["-m", "foldshell", *words[1:], *dry], folder)
    elif words[0] == "snakemake":
        done = start(["-m", "snakemake", *words[1:], "-n", "-q"], REPOSITORY)
    else:
        assert words[0] == "make", f"{line}: not known how to try it"
        if shutil.which("make") is None:
            return folder
        done = subprocess.run([*words, "-n"], cwd=REPOSITORY, capture_output=True, text=True)
    assert done.returncode == 0, f"{line}: {done.stderr[-2000:]}"
    return folder


def start(arguments, folder):
    """Start Python with the library of the checkout."""
    path = os.pathsep.join([str(Path(REPOSITORY) / "scripts"), os.environ.get("PYTHONPATH", "")])
    return subprocess.run(
        [sys.executable, *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        env=os.environ | {"PYTHONPATH": path},
    )


@pytest.mark.parametrize("page", PAGES)
def test_commands_of_a_page(page, tmp_path):
    """In their order, since `foldshell new` and `cd` lead to what follows."""
    commands, folder = list_commands(page), tmp_path
    assert commands
    for line in commands:
        folder = try_command(line, folder)


def test_the_table_of_the_tutorial_is_a_table(tmp_path):
    """Its three rows are read by the study that it tells of, and three designs are planned."""
    text = (REPOSITORY / "docs/tutorial.md").read_text(encoding="utf-8")
    (table,) = re.findall(r"```tsv\n(.*?)```", text, re.S)
    assert start(["-m", "foldshell", "new", "roof"], tmp_path).returncode == 0
    (tmp_path / "roof/config/designs.tsv").write_text(table, encoding="utf-8")
    done = start(["-m", "foldshell", "run", "-n"], tmp_path / "roof")
    assert done.returncode == 0, done.stderr[-2000:]
    planned = done.stdout + done.stderr
    for name in ("first-dome", "open-dome", "saddle"):
        assert f"results/{name}/" in planned
