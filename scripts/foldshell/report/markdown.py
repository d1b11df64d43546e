"""The Markdown of this project's own files as HTML: headings, paragraphs, lists, tables, code."""

import re
from collections.abc import Iterator

from foldshell.report.markup import escape

_CELL = re.compile(r"(?<!\\)\|")
_RULE = re.compile(r"^\|[\s:|-]+\|$")


def render_markdown(text: str) -> str:
    """Return HTML of a Markdown text; whatever is HTML in it is shown as text."""
    return "\n".join(_render_block(lines) for lines in _split_blocks(text))


def _split_blocks(text: str) -> Iterator[list[str]]:
    """Yield the lines of each heading, table, list or paragraph."""
    block: list[str] = []
    for line in [*text.splitlines(), ""]:
        starts = line.startswith("#") or (block and _kind(line) != _kind(block[0]))
        continues = bool(block) and block[0].startswith("- ") and line.startswith("  ")
        if block and (not line.strip() or starts) and not (continues and line.strip()):
            yield block
            block = []
        if line.strip():
            block.append(line)


def _kind(line: str) -> str:
    return next((mark for mark in ("#", "|", "- ") if line.startswith(mark)), "")


def _render_block(lines: list[str]) -> str:
    kind = _kind(lines[0])
    if kind == "#":
        level = len(lines[0]) - len(lines[0].lstrip("#"))
        return f"<h{level}>{_inline(lines[0].lstrip('# '))}</h{level}>"
    if kind == "|":
        return _render_table(lines)
    if kind == "- ":
        items = re.split(r"^- ", "\n".join(lines), flags=re.MULTILINE)[1:]
        return "<ul>" + "".join(f"<li>{_inline(item)}</li>" for item in items) + "</ul>"
    return f"<p>{_inline(' '.join(lines))}</p>"


def _render_table(lines: list[str]) -> str:
    rows = [_CELL.split(line.strip()[1:-1]) for line in lines if not _RULE.match(line.strip())]
    head, *body = rows
    cells = "".join(f"<th>{_inline(cell)}</th>" for cell in head)
    table = "".join(
        "<tr>" + "".join(f"<td>{_inline(cell)}</td>" for cell in row) + "</tr>\n" for row in body
    )
    return (
        f'<div class="scroll"><table><thead><tr>{cells}</tr></thead>'
        f"<tbody>\n{table}</tbody></table></div>"
    )


def _inline(text: str) -> str:
    """Return escaped text with code, bold and the targets of links."""
    text = escape(text.strip().replace("\\|", "|"))
    text = re.sub(r"`([^`]+)`", r"<code>\1</code>", text)
    text = re.sub(r"\*\*([^*]+)\*\*", r"<b>\1</b>", text)
    return re.sub(r"\[([^\]]+)\]\(([^)\s]+)\)", r"\1", text)
