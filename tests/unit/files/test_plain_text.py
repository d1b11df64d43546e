"""Texts of users: whatever a browser, a spreadsheet or a terminal could act on is refused."""

from dataclasses import dataclass

import pytest

from foldshell.files.errors import InputError
from foldshell.files.plain_text import find_unsafe
from foldshell.records.entry import entry
from foldshell.records.table import read_rows, write_rows
from foldshell.settings.make import make_settings

HOSTILE = [
    "</script><script>alert(1)</script>", "<img src=x onerror=alert(1)>.obj", "a\nb", "a\rb",
    "a\x1b[2J", "a\x85b", "a\u2028b", "C50\u202e06C", "\u2066a", "\u200fa", '=HYPERLINK("x")',
    "@SUM(1)", "+1", " =1",
]  # fmt: skip
PLAIN = ["C50/60", "béton C30 & acier", "surfaces/dôme 1.obj", "a-b_c", "1 > 0", "日本", "-5 °C"]


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_text_is_refused_with_its_place(text):
    """The sentence names file and key, and shows the text in a way that cannot act itself."""
    with pytest.raises(InputError) as error:
        make_settings({"material": {"name": text}}, "config.yaml")
    words = str(error.value)
    assert words.startswith("config.yaml: material.name: '")
    assert words.isascii() and words.isprintable()


@pytest.mark.parametrize("text", PLAIN)
def test_plain_text_of_any_language_is_taken(text):
    """Letters of all scripts, signs of units and paths pass."""
    assert find_unsafe(text) is None


@dataclass(frozen=True, kw_only=True)
class Row:
    """A text and a number."""

    a: str = entry("a text")
    b: float | None = entry("a number", "-")


def test_a_csv_field_never_begins_a_formula(tmp_path):
    """A text gets an apostrophe; numbers, also negative ones, stay numbers."""
    rows = [Row(a="=1+1", b=-2.5), Row(a="-", b=None)]
    write_rows(tmp_path / "a.csv", Row, rows)
    assert (tmp_path / "a.csv").read_text() == "a,b\n'=1+1,-2.5\n-,\n"
    assert read_rows(tmp_path / "a.csv", Row) == rows
