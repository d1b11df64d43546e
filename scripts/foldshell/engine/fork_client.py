"""Ask a fork server to run scripts."""

import contextlib
import os
import socket
import subprocess
import sys
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from foldshell.engine.fork_server import ENDED, STARTED

AVAILABLE = sys.platform == "linux" and hasattr(socket, "recv_fds")

KEPT_MB = 1200.0
"""A fork that has grown larger than this ends with its script, whatever its kind."""


class NoForkServer(OSError):
    """The server is not there; the script was not started."""


@dataclass(frozen=True)
class Ended:
    """How a script ended: exit code, processor time (s) and largest resident memory (MB)."""

    code: int
    cpu_seconds: float
    rss_mb: float


class Job:
    """A script that runs in the fork `pid`; `end` is called with the fork and how it ended."""

    def __init__(self, fork: socket.socket, end: Callable[[socket.socket, Ended], None]) -> None:
        self._fork, self._end = fork, end
        started = fork.recv(STARTED.size)
        if not started:
            raise NoForkServer("the fork server has ended")
        (self.pid,) = STARTED.unpack(started)

    def wait(self) -> Ended:
        """Wait for the end of the script. A process that was killed has exit code -1."""
        try:
            answer = self._fork.recv(ENDED.size)
        except ConnectionError:
            answer = b""
        code, seconds, kilobytes = ENDED.unpack(answer) if answer else (-1, 0.0, 0)
        ended = Ended(code, seconds, kilobytes / 1024)
        self._end(self._fork, ended)
        return ended


@dataclass(frozen=True)
class _Kept:
    """A fork that waits for another script of its kind, and what its last one was about."""

    kind: str
    topic: str
    fork: socket.socket


class ForkServer:
    """A process that has imported modules and runs scripts in forks; it ends with this one.

    Parameters
    ----------
    folder : from which the modules are imported, last on the path of every script
    modules : names that the server imports whenever no script is asked for
    environment : of the server and all scripts; this process's own if None
    """

    def __init__(
        self,
        folder: str | Path,
        modules: Sequence[str],
        environment: Mapping[str, str] | None = None,
    ) -> None:
        self._lock = threading.Lock()
        self._kept: list[_Kept] = []
        self._requests, other = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        program = [sys.executable, str(Path(__file__).with_name("fork_server.py"))]
        with other:
            arguments = [str(other.fileno()), str(Path(folder).resolve()), *modules]
            self.process = subprocess.Popen(
                program + arguments, pass_fds=[other.fileno()], env=environment
            )

    def start(self, script: str | Path, kind: str = "", topic: str = "") -> Job:
        """Run a script in a fork. Raises `NoForkServer` if it cannot even be started.

        The fork of a script with a `kind` stays when it has ended well, with all that it holds in
        memory, and runs the next script of that kind: one on the same `topic` if there is a choice.
        """
        while kind and (fork := self._take(kind, topic)):
            with contextlib.suppress(OSError):  # killed while it waited
                fork.send(os.fsencode(script))
                return self._job(fork, kind, topic)
            fork.close()
        own, other = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        try:
            with other, self._lock:
                socket.send_fds(self._requests, [os.fsencode(script)], [other.fileno()])
            return self._job(own, kind, topic)
        except OSError as error:
            own.close()
            raise NoForkServer(str(error)) from error

    def stop(self) -> None:
        """End the server once its scripts have been started; they go on."""
        self._requests.close()
        with self._lock:
            while self._kept:
                self._kept.pop().fork.close()
        self.process.wait()

    def _take(self, kind: str, topic: str) -> socket.socket | None:
        """Return a fork that waits, the one on the topic first, else the one that waits longest."""
        with self._lock:
            fitting = [kept for kept in self._kept if kept.kind == kind]
            fitting.sort(key=lambda kept: kept.topic != topic)
            if not fitting:
                return None
            self._kept.remove(fitting[0])
            return fitting[0].fork

    def _job(self, fork: socket.socket, kind: str, topic: str) -> Job:
        """Return the job that a fork has begun; its end keeps the fork or lets it go."""

        def end(fork: socket.socket, ended: Ended) -> None:
            """Keep the fork, or let it go."""
            if not kind or ended.code or ended.rss_mb > KEPT_MB:
                fork.close()
                return
            with self._lock:
                self._kept.append(_Kept(kind, topic, fork))

        return Job(fork, end)
