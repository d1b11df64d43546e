"""The wheel: in an empty environment it makes a study of its own, equal to the checkout's."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from study_runner import REPOSITORY, change_setting, command, results

pytestmark = pytest.mark.slow
TARGET = "results/first-dome/page.html"
SMALL = {"analysis": ("subdivisions", 1), "sizing": ("iterations_max", 3)}


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """Return the bin folder of a fresh virtual environment with nothing but the built wheel."""
    folder = tmp_path_factory.mktemp("wheel")
    pip = [sys.executable, "-m", "pip", "-q", "--disable-pip-version-check"]
    subprocess.run([*pip, "wheel", "--no-deps", "-w", folder, REPOSITORY], check=True)
    subprocess.run([sys.executable, "-m", "venv", folder / "venv"], check=True)
    (wheel,) = folder.glob("*.whl")
    subprocess.run([folder / "venv/bin/pip", "install", "-q", wheel], check=True)
    return folder / "venv/bin"


def foldshell(environment, folder, *arguments):
    """Run the command `foldshell` with nothing of this project on the path."""
    done = subprocess.run(
        [environment / "foldshell", *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        env={"PATH": f"{environment}:/usr/bin:/bin", "HOME": str(folder)},
    )
    assert done.returncode == 0, done.stderr[-3000:]
    return done


def test_a_study_of_the_wheel_equals_that_of_the_checkout(environment, tmp_path):
    foldshell(environment, tmp_path, "new", "mine")
    mine, other = tmp_path / "mine", tmp_path / "other"
    for group, change in SMALL.items():
        change_setting(mine, group, *change)
    shutil.copytree(mine, other)
    foldshell(environment, mine, "run", TARGET)
    done = subprocess.run(command(REPOSITORY, TARGET), cwd=other, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-3000:]
    made = results(mine)
    assert TARGET in made and made == results(other)
    assert "1 of 1 designs sized" in foldshell(environment, mine, "progress").stdout
    assert TARGET in foldshell(environment, mine, "look", "first-dome").stdout


def test_the_same_run_by_snakemake_itself(environment, tmp_path):
    foldshell(environment, tmp_path, "new", "mine")
    program = [environment / "snakemake", "--cores", "2", "-n"]
    done = subprocess.run(program, cwd=tmp_path / "mine", capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-3000:]
    assert "first-dome" in done.stdout and "report" in done.stdout


def test_the_library_of_the_wheel_runs_its_page(environment, tmp_path):
    import re

    page = (REPOSITORY / "docs/library.md").read_text()
    examples = re.findall(r"```python\n(.*?)```", page, re.S)
    script = tmp_path / "examples.py"
    script.write_text("\n".join(examples))
    subprocess.run([environment / "python", script], cwd=tmp_path, check=True)
    assert Path(tmp_path / "thickness.xlsx").exists()
