"""The Markdown of this project's own files as HTML, by markdown-it-py."""

import functools

from markdown_it import MarkdownIt
from markupsafe import Markup


def render_markdown(text: str) -> Markup:
    """Return HTML of a Markdown text; HTML in it is shown as text, links keep their words only."""
    return Markup(_parser().render(text))


@functools.cache
def _parser() -> MarkdownIt:
    parser = MarkdownIt("commonmark", {"html": False}).enable("table")
    parser.disable(["image", "autolink"])
    for name, markup in {
        "link_open": "",
        "link_close": "",
        "table_open": '<div class="scroll"><table>\n',
        "table_close": "</table></div>\n",
    }.items():
        parser.add_render_rule(name, lambda _self, *_, markup=markup: markup)
    return parser
