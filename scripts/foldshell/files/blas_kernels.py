"""Which kernels the BLAS under CHOLMOD runs, and faster ones where it knows no better.

The wheel of cvxopt carries an OpenBLAS that tells processors apart by a list of their models. One
that is newer than the list gets kernels of the year 2004 (`Prescott`), whatever it can do. Where
that has happened, and only there, the kernels are chosen by the flags of the processor: OpenBLAS
takes them by name from the environment (OPENBLAS_CORETYPE) when its tables are set up, which
its functions `gotoblas_dynamic_quit` and `gotoblas_dynamic_init` do anew.
"""

import contextlib
import ctypes
import os
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path

CORE = "OPENBLAS_CORETYPE"

SLOW = ("Katmai", "Coppermine", "Northwood", "Prescott", "Banias", "Core2", "Penryn", "Nehalem",
        "Generic")  # fmt: skip
"""Kernels without AVX."""

FAST = (
    ("SkylakeX", {"avx512f", "avx512dq", "avx512bw", "avx512vl", "avx512cd"}),
    ("Haswell", {"avx2", "fma"}),
    ("Sandybridge", {"avx"}),
)
"""Kernels by the flags that they need, the fastest first; an instruction that a processor does not
know ends the program."""


def choose_kernels() -> None:
    """Give the BLAS under CHOLMOD the kernels of the processor where it fell back to slow ones.

    Nothing happens where a person has chosen (OPENBLAS_CORETYPE), or where the library is another.
    """
    library = _open_blas()
    if library is None or CORE in os.environ or _read_core(library) not in SLOW:
        return
    best = find_best_kernels(read_flags())
    if best is None or not hasattr(library, "gotoblas_dynamic_quit"):
        return
    os.environ[CORE] = best
    try:
        library.gotoblas_dynamic_quit()
        library.gotoblas_dynamic_init()
    finally:
        del os.environ[CORE]


def name_kernels() -> str:
    """Return the name of the kernels in use, as OpenBLAS calls them; empty where not known."""
    with contextlib.suppress(ImportError):
        import cvxopt.cholmod  # noqa: F401 - its libraries are found once it is loaded
    choose_kernels()
    library = _open_blas()
    return "" if library is None else _read_core(library)


def is_slow(kernels: str, flags: set[str]) -> bool:
    """Tell whether kernels are slow ones on a processor that has fast ones."""
    return kernels in SLOW and find_best_kernels(flags) is not None


def find_best_kernels(flags: set[str]) -> str | None:
    """Return the fastest kernels that a processor with these flags can run, None for none."""
    return next((name for name, needed in FAST if needed <= flags), None)


def read_flags(path: str | Path = "/proc/cpuinfo") -> set[str]:
    """Return the flags that the system names of the first processor, none where it does not."""
    try:
        lines = Path(path).read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return set()
    return set(
        next((one.partition(":")[2] for one in lines if one.startswith("flags")), "").split()
    )


@lru_cache(maxsize=1)
def _open_blas() -> ctypes.CDLL | None:
    """Open the OpenBLAS of cvxopt's wheel, which is in the process already once CHOLMOD is."""
    spec = find_spec("cvxopt")
    if spec is None or spec.origin is None:
        return None
    package = Path(spec.origin).parent
    folders = package.parent / "cvxopt.libs", package / ".dylibs", package / ".libs"
    for path in sorted(path for folder in folders for path in folder.glob("*openblas*")):
        try:
            library = ctypes.CDLL(str(path))
            library.openblas_get_corename.restype = ctypes.c_char_p
        except (OSError, AttributeError):
            continue
        return library
    return None


def _read_core(library: ctypes.CDLL) -> str:
    return library.openblas_get_corename().decode("ascii", "replace")
