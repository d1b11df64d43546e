"""The process that runs scripts in forks of itself: `server.py descriptor folder module ...`.

It imports the modules once, from the folder, whenever the socket `descriptor` has no message. A
message is the path of a script, with a socket of its own for the answer. The fork sends its process
id, runs the script, and sends (exit code, processor seconds, largest resident memory in kB).
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
                run_fork(os.fsdecode(message), answer)


def run_fork(script: str, answer: socket.socket) -> None:
    """Run the script as `python script` would, answer, and end this process."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    name_process(script)
    try:
        answer.send(STARTED.pack(os.getpid()))
        code = run_script(script)
        sys.stdout.flush()
        sys.stderr.flush()
        used = resource.getrusage(resource.RUSAGE_SELF)
        below = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = used.ru_utime + used.ru_stime + below.ru_utime + below.ru_stime
        answer.send(ENDED.pack(code, seconds, max(used.ru_maxrss, below.ru_maxrss)))
    finally:
        os._exit(0)


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
