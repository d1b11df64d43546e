"""What every analysis needs, got ready at import: tables, the solver's library, memory.

The fork server imports this once, so that its jobs find it in memory: 10 ms less an analysis.
"""

import contextlib
import ctypes

from foldshell.shell.cholmod_library import open_library
from foldshell.shell.geometric import geometric_tables
from foldshell.shell.reference import reference_triangle

ORDERS = (5, 7)
"""Of the mesh that the study sizes on (four subdivisions), and of the one that gives its error."""

TRIM_THRESHOLD, TOP_PAD, MMAP_THRESHOLD = -1, -2, -3
"""Numbers of the parameters of glibc's `mallopt`."""

KEPT_BYTES, PAD_BYTES = 2**31 - 1, 2**26


def keep_freed_memory() -> None:
    """Let the C library keep what arrays give back: to ask for it anew costs a fault a page.

    Nothing happens where it has no such function.
    """
    with contextlib.suppress(OSError, AttributeError):
        library = ctypes.CDLL(None)
        for parameter, value in (
            (MMAP_THRESHOLD, KEPT_BYTES),
            (TRIM_THRESHOLD, KEPT_BYTES),
            (TOP_PAD, PAD_BYTES),
        ):
            library.mallopt(parameter, value)


for order in ORDERS:
    reference_triangle(order)
    geometric_tables(order)
open_library()
keep_freed_memory()
