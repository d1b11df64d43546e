"""Entry script verify: faults that Snakemake does not notice, against records as it writes them."""

import base64
import json
import os
from itertools import pairwise

import numpy as np
import pytest

import verify
from foldshell.engine.integrity import find_dependents, keep_current, read_records
from foldshell.files.edits import record_written
from foldshell.files.whole import hash_file, write_arrays, write_json

HOME = "results/a/sizing"
ENDED = 1_700_000_000.0


def _record(root, path, rule, *inputs):
    """Write a record as Snakemake 9 does: long names are split into folders that begin with @."""
    sums = {name: f"sha256:{hash_file(root / name)}" for name in inputs}
    data = {
        "rule": rule,
        "endtime": ENDED,
        "input": list(inputs),
        "input_checksums": sums,
    }
    name = base64.urlsafe_b64encode(path.encode()).decode()
    folder = root / ".snakemake/metadata"
    if len(name) > 60:
        folder, name = folder / f"@{name[:60]}", name[60:]
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(json.dumps(data))
    os.utime(root / path, (ENDED, ENDED))


@pytest.fixture
def study(tmp_path):
    """A loop of two iterations: workbook, analysis, workbook, analysis, history; and a left-over
    record of a third iteration that is gone."""
    names = [f"{HOME}/{n:02d}/{kind}" for n in (0, 1, 2) for kind in ("thickness.xlsx", "a.json")]
    for number, name in enumerate(names):
        write_json(tmp_path / name, {"number": number})
    book = tmp_path / names[0]
    write_arrays(book.with_suffix(".npz"), {"x": np.ones(3)})
    book.with_suffix(".npz").replace(book)  # a zip archive, as a workbook is
    for name in (names[2], names[4]):
        (tmp_path / name).write_bytes(book.read_bytes())
    _record(tmp_path, names[0], "start")
    for before, after in pairwise(names):
        _record(tmp_path, after, "resize" if after.endswith("xlsx") else "analyse", before)
    write_json(tmp_path / f"{HOME}/history.json", {"rows": 2})
    _record(tmp_path, f"{HOME}/history.json", "size", names[1], names[3])
    for name in names[4:]:
        (tmp_path / name).unlink()
    return tmp_path


def test_untouched_results_have_no_fault(study):
    assert len(read_records(study / ".snakemake/metadata")) == 7
    assert verify.main(study) == []


def test_deleted_intermediate_is_found(study):
    """Snakemake says 'nothing to be done' while what was made of it stands."""
    (study / f"{HOME}/00/a.json").unlink()
    lines = verify.main(study)
    assert lines[0] == f"{HOME}/00/a.json: deleted: made by rule analyse"
    assert "--repair" in lines[-1]


def test_changed_file_is_found_by_its_hash_even_with_its_old_time(study):
    path = study / f"{HOME}/00/a.json"
    path.write_text(path.read_text().replace("1", "2"))
    os.utime(path, (ENDED, ENDED))
    line, _ = verify.main(study)
    assert line.startswith(f"{HOME}/00/a.json: changed: since rule")


def test_last_file_of_the_chain_is_found_by_its_time_or_its_end(study):
    path = study / f"{HOME}/history.json"
    os.utime(path, (ENDED + 60, ENDED + 60))
    assert f"{HOME}/history.json: changed: 60 s after its rule size ended" in verify.main(study)
    path.write_text(path.read_text()[:-5])
    os.utime(path, (ENDED, ENDED))
    assert f"{HOME}/history.json: damaged: cannot be read as .json" in verify.main(study)


@pytest.mark.parametrize("size", [0, 40])
def test_cut_off_workbook_is_found(study, size):
    os.truncate(study / f"{HOME}/01/thickness.xlsx", size)
    assert verify.main(study)[0].startswith(f"{HOME}/01/thickness.xlsx: damaged")


def test_edited_workbook_is_named_but_never_removed(study):
    book = study / f"{HOME}/01/thickness.xlsx"
    record_written(book, book.with_name("written.json"))
    write_arrays(study / "edited.npz", {"x": np.zeros(4)})
    book.write_bytes((study / "edited.npz").read_bytes())
    lines = verify.main(study, repair=True)
    assert lines == [f"{HOME}/01/thickness.xlsx: edited: the next run redoes what follows it"]
    assert book.exists()


def test_repair_removes_what_was_made_from_a_fault_and_nothing_else(study):
    (study / f"{HOME}/01/thickness.xlsx").unlink()
    verify.main(study, repair=True)
    left = sorted(str(p.relative_to(study / HOME)) for p in (study / HOME).rglob("*.*"))
    assert left == ["00/a.json", "00/thickness.xlsx"]


def test_repair_takes_no_other_file_for_an_edited_workbook(study):
    """The record beside a workbook holds the hash of the workbook alone."""
    book = study / f"{HOME}/01/thickness.xlsx"
    record_written(book, book.with_name("written.json"))
    (study / f"{HOME}/00/a.json").unlink()
    verify.main(study, repair=True)
    assert not list(study.rglob("edited-*"))


def test_left_over_iterations_do_not_count(study):
    records = read_records(study / ".snakemake/metadata")
    paths = {record.path for record in keep_current(records, "results")}
    assert f"{HOME}/02/a.json" not in paths and f"{HOME}/01/a.json" in paths
    assert find_dependents([], records) == []


def test_folder_without_records_is_said(tmp_path):
    assert "no records" in verify.main(tmp_path)[0]
