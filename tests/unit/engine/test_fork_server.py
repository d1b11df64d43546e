"""Scripts in forks end as they would by `python script`, and leave nothing behind."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from foldshell.engine.fork_client import AVAILABLE, NO_ANSWER, ForkServer, NoForkServer

pytestmark = pytest.mark.skipif(not AVAILABLE, reason="forks are made on Linux alone")
SCRIPTS = Path(__file__).parents[3] / "scripts"
WAIT = 10.0
"""Seconds after which a process that should be gone counts as left behind: it takes some 10 ms."""


@pytest.fixture
def folder(tmp_path):
    """Modules of the server."""
    (tmp_path / "modules").mkdir()
    (tmp_path / "modules/library.py").write_text("loaded = [1]\n")
    return tmp_path / "modules"


@pytest.fixture
def server(folder):
    started = ForkServer(folder, ["library"])
    yield started
    started.stop()


def run(server, folder, text, name="job.py"):
    """Run a script with this text; return how it ended."""
    script = folder.parent / name
    script.write_text(text)
    return server.start(script).wait()


def wait_until_loaded(server, folder):
    """Modules are imported when the server has nothing else to do."""
    start = time.monotonic()
    while run(server, folder, "import sys; sys.exit('library' not in sys.modules)").code:
        assert time.monotonic() < start + WAIT


def is_alive(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def wait_until_gone(pid):
    start = time.monotonic()
    while is_alive(pid) and time.monotonic() < start + WAIT:
        time.sleep(0.01)
    return not is_alive(pid)


def test_a_script_runs_as_the_main_module_with_the_libraries_loaded(server, folder):
    out = folder.parent / "out.txt"
    text = "import os, sys\nbefore = 'library' in sys.modules\nimport library\n"
    text += f"open({str(out)!r}, 'w').write(repr((__name__, sys.argv, before, os.getppid())))\n"
    wait_until_loaded(server, folder)
    end = run(server, folder, text)
    assert end.code == 0 and end.rss_mb > 1
    expected = "__main__", [str(folder.parent / "job.py")], True, server.process.pid
    assert out.read_text() == repr(expected)


@pytest.mark.parametrize(
    ("text", "code", "said"),
    [
        ("import sys; sys.exit(3)", 3, ""),
        ("raise SystemExit", 0, ""),
        ("raise SystemExit('no such file')", 1, "no such file\n"),
        ("1 / 0", 1, "ZeroDivisionError: division by zero\n"),
        ("import os, signal; os.kill(os.getpid(), signal.SIGKILL)", -9, ""),
        ("import os; os._exit(0)", NO_ANSWER, ""),
        ("print('out'); import sys; print('err', file=sys.stderr)", 0, "err\n"),
        ("import subprocess; assert subprocess.run(['true']).returncode == 0", 0, ""),
    ],
)
def test_exit_codes_and_messages_are_those_of_python(server, folder, text, code, said):
    """A process that ends without an answer never counts as done."""
    errors = folder.parent / "errors.txt"
    redirect = f"import os\nos.dup2(os.open({str(errors)!r}, os.O_WRONLY | os.O_CREAT), 2)\n"
    assert run(server, folder, redirect + text).code == code
    assert errors.read_text().endswith(said)


def test_forks_share_nothing(server, folder):
    change = "import library\nlibrary.loaded.append(2)\nassert library.loaded == [1, 2]"
    assert [run(server, folder, change).code for _ in range(3)] == [0, 0, 0]


def run_kept(server, folder, text, affinity="", pool="shell", name="job.py"):
    """Run a script of a pool that is kept; return its process and how it ended."""
    script = folder.parent / name
    script.write_text(text)
    job = server.start(script, pool, affinity)
    return job.pid, job.wait()


def test_a_kept_fork_runs_the_next_script_of_its_pool_with_what_it_holds(server, folder):
    change = "import library\nlibrary.loaded.append(2)\nassert len(library.loaded) == {}"
    first, end = run_kept(server, folder, change.format(2))
    assert end.code == 0 and is_alive(first)
    second, end = run_kept(server, folder, change.format(3), "another affinity")
    assert (second, end.code) == (first, 0)
    assert run_kept(server, folder, change.format(2), pool="other")[1].code == 0
    assert run(server, folder, change.format(2)).code == 0


def test_what_a_script_and_its_children_print_goes_to_its_log(server, folder):
    """Of a script that fails or is killed too; the next one of a kept fork has its own."""
    talk = "import os\nprint('out')\nos.system('echo child >&2')\n"
    logs = [folder.parent / f"{number}.log" for number in range(3)]
    for log, last in zip(logs, ("", "1 / 0", "os.kill(os.getpid(), 9)"), strict=True):
        script = folder.parent / "job.py"
        script.write_text(talk.replace("out", log.stem) + "import sys; sys.stdout.flush()\n" + last)
        server.start(script, "shell", log=log).wait()
    texts = [log.read_text() for log in logs]
    assert all("child\n" in text for text in texts)
    assert all(f"{number}\n" in text for number, text in enumerate(texts))
    assert "ZeroDivisionError" in texts[1] and "ZeroDivisionError" not in texts[2]


def test_a_log_that_cannot_be_written_stops_no_script(server, folder):
    script = folder.parent / "job.py"
    script.write_text("print('said')")
    assert server.start(script, log=folder.parent / "no/such.log").wait().code == 0


def run_two(server, folder, pool):
    """Run two scripts side by side, of the affinities a and b; return their processes."""
    script, ready = folder.parent / "wait.py", folder.parent / "ready"
    script.write_text(
        f"import os, time\nwhile not os.path.exists({str(ready)!r}): time.sleep(0.01)"
    )
    jobs = [server.start(script, pool, affinity) for affinity in ("a", "b")]
    assert all(is_alive(job.pid) for job in jobs)
    ready.touch()
    assert [job.wait().code for job in jobs] == [0, 0]
    return [job.pid for job in jobs]


def test_a_script_goes_to_the_kept_fork_of_its_affinity_else_to_the_one_that_waits_longest(
    server, folder
):
    a, b = run_two(server, folder, "shell")
    assert [run_kept(server, folder, "", affinity)[0] for affinity in "babaa"] == [b, a, b, a, a]
    assert run_kept(server, folder, "", "c")[0] == b


def test_a_fork_that_fails_is_not_kept(server, folder):
    """What a failed script leaves in memory may be half done."""
    pid, end = run_kept(server, folder, "1 / 0")
    assert end.code == 1 and wait_until_gone(pid)


def test_a_large_fork_is_not_kept(server, folder, monkeypatch):
    monkeypatch.setattr("foldshell.engine.fork_client.KEPT_MB", 60.0)
    small, _ = run_kept(server, folder, "")
    assert is_alive(small)
    large, end = run_kept(server, folder, "filled = b'1' * 100_000_000")
    assert large == small and end.rss_mb > 100 and wait_until_gone(large)


def test_forks_that_wait_hold_no_more_memory_than_they_may(folder):
    """The one that waits longest goes first."""
    server = ForkServer(folder, ["library"], kept_mb=1.0)
    pid, end = run_kept(server, folder, "")
    assert end.rss_mb > 1 and wait_until_gone(pid)
    server.stop()


@pytest.mark.parametrize("most", [1, 2])
def test_no_more_forks_wait_than_there_are_cores(folder, most):
    """Of four of a pool that ran side by side, in whatever order they end; another pool's stays."""
    server = ForkServer(folder, ["library"], kept_most=most)
    other, _ = run_kept(server, folder, "", pool="other")
    script = folder / "job.py"
    script.write_text("import time\ntime.sleep(0.5)\n")
    jobs = [server.start(script, "pool") for _ in range(4)]
    assert all(job.wait().code == 0 for job in jobs)
    start = time.monotonic()
    while sum(is_alive(job.pid) for job in jobs) > most and time.monotonic() < start + WAIT:
        time.sleep(0.01)
    time.sleep(0.2)
    assert sum(is_alive(job.pid) for job in jobs) == most and is_alive(other)
    server.stop()


def test_a_kept_fork_that_was_killed_is_replaced(server, folder):
    killed, _ = run_kept(server, folder, "")
    os.kill(killed, signal.SIGKILL)
    assert wait_until_gone(killed)
    pid, end = run_kept(server, folder, "")
    assert pid != killed and end.code == 0


def test_kept_forks_end_with_the_server(folder):
    server = ForkServer(folder, ["library"])
    pids = run_two(server, folder, "shell")
    assert all(map(is_alive, pids))
    server.stop()
    assert all(map(wait_until_gone, pids))


def test_processor_time_of_a_kept_fork_is_that_of_each_script(server, folder):
    spin = (
        "import time\nstart = time.process_time()\nwhile time.process_time() < start + 0.25: pass"
    )
    _, first = run_kept(server, folder, spin)
    _, second = run_kept(server, folder, "")
    assert first.cpu_seconds >= 0.24 and second.cpu_seconds < 0.2


def test_processor_time_counts_the_work_of_the_fork_and_its_children(server, folder):
    """Half a second in all, in steps of the kernel's clock, 10 ms at most."""
    spin = "import time\nwhile time.process_time() < {}: pass\n"
    assert run(server, folder, "pass").cpu_seconds < 0.2
    code = spin.format(0.25)
    both = f"import subprocess, sys\nsubprocess.run([sys.executable, '-c', {code!r}])\n" + code
    assert run(server, folder, both).cpu_seconds >= 0.48


def test_jobs_run_side_by_side_and_leave_no_process(server, folder):
    assert all(map(wait_until_gone, run_two(server, folder, pool="")))


def test_without_a_server_nothing_is_started(server, folder):
    os.kill(server.process.pid, signal.SIGKILL)
    server.process.wait()
    with pytest.raises(NoForkServer):
        run(server, folder, "pass")


def test_an_error_in_a_library_is_left_to_the_scripts_that_use_it(folder):
    """Others run on, and what could be imported is shared."""
    (folder / "broken.py").write_text("1 / 0\n")
    server = ForkServer(folder, ["broken", "library"])
    assert run(server, folder, "import broken").code == 1
    wait_until_loaded(server, folder)
    server.stop()


@pytest.mark.parametrize(
    "number",
    [
        pytest.param("server.process.pid", id="server"),
        pytest.param("kept.pid", id="kept fork"),
    ],
)
def test_a_killed_client_takes_its_processes_with_it(folder, number):
    """The server and what waits: a job that has begun goes on, as one started by a shell does."""
    program = "import sys\nfrom foldshell.engine.fork_client import ForkServer\n"
    program += f"server = ForkServer({str(folder)!r}, ['library'])\n"
    program += f"kept = server.start({str(folder / 'library.py')!r}, 'shell')\n"
    program += f"kept.wait()\nprint({number}, flush=True)\nsys.stdin.read()\n"
    client = subprocess.Popen(
        [sys.executable, "-c", program],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONPATH": str(SCRIPTS)},
    )
    with client:
        pid = int(client.stdout.readline())
        assert is_alive(pid)
        client.kill()
    assert wait_until_gone(pid)
