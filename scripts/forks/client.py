"""Ask a fork server to run scripts."""

import os
import socket
import subprocess
import sys
import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from forks.server import ENDED, STARTED

AVAILABLE = sys.platform == "linux" and hasattr(socket, "recv_fds")


class NoForkServer(OSError):
    """The server is not there; the script was not started."""


@dataclass(frozen=True)
class Ended:
    """How a script ended: exit code, processor time (s) and largest resident memory (MB)."""

    code: int
    cpu_seconds: float
    rss_mb: float


class Job:
    """A script that runs in the fork `pid`."""

    def __init__(self, answer: socket.socket) -> None:
        self._answer = answer
        started = answer.recv(STARTED.size)
        if not started:
            raise NoForkServer("the fork server has ended")
        (self.pid,) = STARTED.unpack(started)

    def wait(self) -> Ended:
        """Wait for the end of the script. A process that was killed has exit code -1."""
        with self._answer:
            try:
                answer = self._answer.recv(ENDED.size)
            except ConnectionError:
                answer = b""
        if not answer:
            return Ended(-1, 0.0, 0.0)
        code, seconds, kilobytes = ENDED.unpack(answer)
        return Ended(code, seconds, kilobytes / 1024)


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
        self._requests, other = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        program = [sys.executable, str(Path(__file__).with_name("server.py"))]
        with other:
            arguments = [str(other.fileno()), str(Path(folder).resolve()), *modules]
            self.process = subprocess.Popen(
                program + arguments, pass_fds=[other.fileno()], env=environment
            )

    def start(self, script: str | Path) -> Job:
        """Run a script in a fork. Raises `NoForkServer` if it cannot even be started."""
        own, other = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        try:
            with other, self._lock:
                socket.send_fds(self._requests, [os.fsencode(script)], [other.fileno()])
            return Job(own)
        except OSError as error:
            own.close()
            raise NoForkServer(str(error)) from error

    def stop(self) -> None:
        """End the server once its scripts have been started; they go on."""
        self._requests.close()
        self.process.wait()
