"""An edited workbook is noticed by its bytes and survives, whatever replaces it."""

import pytest

from foldshell.files.edits import RECORD, is_edited, keep_all_edited, keep_edited, record_written
from workbook_cases import edit_with_openpyxl, write_case


@pytest.fixture
def path(tmp_path):
    path = write_case(tmp_path / "a/sizing/03/thickness.xlsx")
    record_written(path, path.parent / RECORD)
    return path


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
    other = write_case(tmp_path / "b/sizing/00/thickness.xlsx")
    record_written(other, other.parent / RECORD)
    edit_with_openpyxl(path, set_thickness)
    assert keep_all_edited(tmp_path) == [path]


@pytest.mark.parametrize("record", [None, "", "{}", "[]", "not json"])
def test_without_a_record_nothing_is_claimed(path, record):
    (path.parent / RECORD).unlink()
    if record is not None:
        (path.parent / RECORD).write_text(record)
    assert not is_edited(path) and not keep_edited(path)


def test_missing_workbook(path):
    path.unlink()
    assert not is_edited(path)
