"""The process that runs scripts in forks of itself: `fork_server.py descriptor folder module ...`.

It imports the modules once, from the folder, whenever the socket `descriptor` has no message. A
message is the path of a script, and after a zero byte that of its log, with a socket of its own for
the answer. The fork sends its process id, runs the script, and sends (exit code, processor seconds,
largest resident memory in kB). Then it waits for another script on that socket, and ends when it is
closed. A message that begins with the zero byte holds the id of a fork: the answer is the signal
that killed it, 0 for none.
A closed `descriptor` ends the server, whoever closed it: nothing stays behind a killed client.
"""

import contextlib
import gc
import importlib
import os
import resource
import runpy
import select
import signal
import socket
import struct
import sys
import traceback

STARTED = struct.Struct("q")
ENDED = struct.Struct("qdq")
MESSAGE_MAX = 65536
INTERRUPTED = 128 + signal.SIGINT
"""Exit code after Ctrl-C, as a shell gives it."""
SIGNAL = struct.Struct("i")
OWN_AND_CHILDREN = resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN


def serve(requests: socket.socket, modules: list[str]) -> None:
    """Import the modules and run scripts until the socket is closed.

    A module that cannot be imported is left to the scripts: the error belongs there.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the jobs and who started them
    killed: dict[int, int] = {}
    signal.signal(signal.SIGCHLD, lambda *_: reap_forks(killed))
    waiting = list(modules)
    while True:
        while waiting and not select.select([requests], [], [], 0)[0]:
            with contextlib.suppress(Exception):
                importlib.import_module(waiting.pop(0))
            gc.freeze()  # what is imported stays shared with the forks
        message, descriptors, *_ = socket.recv_fds(requests, MESSAGE_MAX, 1)
        if not message:
            return
        with socket.socket(fileno=descriptors[0]) as answer:
            if message.startswith(b"\0"):
                with contextlib.suppress(OSError):  # nobody waits any more
                    answer.send(SIGNAL.pack(find_signal(int(message[1:]), killed)))
            elif os.fork() == 0:
                requests.close()
                run_fork(message, answer)


def reap_forks(killed: dict[int, int]) -> None:
    """Take note of the forks that have ended, so that they leave no zombies: {id: signal}."""
    with contextlib.suppress(ChildProcessError):
        while (ended := os.waitpid(-1, os.WNOHANG))[0]:
            if os.WIFSIGNALED(ended[1]):
                killed[ended[0]] = os.WTERMSIG(ended[1])


def find_signal(fork: int, killed: dict[int, int]) -> int:
    """Return the signal that killed a fork which ends now or has ended, 0 for none."""
    with contextlib.suppress(ChildProcessError):  # the note is taken already
        status = os.waitpid(fork, 0)[1]
        return os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0
    return killed.pop(fork, 0)


def run_fork(message: bytes, answer: socket.socket) -> None:
    """Run the script as `python script` would, answer, go on with the next; end this process."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    terminal = os.dup(1), os.dup(2)
    try:
        while message:
            script, _, log = os.fsdecode(message).partition("\0")
            before = count_seconds()
            name_process(script)
            redirect_output(log, terminal)
            answer.send(STARTED.pack(os.getpid()))
            code = run_script(script)
            sys.stdout.flush()
            sys.stderr.flush()
            largest = max(resource.getrusage(who).ru_maxrss for who in OWN_AND_CHILDREN)
            answer.send(ENDED.pack(code, count_seconds() - before, largest))
            message = answer.recv(MESSAGE_MAX)
    finally:
        os._exit(0)


def redirect_output(log: str, terminal: tuple[int, int]) -> None:
    """Let all that the process prints, by whatever library, go to its log; without one, or where
    the log cannot be written, to where it went at first."""
    targets = terminal
    if log:
        with contextlib.suppress(OSError):
            opened = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_APPEND, 0o666)
            targets = opened, opened
    for target, own in zip(targets, (1, 2), strict=True):
        os.dup2(target, own)
    if targets is not terminal:
        os.close(targets[0])


def count_seconds() -> float:
    """Return the processor time of this process and its children so far."""
    used = [resource.getrusage(who) for who in OWN_AND_CHILDREN]
    return sum(one.ru_utime + one.ru_stime for one in used)


def run_script(script: str) -> int:
    """Run a script as the main module; return the exit code that Python would end with."""
    sys.argv = [script]
    try:
        runpy.run_path(script, run_name="__main__")
    except SystemExit as end:
        if end.code is None or isinstance(end.code, int):
            return end.code or 0
        print(end.code, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return INTERRUPTED
    except BaseException:
        traceback.print_exc()
        return 1
    return 0


def name_process(script: str) -> None:
    """Show the script's name in process lists, where the system can."""
    try:
        with open("/proc/self/comm", "w") as stream:
            stream.write(os.path.basename(script).split(".", 1)[-1])
    except OSError:
        pass


if __name__ == "__main__":
    sys.path[0:1] = []
    sys.path.append(sys.argv[2])  # where Snakemake has it: behind all packages
    serve(socket.socket(fileno=int(sys.argv[1])), sys.argv[3:])
