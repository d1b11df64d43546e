"""CHOLMOD called directly in the shared library of cvxopt's wheel.

`cvxopt.cholmod` builds its matrices from unsorted triplets and solves for one column after the
other, which takes several times as long as the factorisation itself. Its library exports the
functions of CHOLMOD (user guide, chapters 15-18), so numpy's arrays are handed to them through
ctypes. The few settings that matter are written into `cholmod_common`, whose head has kept its
layout since version 1; `open_library` compares the defaults found there with the documented ones
and returns None where anything differs, in which case the caller keeps to cvxopt's own functions.
"""

import ctypes
import struct
import threading
import weakref
from functools import lru_cache

import numpy as np

from foldshell.files.blas_kernels import choose_kernels

COMMON_BYTES = 1 << 16
"""More than any release's cholmod_common, which is about 2.7 kB."""

BLOCK = 4
"""Columns that the kernels of BLAS take at once."""

DEFAULTS = (
    ("3d2Qd", 0, (0.0, 1.2, 1.2, 5, 8, 40.0)),  # dbound, grow0-2, maxrank, supernodal_switch
    ("7i", 48, (1, 1, 1, 0, 1, 1, 0)),  # supernodal, final_asis ... final_resymbol
    ("i", 144, (3,)),  # print
    ("3i", 168, (0, 0, 0)),  # nmethods, current, selected
    ("i", 316, (1,)),  # ordering of the first method: a given one
    ("i", 484, (2,)),  # of the second: minimum degree
    ("i", 1864, (1,)),  # postorder
)
SUPERNODAL_AT, PRINT_AT, NMETHODS_AT, ORDERING_AT, POSTORDER_AT = 48, 144, 168, 316, 1864
ALWAYS_SUPERNODAL, SILENT, FIRST_METHOD_ONLY, NATURAL, AS_IT_IS = 2, 0, 1, 0, 0
"""The matrix as it is numbered: CHOLMOD would copy it twice, a third of a factorisation, to permute
it by the identity. Minimum degree leaves the elimination tree nearly in postorder, so that
supernodes are as large."""


class _Sparse(ctypes.Structure):
    """cholmod_sparse."""

    _fields_ = (
        *((name, ctypes.c_size_t) for name in ("nrow", "ncol", "nzmax")),
        *((name, ctypes.c_void_p) for name in ("p", "i", "nz", "x", "z")),
        *((name, ctypes.c_int) for name in ("stype", "itype", "xtype", "dtype", "sorted")),
        ("packed", ctypes.c_int),
    )  # fmt: skip


class _Dense(ctypes.Structure):
    """cholmod_dense."""

    _fields_ = (
        *((name, ctypes.c_size_t) for name in ("nrow", "ncol", "nzmax", "d")),
        *((name, ctypes.c_void_p) for name in ("x", "z")),
        *((name, ctypes.c_int) for name in ("xtype", "dtype")),
    )


class _FactorHead(ctypes.Structure):
    """The first members of cholmod_factor; `minor` is the column at which K stopped being
    positive definite."""

    _fields_ = (("n", ctypes.c_size_t), ("minor", ctypes.c_size_t), ("perm", ctypes.c_void_p))


class CholmodLibrary:
    """The functions in use, with one workspace for each thread."""

    def __init__(self, library: ctypes.CDLL) -> None:
        pointer = ctypes.c_void_p
        self._own = threading.local()
        for name, result, arguments in (
            ("start", ctypes.c_int, [pointer]),
            ("analyze_p", pointer, [pointer] * 3 + [ctypes.c_size_t, pointer]),
            ("copy_factor", pointer, [pointer] * 2),
            ("factorize", ctypes.c_int, [pointer] * 3),
            ("solve", ctypes.POINTER(_Dense), [ctypes.c_int] + [pointer] * 3),
            ("free_dense", ctypes.c_int, [pointer] * 2),
            ("free_factor", ctypes.c_int, [pointer] * 2),
        ):
            function = getattr(library, f"cholmod_l_{name}")
            function.restype, function.argtypes = result, arguments
            setattr(self, f"_{name}", function)
        self._own.common = self._begin()

    @property
    def _common(self) -> ctypes.Array:
        """The settings and the workspace of this thread."""
        if not hasattr(self._own, "common"):
            self._own.common = self._begin()
        return self._own.common

    def _begin(self) -> ctypes.Array:
        """Return a workspace with the settings in use; raises `OSError` for another layout."""
        common = ctypes.create_string_buffer(COMMON_BYTES)
        if not self._start(common):
            raise OSError("cholmod_l_start")
        for form, offset, expected in DEFAULTS:
            if struct.unpack_from(form, common.raw, offset) != expected:
                raise OSError("cholmod_common has another layout")
        for offset, value in (
            (SUPERNODAL_AT, ALWAYS_SUPERNODAL),
            (PRINT_AT, SILENT),
            (NMETHODS_AT, FIRST_METHOD_ONLY),
            (ORDERING_AT, NATURAL),
            (POSTORDER_AT, AS_IT_IS),
        ):
            struct.pack_into("i", common, offset, value)
        return common

    def analyse(self, indptr: np.ndarray, indices: np.ndarray) -> "CholmodHandle":
        """Analyse the pattern of a lower triangle in the order in which it is numbered.

        indptr (n + 1,) and indices (nnz,) of compressed columns.
        """
        matrix = _lower_triangle(indptr, indices, None)
        factor = self._analyze_p(ctypes.byref(matrix), None, None, 0, self._common)
        return self._handle(factor)

    def factorise(self, symbolic, indptr, indices, values) -> "CholmodHandle":
        """Return the numeric factor of values in a pattern that has been analysed.

        Raises
        ------
        ArithmeticError
            with the row at which the matrix stops being positive definite.
        """
        numeric = self._handle(self._copy_factor(symbolic.address, self._common))
        matrix = _lower_triangle(indptr, indices, values)
        if not self._factorize(ctypes.byref(matrix), numeric.address, self._common):
            raise MemoryError(f"CHOLMOD could not factorise {len(indptr) - 1} freedoms")
        head = _FactorHead.from_address(numeric.address)
        if head.minor < head.n:
            order = (ctypes.c_int64 * head.n).from_address(head.perm)
            raise ArithmeticError(int(order[head.minor]))
        return numeric

    def solve(
        self,
        numeric: "CholmodHandle",
        right_hand_sides: np.ndarray,
        into: np.ndarray | None = None,
    ) -> np.ndarray:
        """Return K^-1 B for B (size, k), all columns at once, in an array of its own or `into` one.

        B in kN and kNm, the result in m and rad.
        """
        rows, columns = right_hand_sides.shape
        block = np.asfortranarray(right_hand_sides, dtype=float)
        if into is None:
            block = _fill_up(block)
        filled = block.shape[1]
        dense = _Dense(rows, filled, block.size, rows, block.ctypes.data, None, 1, 0)
        answer = self._solve(0, numeric.address, ctypes.byref(dense), self._common)
        if not answer:
            raise MemoryError(f"CHOLMOD could not solve for {columns} right-hand sides")
        values = ctypes.cast(answer.contents.x, ctypes.POINTER(ctypes.c_double))
        result = np.ctypeslib.as_array(values, (filled, rows))[:columns].T
        if into is None:
            result = result.copy(order="F")
        else:
            into[:] = result
        self._free_dense(ctypes.byref(answer), self._common)
        return result if into is None else into

    def _handle(self, address: int | None) -> "CholmodHandle":
        if not address:
            raise MemoryError("CHOLMOD is out of memory")
        handle = CholmodHandle(address)
        weakref.finalize(handle, self._release, address)
        return handle

    def _release(self, address: int) -> None:
        self._free_factor(ctypes.byref(ctypes.c_void_p(address)), self._common)


class CholmodHandle:
    """The address of a cholmod_factor, freed with this object."""

    def __init__(self, address: int) -> None:
        self.address = address


@lru_cache(maxsize=1)
def open_library() -> CholmodLibrary | None:
    """Open cvxopt's CHOLMOD; None if it is missing or laid out differently."""
    try:
        from cvxopt import cholmod

        choose_kernels()
        return CholmodLibrary(ctypes.CDLL(cholmod.__file__))
    except (ImportError, OSError, AttributeError):
        return None


def _fill_up(block: np.ndarray) -> np.ndarray:
    """Return columns (size, k) with columns of zeros up to whole blocks of kernels.

    Eight columns take less time than seven.
    """
    rows, columns = block.shape
    if columns < BLOCK or columns % BLOCK == 0:
        return block
    full = np.zeros((rows, -(-columns // BLOCK) * BLOCK), order="F")
    full[:, :columns] = block
    return full


def _lower_triangle(indptr, indices, values: np.ndarray | None) -> _Sparse:
    """Describe compressed columns (int64, rows ascending) without copying them."""
    size = len(indptr) - 1
    address = None if values is None else values.ctypes.data
    kind = 0 if values is None else 1
    return _Sparse(
        size, size, len(indices), indptr.ctypes.data, indices.ctypes.data, None, address, None,
        -1, 2, kind, 0, 1, 1,
    )  # fmt: skip
