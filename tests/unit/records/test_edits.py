"""An edited workbook is noticed by its bytes and survives, whatever replaces it."""

import os

import numpy as np
import pytest

from foldshell.files.whole import hash_file, write_json
from foldshell.records.edits import (
    RECORD,
    find_edited_panels,
    hash_edit,
    is_edited,
    keep_all_edited,
    keep_edited,
    recorded_workbook,
)
from workbook_cases import THICKNESS, edit_with_openpyxl, write_case


def write_recorded(path):
    with recorded_workbook(path, path.parent / RECORD, THICKNESS) as temporary:
        write_case(temporary)
    return path


@pytest.fixture
def path(tmp_path):
    return write_recorded(tmp_path / "a/sizing/03/thickness.xlsx")


def set_thickness(book):
    book["thickness"]["D5"] = 0.2


def copies(path):
    return sorted(path.parent.glob("edited-*.xlsx"))


def test_untouched_workbook_is_left_alone(path):
    assert not is_edited(path) and not keep_edited(path) and copies(path) == []


def test_written_again_with_the_same_values_is_no_edit(path):
    """The bytes depend on the values alone, so that a rerun is not taken for a person."""
    write_case(path)
    assert not is_edited(path)


def test_edit_is_copied_once_and_outlives_its_file(path):
    edit_with_openpyxl(path, set_thickness)
    edited = path.read_bytes()
    assert keep_edited(path) and keep_edited(path)
    path.unlink()
    (copy,) = copies(path)
    assert copy.read_bytes() == edited


def test_each_of_several_edits_is_kept(path):
    for value in (0.2, 0.3):
        edit_with_openpyxl(path, lambda book, v=value: book["thickness"].__setitem__("D5", v))
        assert keep_edited(path)
    assert len(copies(path)) == 2


def test_all_designs_are_searched(path, tmp_path):
    write_recorded(tmp_path / "b/sizing/00/thickness.xlsx")
    edit_with_openpyxl(path, set_thickness)
    assert keep_all_edited(tmp_path) == [path]


@pytest.mark.parametrize("record", [None, "", "{}", "[]", "not json"])
def test_without_a_record_nothing_is_claimed(path, record):
    (path.parent / RECORD).unlink()
    if record is not None:
        (path.parent / RECORD).write_text(record)
    assert not is_edited(path) and not keep_edited(path)


def test_edited_panels_are_those_whose_thickness_differs(path):
    """D5 is the cell of panel 2; a workbook that was only saved anew is edited in no panel."""
    assert find_edited_panels(path, THICKNESS) is None
    edit_with_openpyxl(path, lambda book: None)
    assert find_edited_panels(path, THICKNESS) == ()
    changed = THICKNESS.copy()
    changed[[2, 7]] += 1e-12
    assert find_edited_panels(path, changed) == (2, 7)


def test_without_the_written_thickness_all_panels_count(path):
    write_json(path.parent / RECORD, {"sha256": "0"})
    assert find_edited_panels(path, THICKNESS) == tuple(range(12))


def test_missing_workbook(path):
    path.unlink()
    assert not is_edited(path)


def analysed(path):
    write_json(path.with_name("analysis.json"), {"workbook_sha256": hash_file(path)})
    return path.with_name("analysis.json").stat().st_mtime_ns


def test_an_edit_dated_back_is_made_newer_than_the_analysis_that_did_not_read_it(path, tmp_path):
    """Snakemake looks at inputs that are newer than outputs only; content decides here."""
    then = analysed(path)
    edit_with_openpyxl(path, set_thickness)
    os.utime(path, ns=(then - 10**14, then - 10**14))
    assert keep_all_edited(tmp_path) == [path]
    assert path.stat().st_mtime_ns > then


def test_a_workbook_put_back_is_made_newer_than_the_analysis_of_the_edit(path, tmp_path):
    """It is no edit any more, but the analysis read another one."""
    original = path.read_bytes()
    edit_with_openpyxl(path, set_thickness)
    then = analysed(path)
    path.write_bytes(original)
    os.utime(path, ns=(then - 10**14, then - 10**14))
    assert keep_all_edited(tmp_path) == []
    assert path.stat().st_mtime_ns > then


def test_a_workbook_that_was_read_keeps_its_date(path, tmp_path):
    analysed(path)
    os.utime(path, ns=(10**18, 10**18))
    keep_all_edited(tmp_path)
    assert path.stat().st_mtime_ns == 10**18


def test_an_edited_value_changes_the_hash_of_decisions_and_a_saved_copy_does_not(path):
    """Another file with the same values decides nothing else; one last bit does."""
    assert hash_edit("base", path, THICKNESS) == "base"
    edit_with_openpyxl(path, lambda book: None)
    assert is_edited(path) and hash_edit("base", path, THICKNESS.copy()) == "base"
    one = hash_edit("base", path, np.nextafter(THICKNESS, 1))
    assert len(one) == 12 and one != hash_edit("other", path, np.nextafter(THICKNESS, 1))
    (path.parent / RECORD).unlink()
    assert hash_edit("base", path, THICKNESS) == "base"
