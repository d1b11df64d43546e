"""What went wrong with an input of the cross-check, in one sentence."""

import errno
import sys
from collections.abc import Iterator
from contextlib import contextmanager

NO_SPACE = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


class CrosscheckError(ValueError):
    """A file or a value that cannot be used: file, place, value, and what is allowed."""


class MechanismError(CrosscheckError):
    """The supports let the shell move: there are no displacements."""


@contextmanager
def report_errors() -> Iterator[None]:
    """Turn a `CrosscheckError` or a full disk into one line on stderr and exit code 1."""
    try:
        yield
    except CrosscheckError as error:
        print(f"error: {error}", file=sys.stderr)
        raise SystemExit(1) from None
    except OSError as error:
        if error.errno not in NO_SPACE:
            raise
        print(f"error: {error}: free some space and start again", file=sys.stderr)
        raise SystemExit(1) from None
