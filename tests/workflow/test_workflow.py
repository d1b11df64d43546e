"""A tiny study by Snakemake: results, reruns, hand edits, kills, errors."""

import csv
import json
import os
import re
import shutil

import jsonschema
import openpyxl
import pytest
from study_runner import (
    DESIGNS,
    SETTINGS,
    TARGET,
    change_setting,
    hashes,
    make_study,
    results,
    run,
    run_and_kill,
    times,
)

from foldshell.records.catalogue import FILES
from foldshell.records.plain import to_plain
from foldshell.records.schema import make_schema
from foldshell.records.table import read_rows


@pytest.fixture
def copied(finished, tmp_path):
    """Return a copy of the finished study, times of files kept, to disturb."""
    folder = tmp_path / "copy"
    shutil.copytree(finished, folder, symlinks=True, copy_function=shutil.copy2)
    return folder


def last_iteration(folder, design):
    return json.loads((folder / f"results/{design}/sizing/final.json").read_text())


def edit(path, panel, thickness):
    """Type a thickness into a workbook, as a person would."""
    book = openpyxl.load_workbook(path)
    sheet = book["thickness"]
    for row in sheet.iter_rows(min_row=3):
        if row[0].value == panel:
            row[3].value = thickness
    book.save(path)


def test_every_design_ends_with_a_verdict_and_a_cross_check(finished):
    header, *rows = (finished / TARGET).read_text().splitlines()
    assert header.startswith("design,tags,pattern,surface,span_m")
    assert [row.split(",")[0] for row in rows] == ["tiny-dome", "tiny-saddle"]
    for design in ("tiny-dome", "tiny-saddle"):
        last = last_iteration(finished, design)
        assert last["verdict"] in ("converged", "not_converged", "at_minimum_thickness")
        assert last["reaction_imbalance"] < 1e-6
        comparison = finished / f"results/{design}/crosscheck/comparison.json"
        compared = json.loads(comparison.read_text())
        assert compared["pass"] is True
        assert all(item["pass"] is True for item in compared["quantities"].values())
        assert len(compared["quantities"]) >= 10


def test_every_result_file_fits_its_schema(finished):
    """No key more and none less than the record has, whichever program wrote the file."""
    checked = set()
    for file in FILES:
        pattern = file.path.replace("<design>", "tiny-*").replace("NN", "[0-9][0-9]")
        for path in (finished / "results").glob(pattern):
            if path.suffix == ".csv":
                data = [to_plain(row) for row in read_rows(path, file.kind)]
            else:
                data = json.loads(path.read_text())
            schema = make_schema(file)
            jsonschema.Draft202012Validator.check_schema(schema)
            jsonschema.validate(data, schema)
            checked.add(file.name)
    assert checked >= {
        "quality", "analysis", "written", "final", "history", "classes", "mesh_convergence",
        "primary", "comparison", "summary",
    }  # fmt: skip


def test_each_iteration_reads_the_workbook_that_the_one_before_wrote(finished):
    loop = finished / "results/tiny-dome/sizing"
    folders = sorted(path.name for path in loop.iterdir() if path.is_dir())
    assert folders == [f"{number:02d}" for number in range(len(folders))]
    assert len(folders) > 2
    volumes = [
        json.loads((loop / name / "analysis.json").read_text())["volume_m3"] for name in folders
    ]
    assert len(set(volumes)) > 2


def test_a_second_start_has_nothing_to_do(code, copied):
    done = run(code, copied, TARGET)
    assert done.returncode == 0
    assert "Nothing to be done" in done.stdout + done.stderr


def test_progress_beside_a_finished_study_counts_what_is_done(code, copied):
    """No analysis is due, so that Snakemake does not count its jobs anew on the way."""
    (copied / TARGET).unlink()
    done = run(code, copied, TARGET)
    assert done.returncode == 0
    (steps,) = re.findall(r"(\d+) of (\d+) steps", done.stderr)
    assert steps[0] == steps[1] and int(steps[1]) > 20


def test_the_same_study_from_scratch_gives_the_same_bytes(code, finished, tmp_path):
    folder = make_study(tmp_path / "again")
    assert run(code, folder, TARGET).returncode == 0
    for pattern in ("results/summary.*", "results/*/sizing/*/*.xlsx", "results/*/sizing/*/*.npz"):
        assert hashes(folder, pattern) == hashes(finished, pattern)
    assert hashes(folder, "results/*/design.xlsx") == hashes(finished, "results/*/design.xlsx")


def test_a_hand_edit_redoes_what_follows_and_only_that(code, copied):
    loop = copied / "results/tiny-dome/sizing"
    before = times(copied, "results/**/*.*")
    edit(loop / "01/thickness.xlsx", 3, 0.123)
    assert run(code, copied, TARGET).returncode == 0
    after = times(copied, "results/**/*.*")
    changed = {name for name in after if before.get(name) != after[name]}
    assert not any("tiny-saddle" in name for name in changed)
    assert not any("tiny-dome/sizing/00" in name for name in changed)
    assert not any(
        name.startswith(("results/tiny-dome/folded", "results/tiny-dome/shell")) for name in changed
    )
    assert "results/tiny-dome/sizing/01/analysis.json" in changed
    assert "results/tiny-dome/sizing/02/thickness.xlsx" in changed
    assert TARGET in changed
    book = openpyxl.load_workbook(loop / "01/thickness.xlsx")
    assert book["thickness"].cell(6, 4).value == 0.123
    assert len(list((loop / "01").glob("edited-*.xlsx"))) == 1
    history = (loop / "history.csv").read_text().splitlines()
    assert ",edited," in history[2] and ",edited," not in history[1]


def test_an_edit_of_the_last_workbook_lets_the_loop_go_on(code, copied):
    """All 4 analyses are used up; a panel changed in the last workbook gives the design 4 more.

    That a person changed a panel stands in history and summary.
    """
    loop = copied / "results/tiny-dome/sizing"
    before = last_iteration(copied, "tiny-dome")
    assert (before["verdict"], before["iteration"]) == ("not_converged", 3)
    edit(loop / "03/thickness.xlsx", 3, 0.123)
    assert run(code, copied, TARGET).returncode == 0
    last = last_iteration(copied, "tiny-dome")
    assert last["counted_from"] == 3 < last["iteration"] <= 6
    assert last["verdict"] != "continue"
    with (loop / "history.csv").open(newline="") as stream:
        edited = [row["edited_panels"] for row in csv.DictReader(stream)]
    assert edited == [*[""] * 3, "1", *[""] * (last["iteration"] - 3)]
    with (copied / TARGET).open(newline="") as stream:
        rows = {row["design"]: row["edited_panels"] for row in csv.DictReader(stream)}
    assert rows == {"tiny-dome": "1", "tiny-saddle": ""}


def test_a_deleted_analysis_is_made_anew_and_all_ends_as_before(code, copied, finished):
    (copied / "results/tiny-dome/sizing/01/analysis.json").unlink()
    done = run(code, copied, TARGET)
    assert done.returncode == 0 and "tiny-dome: analysis 01" in done.stderr
    assert results(copied) == results(finished)


@pytest.mark.parametrize("iteration", ["01", "last"])
def test_an_analysis_that_cannot_be_read_is_not_taken_for_the_end(code, copied, iteration):
    """The design fails with a sentence that names the file; the other one and its results stay."""
    count = last_iteration(copied, "tiny-dome")["iteration"]
    number = f"{count:02d}" if iteration == "last" else iteration
    broken = copied / f"results/tiny-dome/sizing/{number}/analysis.json"
    final = hashes(copied, "results/tiny-dome/sizing/final.*")
    broken.write_text(broken.read_text()[:40])
    done = run(code, copied, TARGET)
    assert done.returncode == 1
    assert f"sizing/{number}/analysis.json: cannot be read as JSON" in done.stderr
    left = hashes(copied, "results/tiny-dome/sizing/final.*")
    assert all(left[name] == digest for name, digest in final.items() if name in left)


def test_iterations_left_over_from_before_an_edit_are_removed(code, copied):
    loop = copied / "results/tiny-dome/sizing"
    count = last_iteration(copied, "tiny-dome")["iteration"] + 1
    stale = loop / f"{count:02d}"
    shutil.copytree(loop / f"{count - 1:02d}", stale)
    edit(loop / "01/thickness.xlsx", 3, 0.123)
    assert run(code, copied, TARGET).returncode == 0
    count = last_iteration(copied, "tiny-dome")["iteration"] + 1
    assert sorted(path.name for path in loop.glob("[0-9][0-9]")) == [
        f"{number:02d}" for number in range(count)
    ]


@pytest.mark.parametrize("text", ["0,125", -0.1])
def test_a_bad_edit_is_refused_with_its_cell_and_stops_no_other_design(code, copied, text):
    workbook = copied / "results/tiny-dome/sizing/01/thickness.xlsx"
    edit(workbook, 3, text)
    edit(copied / "results/tiny-saddle/sizing/01/thickness.xlsx", 3, 0.09)
    kept = workbook.read_bytes()
    done = run(code, copied, TARGET)
    output = done.stdout + done.stderr
    assert done.returncode != 0
    assert "thickness.xlsx: sheet thickness: cell D6" in output
    assert workbook.read_bytes() == kept
    saddle = json.loads((copied / "results/tiny-saddle/sizing/final.json").read_text())
    assert saddle["volume_m3"] > 0
    assert "results/tiny-saddle/sizing/01/analysis.json" in times(copied, "results/**/*.json")


@pytest.mark.parametrize("victim", ["00/analysis.npz", "02/thickness.xlsx"])
def test_a_killed_loop_resumes_to_identical_results(code, finished, tmp_path, victim):
    folder, target = make_study(tmp_path / "killed"), "results/tiny-dome/sizing/final.json"
    run_and_kill(code, folder, folder / "results/tiny-dome/sizing" / victim, target)
    assert not (folder / target).exists()
    assert run(code, folder, "--unlock").returncode == 0
    done = run(code, folder, target)
    assert done.returncode == 0, done.stderr[-3000:]
    for pattern in (
        "results/tiny-dome/sizing/*.xlsx",
        "results/tiny-dome/sizing/*/*.[xn][lp][sz]*",
    ):
        found = hashes(folder, pattern)
        assert found and found == hashes(finished, pattern)


def test_a_loop_that_now_ends_sooner_runs_no_analysis_too_many(code, copied, tmp_path):
    """All former iterations are in the plan at the start; those past the new end must leave it."""
    fresh, jobs = make_study(tmp_path / "fresh"), {}
    for folder in (copied, fresh):
        change_setting(folder, "sizing", "iterations_max", 2)
        done = run(code, folder, TARGET)
        assert done.returncode == 0, done.stderr[-3000:]
        jobs[folder] = set(re.findall(r"tiny-\w+: (?:analysis|thickness) \d\d", done.stderr))
    assert jobs[copied] <= jobs[fresh] and len(jobs[copied]) > 4
    assert results(copied) == results(fresh)


def test_jobs_that_start_python_anew_give_the_same_results(code, finished, tmp_path):
    """`jobs.fork` is no setting of the study: not even the hash of the settings changes."""
    folder = make_study(tmp_path / "anew", settings={"jobs": {"fork": False}})
    done = run(code, folder, TARGET)
    assert done.returncode == 0, done.stderr[-3000:]
    assert results(folder) == results(finished)


def test_an_edit_of_a_library_file_two_imports_deep_reruns_what_needs_it(code, copied):
    """analyse imports shell.analysis, which imports shell.stiffness, which imports element."""
    element = code / "scripts/foldshell/shell/element.py"
    before = element.read_text(), element.stat()
    element.write_text(before[0] + "\n# a change\n")
    try:
        listing = run(code, copied, "-n", TARGET)
    finally:
        element.write_text(before[0])
        os.utime(element, ns=(before[1].st_atime_ns, before[1].st_mtime_ns))
    assert listing.returncode == 0, listing.stderr[-2000:]
    table = listing.stdout + listing.stderr
    rules = {
        line.split()[0] for line in table.splitlines() if re.fullmatch(r"\w+ +\d+", line.strip())
    }
    assert {
        "analyse",
        "resize",
        "size",
        "mesh_convergence",
    } <= rules  # resize reads what analyse makes anew
    assert not {"pattern", "fold", "mesh", "start"} & rules


SOFT = {
    "material": {"youngs_modulus_gpa": 0.001},
    "sizing": {**SETTINGS["sizing"], "iterations_max": 1, "largest_thickness_mm": 85},
}
THIN = {"sizing": {f"{name}_thickness_mm": 1e-6 for name in ("start", "least", "largest")}}


@pytest.mark.parametrize(
    ("settings", "reason", "crosscheck"),
    [
        (SOFT, "is below 1", {"pass", "fail"}),
        pytest.param(THIN, "not positive definite", {"not possible"}, marks=pytest.mark.slow),
    ],
)
def test_designs_that_fail_are_results_and_stop_nothing(
    code, tmp_path, settings, reason, crosscheck
):
    """A material of a thousandth of the stiffness buckles at every thickness that is allowed; a
    shell of 1 nm has no stiffness beyond round-off."""
    folder = make_study(tmp_path / "failing", settings=settings)
    done = run(code, folder, TARGET)
    assert done.returncode == 0, done.stderr[-3000:]
    with (folder / TARGET).open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [row["state"] for row in rows] == ["unstable", "unstable"]
    assert all(row["reason"] for row in rows) and reason in rows[1]["reason"]
    assert {row["crosscheck"] for row in rows} <= crosscheck


BAD_SETTINGS = [
    ({"sizing": {"stepp": 0.1}}, ["sizing", "stepp", "step"]),
    ({"sizing": {"step": "ten"}}, ["sizing.step", "ten"]),
    ({"material": {"poissons_ratio": 0.7}}, ["poissons_ratio", "0.7"]),
]


@pytest.mark.parametrize(("settings", "words"), BAD_SETTINGS)
def test_a_bad_setting_is_one_sentence_before_any_job(code, tmp_path, settings, words):
    folder = make_study(tmp_path / "bad", settings=settings)
    done = run(code, folder, TARGET)
    output = done.stdout + done.stderr
    assert done.returncode != 0
    assert not (folder / "results").exists()
    assert "Traceback" not in output
    sentence = [line for line in output.splitlines() if line.startswith("error: ")]
    assert len(sentence) == 1
    assert all(word in sentence[0] for word in words)


BAD_DESIGNS = [
    ("../evil\tparaboloid\t8\t2\t5\t6\tall\ttiny\n", ["../evil"]),
    (DESIGNS + "tiny-dome\thypar\t8\t2\t5\t6\tall\ttiny\n", ["tiny-dome"]),
    ("a\tparabolid\t8\t2\t5\t6\tall\ttiny\n", ["parabolid", "paraboloid"]),
    ("a\tarch\t8\t2\t5\t6\tedges\ttiny\n", ["edges", "strip"]),
    ("a\tarch\t-8\t2\t5\t6\tall\ttiny\n", ["span_m", "-8"]),
]


@pytest.mark.parametrize(("designs", "words"), BAD_DESIGNS)
def test_a_bad_design_is_one_sentence_before_any_job(code, tmp_path, designs, words):
    folder = make_study(tmp_path / "bad", designs)
    done = run(code, folder, TARGET)
    output = done.stdout + done.stderr
    assert done.returncode != 0
    assert not (folder / "results").exists()
    sentence = [line for line in output.splitlines() if line.startswith("error: ")]
    assert len(sentence) == 1 and "designs.tsv" in sentence[0]
    assert all(word in sentence[0] for word in words)
