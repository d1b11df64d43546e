"""Copies of a study in the folder of all results: whole, links that lead, no edit lost."""

import pytest

from foldshell.engine.copies import copy_study

PAGE = '<a href="../../dome/page.html">dome</a><a href="#top">top</a>'


@pytest.fixture
def results(tmp_path):
    """Return results with two studies; the second has no report."""
    for tag in ("first", "second"):
        folder = tmp_path / "results/studies" / tag
        folder.mkdir(parents=True)
        (folder / "summary.csv").write_text(f"design\n{tag}\n")
        (folder / "summary.xlsx").write_bytes(tag.encode())
    (tmp_path / "results/studies/first/report.html").write_text(PAGE)
    return tmp_path / "results"


def test_copies_are_those_of_the_study(results):
    made = copy_study(results / "studies/first", results)
    assert [path.name for path in made] == ["summary.csv", "summary.xlsx", "report.html"]
    assert (results / "summary.csv").read_text() == "design\nfirst\n"
    assert 'href="dome/page.html"' in (results / "report.html").read_text()
    assert 'href="#top"' in (results / "report.html").read_text()


def test_nothing_of_another_study_stays_beside_them(results):
    copy_study(results / "studies/first", results)
    copy_study(results / "studies/second", results)
    assert (results / "summary.xlsx").read_bytes() == b"second"
    assert not (results / "report.html").exists()
    assert not (results / "replaced").exists()


def test_what_a_person_changed_is_kept_aside(results):
    copy_study(results / "studies/first", results)
    (results / "summary.csv").write_text("design\nmy notes\n")
    copy_study(results / "studies/second", results)
    assert (results / "summary.csv").read_text() == "design\nsecond\n"
    (kept,) = (results / "replaced").glob("summary-*.csv")
    assert kept.read_text() == "design\nmy notes\n"


def test_a_study_of_another_table_leads_to_its_own_folder(results, tmp_path):
    folder = results / "mine/studies/mine"
    folder.mkdir(parents=True)
    (folder / "report.html").write_text(PAGE)
    copy_study(folder, results)
    assert 'href="mine/dome/page.html"' in (results / "report.html").read_text()
    assert not (results / "summary.csv").exists()
