"""Verify: every kind of fault is found by content, whatever the dates; nothing else is."""

import json
import os
import shutil

import pytest

import verify
from foldshell.engine.integrity import find_dependents, read_home
from foldshell.files.manifest import read_manifest
from foldshell.files.whole import hash_data
from results_case import VERSIONS, make_results, record
from workbook_cases import edit_with_openpyxl

DATE = 1_700_000_000


@pytest.fixture
def results(tmp_path):
    """Two designs of one study."""
    return make_results(tmp_path / "results")


def lines(results):
    said, code = verify.main(results)
    return [line.removeprefix(f"{results}/") for line in said], code


def swap(one, other):
    first = one.read_bytes()
    one.write_bytes(other.read_bytes())
    other.write_bytes(first)


def flip_bit(path):
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes(data)


def change_digit(path):
    text = path.read_text()
    path.write_text(text.replace("2", "3", 1))


def replace_by_link(path):
    shutil.copy(path, path.with_name("elsewhere"))
    path.unlink()
    path.symlink_to("elsewhere")


def replace_by_folder(path):
    path.unlink()
    path.mkdir()


def forge_manifest(path):
    """Change a manifest and its own hash: the study's manifest still tells."""
    data = json.loads(path.read_text())
    data.pop("content_sha256")
    data["made_by"]["commit"] = "def"
    path.write_text(json.dumps({**data, "content_sha256": hash_data(data)}))


def other_version(path):
    data = json.loads(path.read_text())
    path.write_text(json.dumps(data | {"format": "foldshell-manifest 99"}))


ANALYSIS, BOOK = "a/sizing/00/analysis.json", "a/sizing/00/thickness.xlsx"
ARRAYS, MANIFEST, RECORD = "a/sizing/01/analysis.npz", "a/manifest.json", "a/jobs/size.json"
FAULTS = {
    "cut": (lambda r: os.truncate(r / ANALYSIS, 5), ANALYSIS, "damaged"),
    "emptied": (lambda r: os.truncate(r / "a/page.html", 0), "a/page.html", "damaged: empty"),
    "bit flip": (lambda r: flip_bit(r / ARRAYS), ARRAYS, "damaged"),
    "changed digit": (lambda r: change_digit(r / "a/history.json"), "a/history.json", "damaged"),
    "swapped between designs": (
        lambda r: swap(r / "a/history.json", r / "b/history.json"), "b/history.json", "damaged"),
    "swapped between iterations": (
        lambda r: swap(r / ANALYSIS, r / "a/sizing/01/analysis.json"), ANALYSIS, "damaged"),
    "workbooks swapped between iterations": (
        lambda r: swap(r / BOOK, r / "a/sizing/01/thickness.xlsx"), BOOK,
        "damaged: it is that of a, iteration 1"),
    "workbooks swapped between designs": (
        lambda r: swap(r / BOOK, r / "b/sizing/00/thickness.xlsx"), BOOK,
        "damaged: it is that of b, iteration 0"),
    "removed": (lambda r: (r / ANALYSIS).unlink(), ANALYSIS, "missing: made by job analyse-00"),
    "left over": (
        lambda r: shutil.copytree((r / ARRAYS).parent, r / "a/sizing/02"),
        "a/sizing/02", "left over"),
    "folder for a file": (lambda r: replace_by_folder(r / ANALYSIS), ANALYSIS, "damaged"),
    "link for a file": (lambda r: replace_by_link(r / ANALYSIS), ANALYSIS, "damaged: a link"),
    "record removed": (lambda r: (r / RECORD).unlink(), RECORD, "missing"),
    "record changed": (lambda r: change_digit(r / RECORD), RECORD, "damaged"),
    "manifest removed": (lambda r: (r / MANIFEST).unlink(), MANIFEST, "missing"),
    "manifest edited": (lambda r: change_digit(r / MANIFEST), MANIFEST, "damaged"),
    "manifest forged": (lambda r: forge_manifest(r / MANIFEST), MANIFEST, "damaged"),
    "manifest of another version": (
        lambda r: other_version(r / MANIFEST), MANIFEST, "made by another version"),
    "workbook cut": (lambda r: os.truncate(r / BOOK, 900), BOOK, "damaged"),
    "workbook emptied": (lambda r: os.truncate(r / BOOK, 0), BOOK, "damaged: empty"),
}  # fmt: skip


@pytest.mark.parametrize("dated_back", [True, False])
@pytest.mark.parametrize("kind", FAULTS)
def test_every_kind_of_fault_is_found_whatever_the_dates(results, kind, dated_back):
    spoil, path, words = FAULTS[kind]
    spoil(results)
    if dated_back:
        for file in results.rglob("*"):
            os.utime(file, (DATE, DATE), follow_symlinks=False)
    said, code = lines(results)
    assert code == 1
    assert any(line.startswith(f"{path}: {words}") for line in said), said


@pytest.mark.skipif(os.geteuid() == 0, reason="everything can be read by the superuser")
def test_a_file_that_cannot_be_read_is_found(results):
    (results / ANALYSIS).chmod(0)
    assert lines(results)[0][0].startswith(f"{ANALYSIS}: damaged: cannot be read")


def untouched(results, tmp_path):
    return results


def copied(results, tmp_path):
    return shutil.copytree(results, tmp_path / "copy", copy_function=shutil.copyfile)


def moved(results, tmp_path):
    return results.rename(tmp_path / "moved")


def touched(results, tmp_path):
    for file in results.rglob("*"):
        os.utime(file)
    return results


def dated_back(results, tmp_path):
    for file in results.rglob("*"):
        os.utime(file, (DATE, DATE))
    return results


@pytest.mark.parametrize("handle", [untouched, copied, moved, touched, dated_back])
def test_good_results_raise_no_alarm(results, tmp_path, handle):
    assert verify.main(handle(results, tmp_path)) == (["every file is as it was made"], 0)


def set_thickness(book):
    book["thickness"]["D5"] = 0.25


def test_a_workbook_with_other_thicknesses_is_edited_and_never_removed(results):
    edit_with_openpyxl(results / BOOK, set_thickness)
    kept = (results / BOOK).read_bytes()
    said, code = verify.main(results, mend=True)
    assert said == [f"{results / BOOK}: edited by hand: the next run redoes what follows it"]
    assert code == 1 and (results / BOOK).read_bytes() == kept


def test_an_edit_that_the_analysis_has_read_is_said_and_is_no_fault(results):
    home = results / "a"
    edit_with_openpyxl(results / BOOK, set_thickness)
    made = ["sizing/00/analysis.json", "sizing/00/analysis.npz"]
    record(home, "analyse-00", "analyse", made, ["sizing/00/thickness.xlsx"])
    (home / "manifest.json").unlink()
    shutil.rmtree(results / "studies")
    said, code = lines(results)
    assert said == [f"{BOOK}: edited by hand: as the analysis after it has read it"] and code == 0


def test_a_workbook_saved_again_with_its_thicknesses_is_no_edit(results):
    edit_with_openpyxl(results / BOOK, lambda book: None)
    assert lines(results)[0][0].startswith(f"{BOOK}: damaged: saved again by another program")


def test_repair_takes_away_what_the_job_made_and_what_was_made_of_it(results):
    os.truncate(results / "a/sizing/01/analysis.npz", 30)
    said, _ = verify.main(results, mend=True)
    assert "taken away" in said[-1]
    left = {str(p.relative_to(results / "a")) for p in (results / "a").rglob("*.*") if p.is_file()}
    gone = {"history.json", "page.html", "sizing/01/analysis.json", "sizing/01/analysis.npz"}
    assert (
        not left & gone and "sizing/01/thickness.xlsx" in left and "sizing/00/analysis.json" in left
    )
    assert not {"jobs/analyse-01.json", "jobs/size.json", "manifest.json"} & left
    (copy,) = (results / "a/replaced").iterdir()
    assert copy.name.startswith("sizing-01-analysis.npz-") and copy.stat().st_size == 30
    assert (results / "b/history.json").exists()


def test_repair_removes_a_link_and_not_what_it_leads_to(results, tmp_path):
    target = tmp_path / "mine.json"
    target.write_text("mine")
    (results / ANALYSIS).unlink()
    (results / ANALYSIS).symlink_to(target)
    verify.main(results, mend=True)
    assert target.read_text() == "mine" and not os.path.lexists(results / ANALYSIS)


def test_results_of_a_run_that_has_not_ended_are_checked_by_the_records_alone(results):
    (results / "a/manifest.json").unlink()
    shutil.rmtree(results / "studies")
    assert lines(results) == (["every file is as it was made"], 0)
    flip_bit(results / "a/page.html")
    assert lines(results)[0][0].startswith("a/page.html: damaged")


def test_dependents_follow_inputs_and_name_each_job_once(results):
    home = read_home(results / "a")
    assert find_dependents(home, ["sizing/00/thickness.xlsx"]) == [
        "analyse-00", "analyse-01", "page", "resize-00", "resize-01", "size",
    ]  # fmt: skip
    assert find_dependents(home, ["page.html"]) == ["page"] and find_dependents(home, []) == []


def test_a_manifest_names_what_decided_and_who_made_it(results):
    manifest = read_manifest(results / "a/manifest.json")
    assert manifest.made_by == VERSIONS and manifest.result_sha256 == "r"
    assert manifest.job_of["page.html"] == "page"
    assert manifest.files["page.html"].bytes == len("<p>a</p>")


def test_a_folder_without_records_is_said(tmp_path):
    said, code = verify.main(tmp_path)
    assert code == 1 and "nothing was made here" in said[0]
