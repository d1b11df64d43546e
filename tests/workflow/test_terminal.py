"""A run on a terminal: a few lines, where results are, a table at the end; errors stay."""

import os
import pty
import subprocess

import pytest
from study_runner import TARGET, command, make_study, run

pytestmark = pytest.mark.slow
SNAKEMAKES_OWN = ("Finished jobid", "Select jobs to execute", "steps (")


def run_on_terminal(code, folder, *arguments):
    """Run Snakemake with a terminal for stderr; return its exit code and what it wrote there."""
    ours, theirs = pty.openpty()
    process = subprocess.Popen(
        command(code, *arguments),
        cwd=folder,
        stdout=subprocess.DEVNULL,
        stderr=theirs,
        env=os.environ | {"TERM": "xterm", "LINES": "30", "COLUMNS": "120"},
    )
    os.close(theirs)
    parts = []
    while True:
        try:
            part = os.read(ours, 65536)
        except OSError:  # the other end is closed
            break
        if not part:
            break
        parts.append(part)
    os.close(ours)
    return process.wait(), b"".join(parts).decode().replace("\r\n", "\n")


def test_designs_verdicts_and_the_page_instead_of_hundreds_of_lines(code, tmp_path):
    folder = make_study(tmp_path / "study")
    code_of_end, said = run_on_terminal(code, folder, TARGET)
    assert code_of_end == 0, said[-3000:]
    assert f"results: {folder / 'results'}" in said
    begun = said.index("results: ")
    assert not any(words in said[begun:] for words in SNAKEMAKES_OWN)
    assert "0 of 2 designs sized" in said and "2 of 2 designs sized" in said
    table = said[said.rindex("design  ") :].splitlines()
    assert [line.split()[0] for line in table[1:3]] == ["tiny-dome", "tiny-saddle"]
    assert all("continue" not in line for line in table)
    logs = list((folder / ".snakemake/log").glob("*.log"))
    assert any("Finished jobid" in path.read_text() for path in logs)


def test_what_fails_is_said_above_the_view(code, tmp_path):
    """A workbook that is none, as a person may leave it; the other design goes on."""
    folder = make_study(tmp_path / "study")
    workbook = "results/tiny-dome/sizing/00/thickness.xlsx"
    assert run(code, folder, workbook).returncode == 0
    (folder / workbook).write_text("not a workbook")
    code_of_end, said = run_on_terminal(code, folder, TARGET)
    assert code_of_end != 0
    assert f"error: {workbook}: " in said and "Traceback" not in said
    assert "1 of 2 designs sized" in said


def test_verbose_shows_snakemakes_own_lines(code, tmp_path):
    folder = make_study(tmp_path / "study")
    target = "results/tiny-dome/pattern/crease_pattern.fold"
    _, said = run_on_terminal(code, folder, target, "--verbose")
    assert "Finished jobid" in said and "designs sized" not in said
