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
def named_errors(design: str) -> Iterator[None]:
    """Make an `InputError` that names the design of each plain `ValueError` of the library."""
    try:
        yield
    except InputError:
        raise
    except ValueError as error:
        raise InputError(f"design {design}: {error}") from None


@contextmanager
def user_errors() -> Iterator[None]:
    """Print an `InputError`, a full disk or a lack of memory as one line on stderr; exit code 1."""
    try:
        yield
    except Exception as error:
        sentence = _describe(error)
        if not sentence:
            raise
        print(f"error: {sentence}", file=sys.stderr)
        raise SystemExit(1) from None


def _describe(error: Exception) -> str:
    full = find_full_disk(error)
    if full:
        place = f"{full.filename}: " if full.filename else ""
        return f"{place}{full.strerror}: free some space and start again, what is done is kept"
    if isinstance(error, MemoryError):
        return (
            "memory ran short: take fewer --cores, a lower resources mem_mb or smaller designs; "
            "what is done is kept"
        )
    return str(error) if isinstance(error, InputError) else ""


def find_full_disk(error: BaseException | None) -> OSError | None:
    """Return the error of a full disk that an exception is, holds or came from, None without."""
    seen: list[BaseException] = []
    waiting = [error]
    while waiting:
        one = waiting.pop()
        if not isinstance(one, BaseException) or one in seen:
            continue
        if isinstance(one, OSError) and one.errno in NO_SPACE:
            return one
        seen.append(one)
        waiting += [one.__cause__, one.__context__, *one.args]
    return None
