"""The process that runs scripts in forks of itself: `fork_server.py descriptor folder module ...`.

It imports the modules once, from the folder, whenever the socket `descriptor` has no message. A
message is the path of a script, with a socket of its own for the answer. The fork sends its process
id, runs the script, and sends (exit code, processor seconds, largest resident memory in kB). Then
it waits for another script on that socket, and ends when it is closed.
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
OWN_AND_CHILDREN = resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN


def serve(requests: socket.socket, modules: list[str]) -> None:
    """Import the modules and run scripts until the socket is closed.

    A module that cannot be imported is left to the scripts: the error belongs there.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the jobs and who started them
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # forks that have ended leave no zombies
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
            if os.fork() == 0:
                requests.close()
                run_fork(message, answer)


def run_fork(message: bytes, answer: socket.socket) -> None:
    """Run the script as `python script` would, answer, go on with the next; end this process."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    try:
        while message:
            script, before = os.fsdecode(message), count_seconds()
            name_process(script)
            answer.send(STARTED.pack(os.getpid()))
            code = run_script(script)
            sys.stdout.flush()
            sys.stderr.flush()
            largest = max(resource.getrusage(who).ru_maxrss for who in OWN_AND_CHILDREN)
            answer.send(ENDED.pack(code, count_seconds() - before, largest))
            message = answer.recv(MESSAGE_MAX)
    finally:
        os._exit(0)


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
