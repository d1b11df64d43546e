"""What is said to a person when a job has ended."""

import contextlib
import os
import signal
from collections.abc import Mapping

from foldshell.engine.fork_client import NO_ANSWER

_SHELL = 128
"""A shell adds this to the signal that killed its command."""

_HINTS = {
    signal.SIGKILL: "by a person or, where memory ran short, by the system: look at the largest "
    "max_rss in results/benchmarks, take fewer --cores, or close other programs",
    signal.SIGSEGV: "a library crashed: its words are in the log",
    signal.SIGBUS: "a file that was being read became shorter, or a disk is full",
    signal.SIGXCPU: "its limit of processor time was reached",
}


def describe_end(rule: str, wildcards: Mapping[str, str], code: int) -> str | None:
    """Say which signal ended a job and what to do; None for an end that the job itself explains.

    `code` is the exit code: -s or 128 + s for a job that signal s has killed.
    """
    place = " ".join([rule, *wildcards.values()])
    if code == NO_ANSWER:
        return f"{place}: the process ended without an answer: start again, what is done is kept"
    number = -code if code < 0 else code - _SHELL
    if number not in set(signal.Signals):
        return None
    name = signal.Signals(number)
    hint = f", {_HINTS[name]}" if name in _HINTS else ""
    killed = f"{place}: killed by signal {number} ({name.name}){hint}"
    return f"{killed}; start again, what is done is kept"


def show_log(path: str) -> None:
    """Write a job's log to stderr in one piece, so that lines of parallel jobs do not mix."""
    with contextlib.suppress(OSError), open(path, "rb") as stream:
        text = stream.read()
        while text:
            text = text[os.write(2, text) :]
