"""The environment that the workflow gives its jobs."""

import os
import platform
from collections.abc import Iterable, MutableMapping
from importlib.metadata import version
from pathlib import Path

from foldshell.files.blas_kernels import name_kernels
from foldshell.files.errors import InputError

ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
"""Jobs run side by side; threads of their own would only wait for each other."""

KEEP_MEMORY = {
    "MALLOC_MMAP_THRESHOLD_": str(4 * 10**9),
    "MALLOC_TRIM_THRESHOLD_": str(4 * 10**9),
    "MALLOC_TOP_PAD_": str(2**26),
    "MALLOC_ARENA_MAX": "1",
}
"""Freed memory is kept for the next array: taking it anew costs a fifth of an analysis (glibc); and
it is taken in large pieces; a second thread takes it from the same heap."""


SMALL_PAGES = {"NUMPY_MADVISE_HUGEPAGE": "0"}
"""The system clears a huge page whole when an array begins to use it: 8 % of a cross-check."""


def choose_cache(environment: MutableMapping[str, str], folder: str | Path) -> None:
    """Let Snakemake keep its cache in `folder` where the home cannot be written: it ends with a
    traceback otherwise, before it reads any Snakefile."""
    if "XDG_CACHE_HOME" in environment:
        return
    home = Path(environment.get("HOME", "/"))
    cache = next(path for path in (home / ".cache", home, *home.parents) if path.exists())
    if not os.access(cache, os.W_OK) or not cache.is_dir():
        environment["XDG_CACHE_HOME"] = str(Path(folder).resolve())


def check_deployment(methods: Iterable[str], installed: bool) -> None:
    """Raise `InputError` for a way to deploy software that has nothing to deploy."""
    methods = set(methods)
    if "apptainer" in methods:
        raise InputError(
            "--sdm apptainer: no container is declared: take --sdm conda, or an environment made "
            "from envs/requirements.lock"
        )
    if "env_modules" in methods:
        raise InputError("--sdm env-modules: no modules are declared: take --sdm conda")
    if "conda" in methods and installed:
        raise InputError(
            "--sdm conda: jobs of an installed foldshell need its own environment: run without "
            "--sdm, or from a checkout"
        )


def prepare_environment(environment: MutableMapping[str, str]) -> None:
    """Set what makes jobs quick, except where a person has set it already.

    Compiled modules are kept in any case: without them each of a thousand jobs compiles the
    library again.
    """
    for name, value in (ONE_THREAD | KEEP_MEMORY | SMALL_PAGES).items():
        environment.setdefault(name, value)
    environment.pop("PYTHONDONTWRITEBYTECODE", None)


def list_versions(packages: Iterable[str]) -> dict[str, str]:
    """Return the versions of Python and of installed packages, by name, and the kernels that the
    BLAS under CHOLMOD runs on this processor: last digits may hang on them."""
    found = {"python": platform.python_version()} | {name: version(name) for name in packages}
    return found | {"kernels of CHOLMOD's BLAS": name_kernels() or "unknown"}
