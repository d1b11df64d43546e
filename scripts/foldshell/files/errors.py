"""Errors that a person can act on: one sentence, no traceback."""

import errno
import sys
from collections.abc import Iterator
from contextlib import contextmanager

NO_SPACE = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


class InputError(ValueError):
    """A file, setting or cell that cannot be used.

    The message is one sentence that names the file, the place in it, the value found and
    what is allowed there.
    """


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
