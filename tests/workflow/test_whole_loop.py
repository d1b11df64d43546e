"""A loop in one job leaves the files of a loop by rules, and either way goes on with the other."""

import os
import shutil

import openpyxl
import pytest
from study_runner import TARGET, make_study, results, run, run_and_kill, times

pytestmark = pytest.mark.workflow

WHOLE = {"loop": "whole"}
LOOP = "results/tiny-dome/sizing"
CLASSES = [f"results/tiny-{name}/sizing/classes.json" for name in ("dome", "saddle")]
"""By rules made where they are asked for, in one job always."""


def finish(code, folder, loop):
    """Run a study to its end; return what Snakemake said."""
    done = run(code, folder, TARGET, *CLASSES, "--config", f"loop={loop}")
    assert done.returncode == 0, done.stderr[-3000:]
    return done.stderr


@pytest.fixture(scope="module")
def whole(code, tmp_path_factory):
    """Return the folder of a study that has run undisturbed, each loop in one job."""
    folder = make_study(tmp_path_factory.mktemp("whole"))
    finish(code, folder, "whole")
    return folder


@pytest.fixture(scope="module")
def by_rules(code, finished, tmp_path_factory):
    """Return the folder of the same study with its loops by rules."""
    folder = tmp_path_factory.mktemp("rules") / "study"
    shutil.copytree(finished, folder, symlinks=True, copy_function=shutil.copy2)
    finish(code, folder, "steps")
    return folder


def test_every_file_is_that_of_a_loop_by_rules(by_rules, whole):
    """The records of its jobs too, so that no result tells how the loop was run."""
    assert results(whole) == results(by_rules)


def test_a_second_start_has_nothing_to_do(code, whole):
    assert "Nothing to be done" in finish(code, whole, "whole")


@pytest.mark.parametrize(("first", "then"), [("steps", "whole"), ("whole", "steps")])
def test_a_run_is_begun_one_way_and_ended_in_the_other(code, by_rules, tmp_path, first, then):
    folder = make_study(tmp_path / "killed")
    begin = [TARGET, *CLASSES, "--config", f"loop={first}"]
    run_and_kill(code, folder, folder / LOOP / "02/thickness.xlsx", *begin)
    shutil.rmtree(folder / ".snakemake/locks", ignore_errors=True)
    finish(code, folder, then)
    assert results(folder) == results(by_rules)


def test_a_hand_edit_redoes_what_follows_and_only_that(code, whole, tmp_path):
    folder = tmp_path / "edited"
    shutil.copytree(whole, folder, symlinks=True, copy_function=shutil.copy2)
    book = openpyxl.load_workbook(folder / LOOP / "01/thickness.xlsx")
    book["thickness"]["D5"].value = 0.123
    book.save(folder / LOOP / "01/thickness.xlsx")
    os.utime(folder / LOOP / "01/thickness.xlsx", ns=(10**18, 10**18))
    before = times(folder, "results/**/*.*")
    finish(code, folder, "whole")
    after = times(folder, "results/**/*.*")
    changed = {name for name in after if before.get(name) != after[name]}
    assert not any("tiny-saddle" in name or f"{LOOP}/00" in name for name in changed)
    assert {f"{LOOP}/01/analysis.json", f"{LOOP}/02/thickness.xlsx", TARGET} <= changed
    book = openpyxl.load_workbook(folder / LOOP / "01/thickness.xlsx")
    assert book["thickness"]["D5"].value == 0.123
    assert "Nothing to be done" in finish(code, folder, "whole")
