"""HTML pieces: nothing that a file says can become markup or script."""

import json

import pytest

from foldshell.report.history_chart import Series, draw_history
from foldshell.report.markdown import render_markdown
from foldshell.report.markup import Cell, dump_json, format_number, make_page, make_table

EVIL = "</script><script>alert(1)</script>&\u2028\"'"


def test_json_in_a_script_cannot_end_it():
    """No bracket of a tag remains, and the data comes back."""
    text = dump_json({"name": EVIL})
    assert "<" not in text
    assert "\u2028" not in text
    assert json.loads(text) == {"name": EVIL}


def test_json_refuses_what_browsers_cannot_read():
    """nan is no JSON."""
    with pytest.raises(ValueError, match="JSON"):
        dump_json({"x": float("nan")})


def test_tables_and_titles_are_escaped():
    """The text is shown, not run."""
    for html in (make_table(("a",), [(Cell(EVIL),)]), make_page(EVIL, "", "")):
        assert "<script>" not in html
        assert "&lt;script&gt;" in html


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0"), (1475.2459, "1475"), (0.09788, "0.09788"), (1e-9, "1.00e-09"), (None, "–"),
     (True, "yes"), (15, "15"), (float("nan"), "–"), (0.5, "0.5"), (2e7, "2.00e+07")],
)  # fmt: skip
def test_numbers_read_well(value, text):
    """Four digits, no needless zeros, an exponent only for very small and large ones."""
    assert format_number(value) == text


def test_history_draws_curves_limits_and_gaps():
    """A point a value, none for a missing one; a limit far above the values is left out."""
    svg = draw_history([Series("a <b>", [1.0, None, 0.5], {"limit": 1.2, "far": 99.0}),
                        Series("b", [None], {})])  # fmt: skip
    assert svg.count("<circle") == 2
    assert "limit" in svg
    assert "far" not in svg
    assert "a &lt;b&gt;" in svg
    assert "no values" in svg


def test_markdown_of_the_projects_files():
    """Headings, tables with escaped bars, lists, code, bold; links keep their words only."""
    html = render_markdown(
        "# A\ntext `x<y` and\n**more** [site](https://example.org)\n\n"
        "| a | b |\n|---|---|\n| 1 \\| 2 | <i> |\n\n- one\n  two\n- three\n"
    )
    assert "<h1>A</h1>" in html
    assert "<p>text <code>x&lt;y</code> and <b>more</b> site</p>" in html
    assert "<td>1 | 2</td><td>&lt;i&gt;</td>" in html
    assert html.count("<li>") == 2
    assert "http" not in html
