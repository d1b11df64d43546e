"""Errors that a person can act on: one sentence, no traceback."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager


class InputError(ValueError):
    """A file, setting or cell that cannot be used.

    The message is one sentence that names the file, the place in it, the value found and
    what is allowed there.
    """


@contextmanager
def user_errors() -> Iterator[None]:
    """Print an `InputError` as one line on stderr and exit with code 1."""
    try:
        yield
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        raise SystemExit(1) from None
