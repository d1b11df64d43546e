"""What explorations come to: front, table, smooth shell, sentences."""

import pytest

from foldshell.explore.answer import read_searched, write_answer
from foldshell.figures.answer_chart import draw_answer
from foldshell.files.errors import InputError

ROWS = (
    ("00-00", "miura", 100.0, 5.0, 210, False), ("00-01", "smooth", 60.0, 4.0, 210, False),
    ("01-00", "miura", 50.0, 6.0, 120, True), ("01-01", "miura", 55.0, 9.0, 130, True),
    ("01-02", "miura", 56.0, 8.0, 140, True), ("01-03", "miura", 40.0, 2.0, 150, False),
)  # fmt: skip


@pytest.fixture
def searched(tmp_path):
    home = tmp_path / "roof"
    home.mkdir()
    header = "candidate\tpattern\tvolume_m3\tbuckling_factor_min\tpanels\tfeasible"
    lines = ["\t".join(map(str, row)) for row in ROWS] + ["01-04\tmiura\t\t\t\tFalse"]
    (home / "explore.tsv").write_text("\n".join([header, *lines]) + "\n")
    (home / "confirmed.csv").write_text("design,volume_m3\nroof-01-00,51.5\n")
    return read_searched(home / "explore.tsv")


def test_front_and_lightest(searched):
    assert [point.name for point in searched.front] == ["01-00", "01-01"]
    assert searched.lightest(7.0).name == "01-01" and searched.lightest(10.0) is None
    assert searched.confirmed == {"01-00": 51.5}


def test_the_answer_says_what_is_bought_and_at_what_factor(searched):
    """50 of 100 m3 of the table; 17 % below 60 m3 of the smooth shell, at 1.5 times its factor."""
    text = write_answer([searched], "a.png")
    assert (
        "| roof | 100.0 (5.0) | 60.0 (4.0) | 50.0 (6.0, 120) | 51.5 | -50 % | 50.0 (6.0) |" in text
    )
    assert "50 % less concrete than the lightest of the table; 17 % less than the smooth" in text
    assert "at 1.5 times its buckling factor" in text


def test_the_chart_is_drawn(searched, tmp_path):
    draw_answer(tmp_path / "a.png", [searched, searched])
    assert (tmp_path / "a.png").read_bytes()[:4] == b"\x89PNG"


def test_another_table_is_refused(tmp_path):
    (tmp_path / "explore.tsv").write_text("a\tb\n1\t2\n")
    with pytest.raises(InputError, match="is not the table of an exploration"):
        read_searched(tmp_path / "explore.tsv")
