"""Errors that a person can act on: one sentence, no traceback."""

import errno
import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager

_LONG_WORD = re.compile(r"(\S{60})\S{340,}(\S{20})")
_LONGEST = 1200  # characters of a message
NO_SPACE = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


class InputError(ValueError):
    """A file, setting or cell that cannot be used.

    The message is one sentence that names the file, the place in it, the value found and
    what is allowed there. Values of thousands of characters are cut, and characters that a
    terminal would act on are written out.
    """

    def __init__(self, message: str) -> None:
        super().__init__(_make_plain(str(message)))


def _make_plain(message: str) -> str:
    text = _LONG_WORD.sub(r"\1...\2", message)
    if len(text) > _LONGEST:
        text = f"{text[: _LONGEST // 2]} ... {text[-_LONGEST // 3 :]}"
    if text.isprintable():
        return text
    return "".join(k if k.isprintable() else k.encode("unicode_escape").decode() for k in text)


@contextmanager
def user_errors() -> Iterator[None]:
    """Print an `InputError` or a full disk as one line on stderr and exit with code 1."""
    try:
        yield
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        raise SystemExit(1) from None
    except OSError as error:
        if error.errno not in NO_SPACE:
            raise
        print(f"error: {_say_full(error)}", file=sys.stderr)
        raise SystemExit(1) from None


def _say_full(error: OSError) -> str:
    place = f"{error.filename}: " if error.filename else ""
    return f"{place}{error.strerror}: free some space and start again, what is done is kept"
