"""Ask a fork server to run scripts."""

import contextlib
import os
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from foldshell.engine.fork_server import ENDED, SIGNAL, STARTED

AVAILABLE = sys.platform == "linux" and hasattr(socket, "recv_fds")

NO_ANSWER = 255
"""Exit code of a script whose process ended by itself but said nothing."""

KEPT_MB = 1200.0
"""A fork that has grown larger than this ends with its script, whatever its pool."""


class NoForkServer(OSError):
    """The server is not there; the script was not started."""


@dataclass(frozen=True)
class JobResult:
    """How a script ended: exit code, processor time (s), largest resident memory (MB), and the wall
    time (s) since it was started."""

    code: int
    cpu_seconds: float
    rss_mb: float
    seconds: float = 0.0

    def describe(self) -> tuple[float, float, float, float, bool]:
        """Return wall time and processor time (s), the latter in per cent of a second, memory (MB),
        and that all are known: in the order of a benchmark record."""
        return self.seconds, self.cpu_seconds, 100 * self.cpu_seconds, self.rss_mb, True


class Job:
    """A script that runs in the fork `pid`; `end` is called with the fork and how it ended.

    `find_signal` asks for the signal that killed the fork of a process id.
    """

    def __init__(
        self,
        fork: socket.socket,
        end: Callable[[socket.socket, JobResult], None],
        find_signal: Callable[[int], int],
    ) -> None:
        self._fork, self._end, self._find_signal = fork, end, find_signal
        started = fork.recv(STARTED.size)
        if not started:
            raise NoForkServer("the fork server has ended")
        (self.pid,) = STARTED.unpack(started)

    def wait(self) -> JobResult:
        """Wait for the end of the script. A process that was killed by signal s has exit code -s,
        one that ended without an answer `NO_ANSWER`."""
        try:
            answer = self._fork.recv(ENDED.size)
        except ConnectionError:
            answer = b""
        if answer:
            code, seconds, kilobytes = ENDED.unpack(answer)
        else:
            code, seconds, kilobytes = -self._find_signal(self.pid) or NO_ANSWER, 0.0, 0
        result = JobResult(code, seconds, kilobytes / 1024)
        self._end(self._fork, result)
        return result


@dataclass(frozen=True)
class _Kept:
    """A fork that waits for another script of its pool, and the affinity of its last one."""

    pool: str
    affinity: str
    fork: socket.socket
    rss_mb: float = 0.0


class ForkServer:
    """A process that has imported modules and runs scripts in forks; it ends with this one.

    Parameters
    ----------
    folder : from which the modules are imported, last on the path of every script
    modules : names that the server imports whenever no script is asked for
    environment : of the server and all scripts; this process's own if None
    kept_mb : memory (MB) that forks may hold while they wait; the one that waits longest goes first
    kept_most : how many of a pool may wait; no more can be of use at once than there are cores
    """

    def __init__(
        self,
        folder: str | Path,
        modules: Sequence[str],
        environment: Mapping[str, str] | None = None,
        kept_mb: float | None = None,
        kept_most: int | None = None,
    ) -> None:
        self._kept_mb = float("inf") if kept_mb is None else kept_mb
        self._kept_most = float("inf") if kept_most is None else kept_most
        self._lock = threading.Lock()
        self._kept: list[_Kept] = []
        self._requests, other = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        program = [sys.executable, str(Path(__file__).with_name("fork_server.py"))]
        with other:
            arguments = [str(other.fileno()), str(Path(folder).resolve()), *modules]
            self.process = subprocess.Popen(
                program + arguments, pass_fds=[other.fileno()], env=environment
            )

    def start(
        self, script: str | Path, pool: str = "", affinity: str = "", log: str | Path = ""
    ) -> Job:
        """Run a script in a fork. Raises `NoForkServer` if it cannot even be started.

        The fork of a script with a `pool` stays when it has ended well, with all that it holds in
        memory, and runs the next script of that pool: one of the same `affinity`, such as the
        design, if there is a choice. What the script prints goes to `log`, if there is one.
        """
        message = os.fsencode(script) + b"\0" + os.fsencode(log)
        while pool and (fork := self._take(pool, affinity)):
            with contextlib.suppress(OSError):  # killed while it waited
                fork.send(message)
                return self._job(fork, pool, affinity)
            fork.close()
        own, other = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        try:
            with other, self._lock:
                socket.send_fds(self._requests, [message], [other.fileno()])
            return self._job(own, pool, affinity)
        except OSError as error:
            own.close()
            raise NoForkServer(str(error)) from error

    def run(
        self, script: str | Path, pool: str = "", affinity: str = "", log: str | Path = ""
    ) -> JobResult | None:
        """Run a script to its end; None if it cannot even be started. Arguments as of `start`."""
        begun = time.time()
        try:
            result = self.start(script, pool, affinity, log).wait()
        except NoForkServer:
            return None
        return replace(result, seconds=time.time() - begun)

    def stop(self) -> None:
        """End the server once its scripts have been started; they go on."""
        self._requests.close()
        with self._lock:
            while self._kept:
                self._kept.pop().fork.close()
        self.process.wait()

    def _take(self, pool: str, affinity: str) -> socket.socket | None:
        """Return a fork that waits, one of the affinity first, else the one that waits longest."""
        with self._lock:
            fitting = [kept for kept in self._kept if kept.pool == pool]
            fitting.sort(key=lambda kept: kept.affinity != affinity)
            if not fitting:
                return None
            self._kept.remove(fitting[0])
            return fitting[0].fork

    def _job(self, fork: socket.socket, pool: str, affinity: str) -> Job:
        """Return the job that a fork has begun; its end keeps the fork or lets it go."""

        def end(fork: socket.socket, result: JobResult) -> None:
            """Keep the fork, or let it go."""
            if not pool or result.code or result.rss_mb > KEPT_MB:
                fork.close()
                return
            with self._lock:
                self._kept.append(_Kept(pool, affinity, fork, result.rss_mb))
                self._let_go(pool)

        return Job(fork, end, self._find_signal)

    def _let_go(self, pool: str) -> None:
        """End those that wait longest: of the pool where it has too many, of all beyond memory."""
        own = [kept for kept in self._kept if kept.pool == pool]
        if len(own) > self._kept_most:
            self._kept.remove(own[0])
            own[0].fork.close()
        while self._kept and sum(kept.rss_mb for kept in self._kept) > self._kept_mb:
            self._kept.pop(0).fork.close()

    def _find_signal(self, pid: int) -> int:
        """Return the signal that killed a fork, 0 if none or if the server is gone too."""
        own, other = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with own, contextlib.suppress(OSError):
            with other, self._lock:
                socket.send_fds(self._requests, [b"\0%d" % pid], [other.fileno()])
            answer = own.recv(SIGNAL.size)
            return SIGNAL.unpack(answer)[0] if answer else 0
        return 0
