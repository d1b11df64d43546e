"""What went wrong with an input of the cross-check, in one sentence."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager


class CrosscheckError(ValueError):
    """A file or a value that cannot be used: file, place, value, and what is allowed."""


class MechanismError(CrosscheckError):
    """The supports let the shell move: there are no displacements."""


@contextmanager
def report_errors() -> Iterator[None]:
    """Turn a `CrosscheckError` into one line on stderr and exit code 1, without a traceback."""
    try:
        yield
    except CrosscheckError as error:
        print(f"error: {error}", file=sys.stderr)
        raise SystemExit(1) from None
