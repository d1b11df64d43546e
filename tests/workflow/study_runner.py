"""Run a tiny study by Snakemake in a folder of its own."""

import hashlib
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import yaml

REPOSITORY = Path(__file__).parents[2]
TARGET = "results/studies/tiny/summary.csv"
HEADER = "design\tsurface\tspan_m\theight_m\tzigzag\tstrip\tsupport\ttags\n"
DESIGNS = (
    "tiny-dome\tparaboloid\t8\t2\t5\t6\tall\ttiny\ntiny-saddle\thypar\t8\t2\t5\t6\tstrip\ttiny\n"
)
SETTINGS = {
    "study": "tiny",
    "analysis": {"subdivisions": 1},
    "sizing": {"iterations_max": 4, "start_thickness_mm": 80, "least_thickness_mm": 20},
    "crosscheck": {"subdivisions": [1, 2]},
}


def make_study(folder: Path, designs: str = DESIGNS, settings: dict | None = None) -> Path:
    """Write config/ of a tiny study: the project's settings with small numbers put in."""
    text = (REPOSITORY / "config/config.yaml").read_text()
    config = yaml.safe_load(text)
    for key, value in (SETTINGS | (settings or {})).items():
        config[key] = {**config[key], **value} if isinstance(value, dict) else value
    (folder / "config").mkdir(parents=True)
    (folder / "config/config.yaml").write_text(yaml.safe_dump(config, sort_keys=False))
    (folder / "config/designs.tsv").write_text(HEADER + designs)
    return folder


def change_setting(folder: Path, group: str, name: str, value) -> None:
    """Set `group.name` in the config.yaml of a study."""
    path = folder / "config/config.yaml"
    config = yaml.safe_load(path.read_text())
    config[group][name] = value
    path.write_text(yaml.safe_dump(config, sort_keys=False))


def copy_code(folder: Path) -> Path:
    """Copy the workflow, so that an edit of the project during a test does not disturb it."""
    for name in ("scripts", "rules", "envs", "profiles", "docs/report"):
        ignore = shutil.ignore_patterns("__pycache__")
        shutil.copytree(REPOSITORY / name, folder / name, ignore=ignore)
    shutil.copytree(REPOSITORY / "config", folder / "config")
    for name in ("Snakefile", "tests/verification/README.md"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(REPOSITORY / name, folder / name)
    return folder


def command(code: Path, *arguments: str) -> list[str]:
    """Return the command line of a run in the current folder."""
    program = [sys.executable, "-m", "snakemake", "-s", str(code / "Snakefile")]
    profile = ["--workflow-profile", str(code / "profiles/default")]
    return [*program, *profile, "--cores", "2", *arguments]


def run(code: Path, folder: Path, *arguments: str):
    """Run Snakemake to its end; return the finished process with its output as text."""
    return subprocess.run(command(code, *arguments), cwd=folder, capture_output=True, text=True)


def start(code: Path, folder: Path, *arguments: str) -> subprocess.Popen:
    """Start Snakemake as the head of a process group of its own; its output goes nowhere."""
    return subprocess.Popen(
        command(code, *arguments),
        cwd=folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )


def run_and_kill(code: Path, folder: Path, until: Path, *arguments: str) -> None:
    """Start Snakemake and kill it with all its jobs, by signal 9, once a file appears."""
    process = start(code, folder, *arguments)
    while not until.exists() and process.poll() is None:
        time.sleep(0.02)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def run_until_files(code: Path, folder: Path, more: int, wait: float, *arguments: str):
    """Start Snakemake and return its process once it has written `more` files, `wait` s later.

    Files count while they are being written too, so that a kill may hit a job in the middle.
    """
    process = start(code, folder, *arguments)
    aim = count_files(folder) + more
    while count_files(folder) < aim and process.poll() is None:
        time.sleep(0.02)
    time.sleep(wait)
    return process


def count_files(folder: Path) -> int:
    """Return the number of files under results."""
    return sum(len(files) for _, _, files in os.walk(folder / "results"))


def find_jobs(process: subprocess.Popen) -> list[int]:
    """Return the ids of the job processes of a running Snakemake: forks of the fork server."""
    listed = subprocess.run(
        ["ps", "-ww", "-o", "pid=,ppid=,args=", "--sid", str(process.pid)],
        capture_output=True,
        text=True,
    )
    lines = [line.split(maxsplit=2) for line in listed.stdout.splitlines()]
    servers = {
        pid: parent for pid, parent, words in lines if "/foldshell/engine/fork_server.py" in words
    }
    return [int(pid) for pid, parent in servers.items() if parent in servers]


def hashes(folder: Path, pattern: str) -> dict[str, str]:
    """Return {relative path: SHA-256} of the files that match a pattern below a folder."""
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.glob(pattern))
    }


def times(folder: Path, pattern: str) -> dict[str, int]:
    """Return {relative path: modification time in ns}."""
    return {
        str(path.relative_to(folder)): path.stat().st_mtime_ns
        for path in sorted(folder.glob(pattern))
    }


def results(folder: Path) -> dict[str, str]:
    """Return {relative path: SHA-256} of all results, less seconds, benchmarks and logs."""
    found = {}
    for path in sorted((folder / "results").rglob("*")):
        times = path.name == "seconds.json" or {"benchmarks", "logs"} & set(path.parts)
        if path.is_file() and not times:
            digest = hashlib.sha256(path.read_bytes()).hexdigest()
            found[str(path.relative_to(folder))] = digest
    return found
