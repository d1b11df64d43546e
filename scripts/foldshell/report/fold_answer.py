"""The chapter of the report on what a fold buys: the page of explorations with its charts."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from markupsafe import Markup

from foldshell.report.embedded import embed_picture
from foldshell.report.markdown import render_markdown

PICTURE = re.compile(r"^!\[(.*)\]\((.*)\)$", re.M)
HEADING = re.compile(r"^#(?=#+ )", re.M)
OWN = re.compile(r"^Made by$.*", re.M | re.S)
"""How to make the page again, which the page says of itself."""


@dataclass(frozen=True)
class Part:
    """A piece of the chapter: its text, then a chart where there is one."""

    text: Markup
    words: str = ""
    data: str = ""


def read_chapter(files: Sequence[str | Path]) -> list[Part]:
    """Return the parts of function_follows_fold.md, the first of `files`; its charts are the
    others. Nothing without files."""
    if not files:
        return []
    page, *pictures = map(Path, files)
    known = {path.name: path for path in pictures}
    text = OWN.sub("", page.read_text(encoding="utf-8")).partition("\n")[2]
    pieces = PICTURE.split(HEADING.sub("##", text))
    texts, names, links = pieces[::3], [*pieces[1::3], ""], [*pieces[2::3], ""]
    return [
        Part(render_markdown(piece), name, embed_picture(known[Path(link).name]) if link else "")
        for piece, name, link in zip(texts, names, links, strict=True)
    ]
