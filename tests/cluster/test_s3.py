"""Results in an S3 server of this machine: stopped, gone on with, and a server that goes away."""

import os
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

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


def said(folder):
    return (folder / "run.log").read_text()


def wait_for(path, process):
    while not path.exists() and process.poll() is None:
        time.sleep(0.05)
    assert path.exists()


def copies(folder, prefix):
    """Return the results among the local copies of the storage."""
    return folder / f".snakemake/storage/s3/shells/{prefix}"


def test_three_designs_stopped_and_gone_on_with(server, code, tmp_path):
    """The files are those of a run without a storage."""
    url = f"http://127.0.0.1:{server}"
    folder = make_study(tmp_path / "stored", THREE)
    process = begin(code, folder, url, "three", TARGET)
    wait_for(copies(folder, "three") / "results/tiny-dome/sizing/01/thickness.xlsx", process)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    shutil.rmtree(folder / ".snakemake/locks", ignore_errors=True)
    assert begin(code, folder, url, "three", TARGET).wait() == 0, said(folder)[-3000:]
    assert begin(code, folder, url, "three", TARGET).wait() == 0
    assert "Nothing to be done" in said(folder)
    here = make_study(tmp_path / "here", THREE)
    assert run(code, here, TARGET).returncode == 0
    own = {name: digest for name, digest in results(here).items() if "copies.json" not in name}
    stored = results(copies(folder, "three"))
    shared = own.keys() & stored.keys()
    assert len(shared) > 100 and {n: own[n] for n in shared} == {n: stored[n] for n in shared}


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
