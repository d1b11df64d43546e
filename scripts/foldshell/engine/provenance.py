"""Which program made a result: Python, packages, commit of the workflow."""

import platform
import subprocess
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

PACKAGES = ("foldshell", "numpy", "scipy", "cvxopt", "snakemake", "openpyxl", "XlsxWriter")


def find_versions(code: str | Path) -> dict[str, str]:
    """Return versions of Python, the program and its packages, and the commit of the workflow."""
    found = {"python": platform.python_version()}
    for name in PACKAGES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found | {"commit": find_commit(code)}


def find_commit(code: str | Path) -> str:
    """Return the commit of a checkout, with `-dirty` where files differ from it; else unknown."""
    words = ["git", "-C", str(code), "describe", "--always", "--abbrev=40", "--dirty", "--match="]
    try:
        done = subprocess.run(words, capture_output=True, text=True, timeout=20)
    except (OSError, subprocess.TimeoutExpired):
        return "unknown"
    return done.stdout.strip() or "unknown"
