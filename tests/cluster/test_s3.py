"""Results in an S3 server of this machine: stopped, gone on with, and a server that goes away."""

import hashlib
import os
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

import openpyxl
import pytest

REPOSITORY = Path(__file__).parents[2]
sys.path.insert(0, str(REPOSITORY / "tests/workflow"))

from study_runner import DESIGNS, TARGET, copy_code, make_study, results, run  # noqa: E402

MOTO = os.environ.get("MOTO_SERVER") or shutil.which("moto_server")
boto3 = pytest.importorskip("boto3")
pytest.importorskip("snakemake_storage_plugin_s3")
pytestmark = [
    pytest.mark.cluster,
    pytest.mark.slow,
    pytest.mark.skipif(
        not MOTO, reason="no moto_server: pip install 'moto[server]', or MOTO_SERVER=PATH"
    ),
]
KEY = {"SNAKEMAKE_STORAGE_S3_ACCESS_KEY": "test", "SNAKEMAKE_STORAGE_S3_SECRET_KEY": "test"}
TARGETS = (TARGET, *(f"results/tiny-{name}/manifest.json" for name in ("dome", "saddle", "arch")))
THREE = f"{DESIGNS}tiny-arch\tarch\t8\t2\t5\t6\tall\ttiny\n"


class Gate:
    """A port that leads to another one while it is open."""

    def __init__(self, target):
        self.target, self.open = target, True
        self._server = socket.create_server(("127.0.0.1", 0))
        self.url = f"http://127.0.0.1:{self._server.getsockname()[1]}"
        threading.Thread(target=self._serve, daemon=True).start()

    def _serve(self):
        while self.open:
            try:
                one, _ = self._server.accept()
            except OSError:  # closed
                return
            if not self.open:
                one.close()
                continue
            other = socket.create_connection(("127.0.0.1", self.target))
            for source, sink in ((one, other), (other, one)):
                threading.Thread(target=self._copy, args=(source, sink), daemon=True).start()

    def _copy(self, source, sink):
        try:
            while self.open and (data := source.recv(65536)):
                sink.sendall(data)
        except OSError:
            pass
        for end in (source, sink):
            end.close()

    def close(self):
        """Close the port: connections are refused."""
        self.open = False
        self._server.close()


@pytest.fixture(scope="module")
def server():
    """Return the port of an S3 server with a bucket."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    streams = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    process = subprocess.Popen([MOTO, "-H", "127.0.0.1", "-p", str(port)], **streams)
    keys = {"aws_access_key_id": "test", "aws_secret_access_key": "test"}
    url = f"http://127.0.0.1:{port}"
    client = boto3.client("s3", endpoint_url=url, region_name="us-east-1", **keys)
    for _ in range(100):
        try:
            client.create_bucket(Bucket="shells")
            break
        except Exception:
            time.sleep(0.2)
    yield port
    process.terminate()
    process.wait()


@pytest.fixture(scope="module")
def code(tmp_path_factory):
    return copy_code(tmp_path_factory.mktemp("code"))


def begin(code, folder, url, prefix, *arguments):
    program = [sys.executable, "-m", "snakemake", "-s", str(code / "Snakefile"), *arguments]
    program += ["--cores", "2", "--default-storage-prefix", f"s3://shells/{prefix}"]
    program += ["--workflow-profile", str(code / "profiles/s3")]
    own = os.environ | KEY | {"SNAKEMAKE_STORAGE_S3_ENDPOINT_URL": url}
    with (folder / "run.log").open("w") as log:
        streams = {"stdout": log, "stderr": log, "start_new_session": True}
        return subprocess.Popen(program, cwd=folder, env=own, **streams)


WHERE = """
import sys
import snakemake.jobs as jobs
from snakemake.cli import main
from snakemake.io import is_flagged

write = jobs.Job.log_info

def log_info(job, *arguments, **more):
    kept = any(is_flagged(file, "local") for file in [*job.input, *job.output])
    print("place:", "here" if kept else "elsewhere", job.rule.name, flush=True)
    return write(job, *arguments, **more)

jobs.Job.log_info = log_info
main(sys.argv[1:])
"""
"""A dry run runs no job; where it would, Snakemake tells by flags of its files (Job.is_local)."""


def test_no_input_keeps_a_job_here_where_no_files_are_shared(server, code, tmp_path):
    """As in Kubernetes; only what reads files of this machine stays: designs that name some."""
    folder = make_study(tmp_path / "study", DESIGNS.splitlines(keepends=True)[0])
    program = [sys.executable, "-c", WHERE, "-s", str(code / "Snakefile"), "-n", TARGET]
    program += ["--workflow-profile", str(code / "profiles/s3"), "--shared-fs-usage", "none"]
    program += ["--cores", "2", "--default-storage-prefix", "s3://shells/nowhere"]
    own = KEY | {"SNAKEMAKE_STORAGE_S3_ENDPOINT_URL": f"http://127.0.0.1:{server}"}
    done = subprocess.run(
        program, cwd=folder, env=os.environ | own, capture_output=True, text=True, check=True
    )
    places = [line.split()[1] for line in done.stdout.splitlines() if line.startswith("place:")]
    assert len(places) > 8 and set(places) == {"elsewhere"}, done.stdout


def said(folder):
    return (folder / "run.log").read_text()


def wait_for(path, process):
    while not path.exists() and process.poll() is None:
        time.sleep(0.05)
    assert path.exists()


def copies(folder, prefix):
    """Return the results among the local copies of the storage."""
    return folder / f".snakemake/storage/s3/shells/{prefix}"


@pytest.fixture(scope="module")
def here(code, tmp_path_factory):
    """Return the results {name: SHA-256} of a run without a storage, less what is local."""
    folder = make_study(tmp_path_factory.mktemp("here"), THREE)
    done = run(code, folder, *TARGETS)
    assert done.returncode == 0, done.stderr[-3000:]
    return {name: digest for name, digest in results(folder).items() if is_of_study(name)}


def is_of_study(name):
    """Tell whether a result is no copy that is left at the end of a run, and no mark of a table."""
    return name.count("/") > 1 and not name.endswith(("studies/copies.json", "studies/table.txt"))


def fetch_bucket(server, prefix, folder):
    """Fetch the objects below a prefix into a folder."""
    keys = {"aws_access_key_id": "test", "aws_secret_access_key": "test"}
    url = f"http://127.0.0.1:{server}"
    client = boto3.client("s3", endpoint_url=url, region_name="us-east-1", **keys)
    for page in client.get_paginator("list_objects_v2").paginate(Bucket="shells", Prefix=prefix):
        for one in page["Contents"]:
            path = folder / one["Key"].removeprefix(f"{prefix}/")
            path.parent.mkdir(parents=True, exist_ok=True)
            client.download_file("shells", one["Key"], str(path))
    return folder


def finish(code, folder, server, prefix, *arguments):
    """Run to the end; return what was said."""
    url = f"http://127.0.0.1:{server}"
    assert begin(code, folder, url, prefix, *arguments).wait() == 0, said(folder)[-3000:]
    return said(folder)


@pytest.mark.parametrize("loop", ["steps", "whole"])
def test_three_designs_stopped_and_gone_on_with_by_a_new_machine(
    server, code, here, tmp_path, loop
):
    """It has the bucket alone: what is stored is what a run without a storage leaves, records of
    jobs and every iteration, and nothing is to be done again."""
    options = *TARGETS, "--config", f"loop={loop}"
    first = make_study(tmp_path / "first", THREE)
    process = begin(code, first, f"http://127.0.0.1:{server}", loop, *options)
    waits = {"steps": "tiny-dome/sizing/01/thickness.xlsx", "whole": "tiny-arch/design.vtu"}
    wait_for(copies(first, loop) / "results" / waits[loop], process)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    begun = results(fetch_bucket(server, loop, tmp_path / "begun"))
    second = make_study(tmp_path / "second", THREE)
    assert "Nothing to be done" not in finish(code, second, server, loop, *options)
    stored = results(fetch_bucket(server, loop, tmp_path / "bucket"))
    assert {name: digest for name, digest in stored.items() if is_of_study(name)} == here
    assert begun.items() <= stored.items() and "results/tiny-arch/jobs/mesh.json" in begun
    third = make_study(tmp_path / "third", THREE)
    for folder in (second, third):
        assert "Nothing to be done" in finish(code, folder, server, loop, *options)
    assert "every file is as it was made" in finish(code, third, server, loop, "verify")


def test_a_hand_edit_of_a_copy_is_stored_and_redoes_what_follows(server, code, tmp_path):
    """Of a loop in one job, on a machine that has fetched what is there by `verify`."""
    options = TARGET, "--config", "loop=whole"
    one = DESIGNS.splitlines(keepends=True)[0]
    first, second = (make_study(tmp_path / name, one) for name in ("first", "second"))
    finish(code, first, server, "edited", *options)
    finish(code, second, server, "edited", "verify")
    path = copies(second, "edited") / "results/tiny-dome/sizing/01/thickness.xlsx"
    book = openpyxl.load_workbook(path)
    book["thickness"]["D5"].value = 0.123
    book.save(path)
    edited = hashlib.sha256(path.read_bytes()).hexdigest()
    finish(code, second, server, "edited", *options)
    stored = results(fetch_bucket(server, "edited", tmp_path / "bucket"))
    assert stored["results/tiny-dome/sizing/01/thickness.xlsx"] == edited
    assert "Nothing to be done" in finish(code, second, server, "edited", *options)


def test_the_demo(server, code, tmp_path):
    """From the project's own table; a second run has nothing to do."""
    folder = tmp_path / "demo"
    shutil.copytree(REPOSITORY / "config", folder / "config")
    finish(code, folder, server, "demo", "demo")
    stored = results(fetch_bucket(server, "demo", tmp_path / "bucket"))
    assert any(name.endswith("/page.html") for name in stored)
    assert "Nothing to be done" in finish(code, folder, server, "demo", "demo")


def test_a_server_that_goes_away(server, code, tmp_path):
    """The run ends in a sentence; when the server is there again it goes on."""
    folder = make_study(tmp_path / "stored", DESIGNS.splitlines(keepends=True)[0])
    gate = Gate(server)
    process = begin(code, folder, gate.url, "gone", TARGET)
    wait_for(copies(folder, "gone") / "results/tiny-dome/sizing/01/thickness.xlsx", process)
    gate.close()
    assert process.wait() != 0
    last = said(folder).splitlines()[-1]
    assert last.startswith(f"error: the storage of s3://shells/gone, {gate.url}, does not answer")
    begun = (copies(folder, "gone") / "results/tiny-dome/sizing/00/analysis.json").stat()
    shutil.rmtree(folder / ".snakemake/locks", ignore_errors=True)
    again = begin(code, folder, f"http://127.0.0.1:{server}", "gone", TARGET)
    assert again.wait() == 0, said(folder)[-3000:]
    kept = (copies(folder, "gone") / "results/tiny-dome/sizing/00/analysis.json").stat()
    assert kept.st_mtime == begun.st_mtime
