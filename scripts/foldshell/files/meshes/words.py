"""Lines, words and numbers of text formats; `1,5`, `1_0` and `nan` are no numbers."""

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from foldshell.files.meshes.model import MeshError

_OF_NUMBERS = b"0123456789+-.eE"
Line = tuple[int, list[bytes]]
"""Number of a line in its file, and its words."""


def split_lines(data: bytes, comment: bytes = b"#") -> Iterator[Line]:
    """Yield every line that holds words, whatever ends it, without what follows `comment`."""
    text = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    for number, line in enumerate(text.split(b"\n"), start=1):
        words = (line.split(comment, 1)[0] if comment else line).split()
        if words:
            yield number, words


def quote(words: bytes | Sequence[bytes]) -> str:
    """Quote bytes of a file, cut short, safe to print."""
    text = words if isinstance(words, bytes) else b" ".join(words)
    return repr(text[:40].decode("latin-1"))


def parse_floats(lines: Iterable[Line]) -> np.ndarray:
    """Turn lines of equally many words into numbers (N, k); raise `MeshError` naming the line."""
    rows = list(lines)
    joined = b"".join(word for _, words in rows for word in words)
    if not joined.translate(None, _OF_NUMBERS):
        try:
            values = np.array([[float(word) for word in words] for _, words in rows])
        except ValueError:
            values = np.full(1, np.nan)
        if np.isfinite(values).all():
            return values
    for number, words in rows:
        for word in words:
            _check_float(number, word)
    raise MeshError("numbers that cannot be read")  # pragma: no cover


def _check_float(number: int, word: bytes) -> None:
    if not word.translate(None, _OF_NUMBERS):
        try:
            if np.isfinite(float(word)):
                return
        except ValueError:
            pass
    bare = word.lower().lstrip(b"+-")
    hint = ": decimal commas must be points" if b"," in word else ""
    hint = hint or (": a value that is not finite" if bare[:3] in (b"nan", b"inf") else "")
    raise MeshError(f"line {number}: {quote(word)}{hint or ': not a number'}: a number is allowed")


def parse_integers(number: int, words: Sequence[bytes]) -> list[int]:
    """Turn words of one line into whole numbers; raise `MeshError` naming the line."""
    values = []
    for word in words:
        digits = word[1:] if word[:1] in (b"-", b"+") else word
        if not (digits.isdigit() and len(digits) <= 18):
            raise MeshError(f"line {number}: {quote(word)}: a whole number is allowed")
        values.append(int(word))
    return values
