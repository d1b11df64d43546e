"""Texts of users that other programs will write on: what could act there instead of being read."""

import re

UNSAFE = {
    "a line end or control character": re.compile(r"[\x00-\x1f\x7f-\x9f\u2028\u2029]"),
    "a mark that changes the direction of writing": re.compile(
        "[\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069]"
    ),
    "<, which begins markup": re.compile("<"),
    "a first character that begins a formula": re.compile(r"\A\s*[=+@]"),
}
"""What is refused in a text, and why: web pages run markup, spreadsheets run formulas."""


def find_unsafe(text: str) -> str | None:
    """Return what in a text could act in a page, a table or a terminal; None for plain text."""
    return next((words for words, pattern in UNSAFE.items() if pattern.search(text)), None)
