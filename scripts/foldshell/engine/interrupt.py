"""Ctrl-C: the first one ends a run, more of them change nothing."""

import contextlib
import os
import signal

STOPPING = b"already stopping: jobs end, what is done is kept\n"


def stop_once() -> None:
    """Let the first Ctrl-C raise `KeyboardInterrupt`; later ones are answered by a line, so that
    they do not break off the end of the run. Does nothing outside of the main thread."""

    def stop(_number: int, _frame: object) -> None:
        """Stop the run, and have later ones answered."""
        signal.signal(signal.SIGINT, answer)
        raise KeyboardInterrupt

    def answer(_number: int, _frame: object) -> None:
        """Say that the run is stopping, and take no more."""
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        with contextlib.suppress(OSError):
            os.write(2, STOPPING)

    with contextlib.suppress(ValueError):
        signal.signal(signal.SIGINT, stop)
