"""What explorations come to: fronts, tables, sentences that follow from numbers."""

from dataclasses import replace

import pytest
from answer_case import make_judged, write_roof

import fold_answer
from foldshell.explore.answer import Searched, find_front, list_found, read_searched
from foldshell.explore.answer_page import write_answer
from foldshell.explore.answer_words import compare_covered, count_less, list_factors_won
from foldshell.files.errors import InputError
from foldshell.records.summary import SummaryRow
from foldshell.records.table import write_rows

PICTURES = ("images/a.png", "images/b.png")
DESIGN = {"tags": "found", "pattern": "miura", "surface": "arch", "span_m": 28.0, "height_m": 10.0,
          "support": "strip", "fold_mode": "elastic"}  # fmt: skip


def make_row(name, **changed):
    given = {"zigzag": 9, "strip": 16, "state": "converged", "volume_m3": 51.0,
             "buckling_factor_min": 4.5, "crosscheck": "pass", "engineering": "fails"}  # fmt: skip
    return SummaryRow(design=name, **DESIGN, **(given | changed))


@pytest.fixture
def table(tmp_path):
    return write_roof(tmp_path / "roof")


def test_fronts_keep_what_none_beats_in_both(table):
    """Feasible found ones only: 40 m3 breaks a limit."""
    found = read_searched(table).of("found")
    assert [p.name for p in find_front(found, lambda one: one.factor)] == ["01-00", "01-01"]
    assert [p.name for p in find_front(found, lambda one: -one.panels)] == ["01-00", "01-02"]


def test_sentences_follow_from_the_numbers(table):
    """50 of 98 m3 of the table, of 58 of the smooth shell: -49 and -14 %; at 6 one that was
    tried has 50 of 66, at 12 none does and the best takes 80 of 70."""
    text = write_answer([read_searched(table)], PICTURES)
    assert "against the row of the table that is the base**: concrete less on 1 of 1 roof" in text
    assert (
        "lightest row of the table**: concrete less on 1 of 1 roof (arch, strip edges -50 %)"
        in text
    )
    assert "(arch, strip edges -49 %)" in text and "(arch, strip edges -14 %)" in text
    assert (
        "- arch, strip edges: the fold is lighter (-14 %) at a factor of 4; the fold is lighter "
        "(-24 %) at a factor of 6; the smooth shell is lighter (-12 %) at a factor of 12."
    ) in text
    assert (
        "**At a buckling factor of 6, on the mesh of the search, against the smooth shell**: "
        "concrete less on 1 of 1 roof (arch, strip edges -24 %); for each m² of plan that is "
        "covered arch, strip edges -20 %."
    ) in text
    assert "the best stands at the end of a range: rest fold angle at 30" in text
    assert "Nearly all panels stand at the least thickness on 1 of 1 roofs" in text
    assert "Area of the sheet over that of the smooth shell: arch, strip edges +38 %" in text
    assert "| arch, strip edges | 120: 50.0, 80: 56.0 | 210: 100.0, 90: 110.0 |" in text
    assert "0 of 1 of these searches aimed at few panels" in text
    assert "fails: room for bars, shear" in text
    assert "5 patterns tried, 3 of them sized within all limits" in text


def test_other_numbers_give_other_sentences(table):
    """A fold that takes more is said to: nothing is sold that the numbers do not show."""
    one = read_searched(table)
    heavy = [make_judged("found", 70.0, volume_per_area_m=0.07, engineering="passes"),
             *(row for row in one.judged["paper"] if row.kind != "found")]  # fmt: skip
    thick = [replace(row, volume_m3=70.0) if row.kind == "found" else row for row in one.resized]
    judged, about = one.judged | {"paper": tuple(heavy)}, one.about | {"bounds": []}
    one = replace(one, judged=judged, about=about, resized=tuple(thick))
    text = write_answer([one], PICTURES)
    assert "concrete less on 0 of 1 roof, more on 1 (arch, strip edges +21 %)" in text
    assert "No best design stands at the end of a range or at the least thickness" in text
    assert "passed by 1 of 1 found pattern, 0 of 1 row of the table that is the base" in text


def test_concrete_counts_for_each_covered_m2(table):
    """50 over .95 against 58 over 1."""
    ((_, change),) = compare_covered([read_searched(table)], "paper")
    assert change == pytest.approx(50 / 0.95 / 58 - 1)


def test_counts_of_roofs():
    assert count_less([("a", -0.2), ("b", 0.004), ("c", 0.3)]) == (
        "less on 1 of 3 roofs, alike (within 1 %) on 1, more on 1"
    )


def test_a_factor_that_is_not_kept_is_none(table):
    """A shell sized for 12 that ends at 7 counts for nothing there."""
    one = read_searched(table)
    rows = [replace(row, buckling_factor_min=7.0) if (row.kind, row.factor_due) == ("smooth", 12.0)
            else row for row in one.resized]  # fmt: skip
    (line,) = list_factors_won([replace(one, resized=tuple(rows))])
    assert "only the found pattern keeps its factor at a factor of 12" in line
    bare = replace(one, resized=tuple(row for row in rows if row.kind == "found"))
    assert list_factors_won([bare]) == []  # nothing is said of what was not sized


def test_rows_of_the_table_have_both_verdicts(table):
    """Matched by roof and counts; a row of another support is none of it."""
    known = {"zigzag": 15, "strip": 16, "volume_m3": 97.0, "steel_kg_m2": 19.0}
    rows = [make_row("a", **known), replace(make_row("b", **known), support="all", volume_m3=1.0)]
    text = write_answer([read_searched(table)], PICTURES, rows)
    assert "| 15 x 16 | 210 | 100.0 (5.0) | 97.0 (4.5) | 19.0 | pass | fails |" in text
    assert "has not been run" not in text


def test_an_edge_beam_below_the_shell_makes_another_row(table):
    """Its depth is negative: the row of the study without a beam is none of its own."""
    (table.parent / "rounds/00").mkdir(parents=True)
    (table.parent / "rounds/00/candidates.tsv").write_text(
        "design\tzigzag\tstrip\tedge_beam_depth_m\n00-00\t15\t16\t-0.5\n00-02\t8\t32\t0.0\n"
    )
    rows = [make_row("a", zigzag=15, strip=16, volume_m3=97.0)]
    text = write_answer([read_searched(table)], PICTURES, rows)
    assert "| 15 x 16, edge beam | 210 | 100.0 (5.0) | – |" in text
    beam = replace(rows[0], edge_beam_depth_m=-0.5)
    text = write_answer([read_searched(table)], PICTURES, [beam])
    assert "| 15 x 16, edge beam | 210 | 100.0 (5.0) | 97.0 (4.5) |" in text
    own = replace(beam, settings="config/reinforced.yaml")
    assert "97.0 (4.5)" not in write_answer([read_searched(table)], PICTURES, [own])


def test_confirmed_designs_are_those_that_both_codes_and_the_limit_bear_out(table):
    write_rows(table.with_name("confirmed.csv"), SummaryRow, [
        make_row("roof-01-00"), make_row("roof-01-01", crosscheck="fail"),
        make_row("roof-01-02", buckling_factor_min=3.9),
    ])  # fmt: skip
    searched = [read_searched(table)]
    assert list_found(searched) == ["roof-01-00"]
    assert "| roof-01-00 | 50.0 | 51.0 | +2.0 | 4.5 | pass | fails |" in (
        write_answer(searched, PICTURES)
    )


def test_an_exploration_alone_is_a_whole_page(table, tmp_path):
    """Without rivals nothing is compared, and the page says so."""
    bare = tmp_path / "bare/explore.tsv"
    bare.parent.mkdir()
    bare.write_text(table.read_text())
    text = write_answer([read_searched(bare)], PICTURES)
    assert "Not sized alike at the ordinary mesh here**: bare" in text
    assert (
        "Nothing has been sized alike at the ordinary mesh yet" in text
        and "By the engineering verdict" not in text
    )
    assert write_answer([Searched("empty", ())], PICTURES).startswith("# What the fold buys")


def test_the_script_writes_page_charts_and_table(table, tmp_path):
    """Twice the same bytes; found.tsv has the confirmed row of selected.tsv."""
    write_rows(table.with_name("confirmed.csv"), SummaryRow, [make_row("roof-01-00")])
    made = []
    for name in ("a", "b"):
        home = tmp_path / name
        (home / "images").mkdir(parents=True)
        pictures = [home / "images/one.png", home / "images/two.png"]
        files = [home / "page.md", home / "found.tsv", *pictures]
        fold_answer.main(*files[:2], pictures, tables=[table])
        made.append([path.read_bytes() for path in files])
    assert made[0] == made[1]
    assert made[0][1].decode().splitlines()[1].startswith("roof-01-00\t")
    assert made[0][2][:4] == b"\x89PNG" and b"](images/two.png)" in made[0][0]


def test_explorations_that_have_not_been_run_are_named(table):
    text = write_answer([read_searched(table)], PICTURES, (), ("dome", "roof"))
    assert "**Not run here**: dome; nothing is said of these roofs." in text
    assert "Not run here" not in write_answer([read_searched(table)], PICTURES, (), ("roof",))


def test_another_table_is_refused(tmp_path):
    (tmp_path / "explore.tsv").write_text("a\tb\n1\t2\n")
    with pytest.raises(InputError, match="is not the table of an exploration"):
        read_searched(tmp_path / "explore.tsv")
