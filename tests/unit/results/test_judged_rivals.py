"""Rows of judged rivals: numbers of the summary and of engineering.json, kinds by their names."""

import pytest

from foldshell.records.files import write_record
from foldshell.records.summary import SummaryRow
from foldshell.records.table import write_rows
from foldshell.results.rivals import read_judged
from record_cases import make_check, make_engineering, make_steel, make_summary

CHECKS = {
    "stability": make_check(5.0, 6.0, False, at_least=True),
    "displacement_long_term_cracked": make_check(0.12, 0.117, False),
    "reinforced_strut": make_check(0.4, 1.0, True),
}


@pytest.fixture
def rows(tmp_path):
    """Four shells of a roof whose name has numbers too; the first alone was judged."""
    names = {"zz-00-28-01-00": "miura", "zz-00-28-11-100": "miura", "zz-00-28-00-100": "miura",
             "zz-00-28-00-01": "smooth"}  # fmt: skip
    table = tmp_path / "summary.csv"
    write_rows(table, SummaryRow, [make_summary(design=name, pattern=pattern, volume_m3=50.0)
                                   for name, pattern in names.items()])  # fmt: skip
    record = make_engineering(CHECKS, reinforcement=make_steel(), verdict="fails")
    (tmp_path / "zz-00-28-01-00/checks").mkdir(parents=True)
    write_record(tmp_path / "zz-00-28-01-00/checks/engineering.json", record)
    return read_judged(table, tmp_path)


def test_kinds_are_told_from_the_name_of_the_candidate(rows):
    """Round and number stand last, the number with three digits from 100 on."""
    assert [row.kind for row in rows] == ["found", "found", "table", "smooth"]


def test_a_row_has_what_the_verdict_says(rows):
    first, second = rows[:2]
    assert first.failed == "stability, displacement_long_term_cracked"
    assert (first.stability, first.stability_due) == (5.0, 6.0)
    assert (first.displacement_long_term_m, first.displacement_due_m) == (0.12, 0.117)
    assert (first.strut, first.steel_kg, first.co2_low_kg) == (0.4, 17050.0, 28600.0)
    assert first.shear_share == 0.0 and first.volume_m3 == 50.0
    assert second.volume_m3 == 50.0 and second.steel_kg is None and second.failed is None
