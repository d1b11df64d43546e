"""Solve with a CHOLMOD factor for many right-hand sides at once.

`cvxopt.cholmod.solve` hands CHOLMOD one column after the other, which is four times slower than
one call of `cholmod_l_solve` for eight columns. The factor lies in a capsule and the function in
the same shared library, so the call is made through ctypes (CHOLMOD user guide, chapter 16). Where
the library is laid out differently, `open_block_solver` returns None and the caller keeps to
cvxopt's own solve.
"""

import ctypes
from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np

COMMON_BYTES = 1 << 16
"""More than any release's cholmod_common, which is about 2.7 kB."""

CAPSULE_NAME = b"CHOLMOD FACTOR D L"
"""What cvxopt calls a real factor with lower storage."""


class _Dense(ctypes.Structure):
    """cholmod_dense."""

    _fields_ = (
        ("nrow", ctypes.c_size_t),
        ("ncol", ctypes.c_size_t),
        ("nzmax", ctypes.c_size_t),
        ("d", ctypes.c_size_t),
        ("x", ctypes.c_void_p),
        ("z", ctypes.c_void_p),
        ("xtype", ctypes.c_int),
        ("dtype", ctypes.c_int),
    )


@lru_cache(maxsize=1)
def _load_library() -> tuple[ctypes.CDLL, Any] | None:
    """Open CHOLMOD and start a workspace for it; None if its functions are not found."""
    from cvxopt import cholmod

    try:
        library = ctypes.CDLL(cholmod.__file__)
        start, solve, free = (
            library.cholmod_l_start,
            library.cholmod_l_solve,
            library.cholmod_l_free_dense,
        )
    except (OSError, AttributeError):
        return None
    start.argtypes = [ctypes.c_void_p]
    solve.argtypes = [ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p]
    solve.restype = ctypes.POINTER(_Dense)
    free.argtypes = [ctypes.c_void_p, ctypes.c_void_p]
    common = ctypes.create_string_buffer(COMMON_BYTES)
    return (library, common) if start(common) else None


def open_block_solver(factor: Any) -> Callable[[np.ndarray], np.ndarray] | None:
    """Return a function B (size, k) -> K^-1 B for a capsule of `cvxopt.cholmod`, or None."""
    loaded, pointer = _load_library(), _factor_pointer(factor)
    if loaded is None or pointer is None:
        return None
    library, common = loaded

    def solve(right_hand_sides: np.ndarray) -> np.ndarray:
        block = np.asfortranarray(right_hand_sides, dtype=float)
        rows, columns = block.shape
        dense = _Dense(rows, columns, block.size, rows, block.ctypes.data, None, 1, 0)
        answer = library.cholmod_l_solve(0, pointer, ctypes.byref(dense), common)
        if not answer:
            raise MemoryError(f"CHOLMOD could not solve for {columns} right-hand sides")
        values = ctypes.cast(answer.contents.x, ctypes.POINTER(ctypes.c_double))
        result = np.ctypeslib.as_array(values, (columns, rows)).T.copy(order="F")
        library.cholmod_l_free_dense(ctypes.byref(answer), common)
        return result

    return solve


def _factor_pointer(factor: Any) -> int | None:
    """Return the address of the cholmod_factor in a capsule, or None for another object."""
    name_of = ctypes.pythonapi.PyCapsule_GetName
    name_of.restype, name_of.argtypes = ctypes.c_char_p, [ctypes.py_object]
    pointer_of = ctypes.pythonapi.PyCapsule_GetPointer
    pointer_of.restype = ctypes.c_void_p
    pointer_of.argtypes = [ctypes.py_object, ctypes.c_char_p]
    try:
        name = name_of(factor)
        return pointer_of(factor, name) if name == CAPSULE_NAME else None
    except (ValueError, TypeError):
        return None
