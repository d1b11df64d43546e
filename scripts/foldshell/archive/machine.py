"""The machine that made the results: what may decide digits and times, and no name of it."""

import os
import platform
from importlib.metadata import distributions
from pathlib import Path

from foldshell.files.blas_kernels import name_kernels


def describe_machine() -> dict[str, object]:
    """Return processor, cores, memory (MB), system, kernels of the BLAS under CHOLMOD, and versions
    of all installed packages."""
    return {
        "processor": _read_field("/proc/cpuinfo", "model name") or platform.processor(),
        "architecture": platform.machine(),
        "cores": os.cpu_count(),
        "memory_mb": _memory_mb(),
        "system": f"{platform.system()} {platform.release()}",
        "blas_kernels": name_kernels(),
        "libc": " ".join(platform.libc_ver()),
        "python": platform.python_version(),
        "packages": {
            name: version
            for name, version in sorted(
                (str(item.metadata["Name"]), item.version) for item in distributions()
            )
        },
    }


def _memory_mb() -> int | None:
    words = (_read_field("/proc/meminfo", "MemTotal") or "").split()
    return int(words[0]) // 1024 if words and words[0].isdigit() else None


def _read_field(path: str, name: str) -> str | None:
    try:
        lines = Path(path).read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return None
    return next((line.partition(":")[2].strip() for line in lines if line.startswith(name)), None)
