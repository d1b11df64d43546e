"""What made a report: time, version, commit, packages, kind of machine; no name of a host."""

import os
import platform
import subprocess
import time
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from foldshell.files.blas_kernels import name_kernels

PACKAGES = ("snakemake", "numpy", "scipy", "cvxopt", "vtk", "meshio", "XlsxWriter", "openpyxl",
            "pillow", "matplotlib", "Jinja2")  # fmt: skip


@dataclass(frozen=True)
class Provenance:
    """`commit` is empty outside a clone; `machine` holds words by name."""

    made: str
    commit: str
    versions: dict[str, str]
    machine: dict[str, str]


def find_provenance(project: str | Path) -> Provenance:
    """Return what makes a report now, from the project's folder.

    Where the environment holds a SOURCE_DATE_EPOCH (s since 1970; reproducible-builds.org), that is
    taken for now, so that reports made at other minutes have the same bytes.
    """
    versions = {"Python": platform.python_version()}
    for name in PACKAGES:
        try:
            versions[name] = version(name)
        except PackageNotFoundError:
            continue
    fixed = os.environ.get("SOURCE_DATE_EPOCH", "")
    now = time.gmtime(int(fixed) if fixed.isdecimal() else None)
    made = time.strftime("%d %B %Y, %H:%M UTC", now)
    return Provenance(made, describe_commit(project), versions, describe_machine())


def describe_commit(project: str | Path) -> str:
    """Return the commit of a clone, and whether files were changed since; empty outside one."""
    commit = _git(project, "rev-parse", "HEAD")
    changed = _git(project, "status", "--porcelain", "--untracked-files=no") if commit else ""
    return f"{commit} with changed files" if changed else commit


def _git(project: str | Path, *words: str) -> str:
    command = ["git", "-C", str(project), *words]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=20)
    except (OSError, subprocess.SubprocessError):
        return ""
    return done.stdout.strip()


def describe_machine() -> dict[str, str]:
    """Return processor, cores, memory, system and BLAS kernels, as far as they are known."""
    machine = {"processor": _processor(), "cores": str(os.cpu_count() or "")}
    try:
        memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
        machine["memory"] = f"{memory / 2**30:.0f} GiB"
    except (AttributeError, ValueError, OSError):
        pass
    machine["system"] = f"{platform.system()} {platform.release()}".strip()
    machine["kernels of CHOLMOD's BLAS"] = name_kernels()
    return {name: words for name, words in machine.items() if words}


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    named = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(named, platform.machine())
