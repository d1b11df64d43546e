"""Pieces of pages: nothing that a file says can become markup or script."""

import json

import pytest
from markupsafe import Markup

from foldshell.report.history_chart import Series, draw_history
from foldshell.report.markdown import render_markdown
from foldshell.report.markup import Cell, format_number, make_table, render, templates
from foldshell.report.section import Box, Section

EVIL = "</script><script>alert(1)</script>&\u2028\"'"


def test_json_in_a_script_cannot_end_it():
    """No bracket of a tag remains, and the data comes back."""
    text = templates().from_string("{{ data | tojson }}").render(data={"name": EVIL})
    assert "<" not in text
    assert json.loads(text) == {"name": EVIL}


def test_json_refuses_what_browsers_cannot_read():
    """nan is no JSON."""
    with pytest.raises(ValueError, match="JSON"):
        templates().from_string("{{ data | tojson }}").render(data={"x": float("nan")})


def test_every_text_of_a_page_is_escaped():
    """Whatever a template is given is shown, not run: title, words, boxes, tables, links."""
    table = make_table((EVIL,), [(Cell(EVIL, "good"),)])
    section = Section(EVIL, Box("bad", EVIL, EVIL, EVIL), EVIL, table, note=EVIL)
    design = {"title": EVIL, "description": EVIL, "sections": [section], "links": {EVIL: EVIL},
              "pictures": [{"words": EVIL, "path": EVIL, "data": EVIL}], "facts": {"name": EVIL},
              "packed": "", "scripts": [],
              "exported": False,
              "still": {"words": EVIL, "path": EVIL, "data": EVIL}}  # fmt: skip
    summary = {"title": EVIL, "counts": EVIL, "checked": 0, "columns": [(EVIL, 0)],
               "rows": [(EVIL, [Cell(EVIL)])]}  # fmt: skip
    settings = {"title": EVIL, "digest": EVIL, "groups": [(EVIL, table)]}
    for name, values, scripts in (("design", design, 3), ("summary", summary, 1),
                                  ("settings", settings, 0),
                                  ("text", {"title": EVIL, "text": EVIL}, 0)):  # fmt: skip
        page = render(f"{name}.html", **values)
        assert page.count("<script") == page.count("</script") == scripts
        assert "&lt;script&gt;alert(1)" in page


def test_a_missing_value_is_an_error_and_markup_stays():
    """A template that asks for more than it is given does not leave a gap."""
    with pytest.raises(Exception, match="'text' is undefined"):
        render("text.html", title="a")
    assert "<b>x</b>" in render("text.html", title="a", text=Markup("<b>x</b>"))


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
    assert "<p>text <code>x&lt;y</code> and\n<strong>more</strong> site</p>" in html
    assert "<td>1 | 2</td>\n<td>&lt;i&gt;</td>" in html
    assert html.count("<li>") == 2
    assert "http" not in html
