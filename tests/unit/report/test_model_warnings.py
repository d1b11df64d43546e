"""A warning of the model stands beside the numbers: page, summary, its table, the report."""

from foldshell.records.summary import SummaryRow
from foldshell.report.sections import make_warnings
from foldshell.report.study_pages import COLUMNS
from foldshell.results.summary import _describe_state
from record_cases import USED, make_analysis

TWO = ("3 of 210 panels are thick", "the support about [0, 0, 0] m carries nothing")


def test_the_page_has_a_box_with_every_sentence():
    (section,) = make_warnings(make_analysis(**USED, model_warnings=TWO))
    assert section.box.kind == "bad" and section.box.head == "2 warnings"
    assert all(sentence in section.box.words for sentence in TWO)
    (one,) = make_warnings(make_analysis(**USED, model_warnings=TWO[:1]))
    assert one.box.head == "1 warning"


def test_nothing_stands_where_the_model_holds():
    for found in ((), None):
        assert make_warnings(make_analysis(**USED, model_warnings=found)) == []
        assert (
            _describe_state(make_analysis(**USED, model_warnings=found))["model_warnings"] is None
        )


def test_the_summary_has_them_in_one_cell_and_its_page_a_column():
    row = _describe_state(make_analysis(**USED, model_warnings=TWO))
    assert row["model_warnings"] == "; ".join(TWO)
    assert "model_warnings" in SummaryRow.__dataclass_fields__ and "model_warnings" in COLUMNS
