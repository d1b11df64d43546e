"""One interface to sparse symmetric factorisations; the symbolic part is kept for a geometry."""

import weakref
from typing import Any, Protocol

import numpy as np

from foldshell.files.threads import LARGE, count_threads, run_parts
from foldshell.shell.assembly import LowerPattern
from foldshell.shell.cholmod_library import open_library


class NotPositiveDefiniteError(ArithmeticError):
    """The stiffness has a mechanism or has lost its stability.

    `dof` is the degree of freedom, among the free ones, at which that shows.
    """

    def __init__(self, dof: int) -> None:
        super().__init__(f"the stiffness matrix is not positive definite at freedom {dof}")
        self.dof = dof


class Factor(Protocol):
    """A factorised symmetric matrix."""

    def refactor(self, values: np.ndarray) -> None:
        """Factorise new values of the same pattern; raises `NotPositiveDefiniteError`.

        values (nnz,) in kN/m, kN and kNm.
        """

    def solve(self, right_hand_sides: np.ndarray) -> np.ndarray:
        """Return K^-1 B for B (size, k). B in kN and kNm, the result in m and rad."""


_ANALYSED: "weakref.WeakKeyDictionary[LowerPattern, Any]" = weakref.WeakKeyDictionary()


class CholmodFactor:
    """Supernodal Cholesky by CHOLMOD, from the wheel of cvxopt (Chen et al. 2008)."""

    def __init__(self, pattern: LowerPattern, values: np.ndarray) -> None:
        self._library = open_library()
        self._pattern = pattern
        if pattern not in _ANALYSED:
            _ANALYSED[pattern] = self._library.analyse(pattern.indptr, pattern.indices)
        self.refactor(values)

    def refactor(self, values: np.ndarray) -> None:
        """Factorise new values of the same pattern. values (nnz,) in kN/m, kN and kNm."""
        pattern = self._pattern
        try:
            self._factor = self._library.factorise(
                _ANALYSED[pattern], pattern.indptr, pattern.indices, values
            )
        except ArithmeticError as error:
            raise NotPositiveDefiniteError(error.args[0]) from None

    def solve(self, right_hand_sides: np.ndarray) -> np.ndarray:
        """Return K^-1 B for B (size, k). B in kN and kNm, the result in m and rad."""
        count = right_hand_sides.shape[1]
        if len(right_hand_sides) < LARGE or count < 3:
            return self._library.solve(self._factor, right_hand_sides)
        # an even number of columns, which two threads share evenly: others end in other kernels
        block = np.zeros((len(right_hand_sides), count + count % 2), order="F")
        block[:, :count] = right_hand_sides
        middle = (block.shape[1] + 2) // 4 * 2
        parts = [slice(0, middle), slice(middle, None)] if count_threads() > 1 else [slice(None)]

        def solve(part: slice) -> None:
            """Replace some columns of the block by their solutions."""
            self._library.solve(self._factor, block[:, part], into=block[:, part])

        list(run_parts(solve, parts))
        return block[:, :count]


class CvxoptFactor:
    """The same by the functions of cvxopt: slower, where its library cannot be called directly."""

    def __init__(self, pattern: LowerPattern, values: np.ndarray) -> None:
        from cvxopt import cholmod, matrix, spmatrix

        cholmod.options["supernodal"] = 2
        cholmod.options["print"] = -1
        self._cholmod, self._matrix = cholmod, matrix
        columns = np.repeat(np.arange(pattern.size), np.diff(pattern.indptr))
        size = (pattern.size, pattern.size)
        self._lower = spmatrix(matrix(values), pattern.indices, columns, size)
        self._factor = cholmod.symbolic(self._lower, matrix(np.arange(pattern.size)))
        self.refactor(values)

    def refactor(self, values: np.ndarray) -> None:
        """Factorise new values of the same pattern. values (nnz,) in kN/m, kN and kNm."""
        self._lower.V = self._matrix(values)
        try:
            self._cholmod.numeric(self._lower, self._factor)
        except ArithmeticError as error:
            raise NotPositiveDefiniteError(int(error.args[0])) from None

    def solve(self, right_hand_sides: np.ndarray) -> np.ndarray:
        """Return K^-1 B for B (size, k). B in kN and kNm, the result in m and rad."""
        block = self._matrix(np.asfortranarray(right_hand_sides, dtype=float))
        self._cholmod.solve(self._factor, block)
        return np.array(block).reshape(right_hand_sides.shape)


class SuperLuFactor:
    """LU by scipy's SuperLU with a symmetric ordering: slower, but always at hand."""

    def __init__(self, pattern: LowerPattern, values: np.ndarray) -> None:
        self._pattern = pattern
        self.refactor(values)

    def refactor(self, values: np.ndarray) -> None:
        """Factorise new values of the same pattern. values (nnz,) in kN/m, kN and kNm."""
        from scipy.sparse import csc_array, tril
        from scipy.sparse.linalg import splu

        size = self._pattern.size
        lower = csc_array((values, self._pattern.indices, self._pattern.indptr), (size, size))
        full = (lower + tril(lower, -1).T).tocsc()
        try:
            self._lu = splu(
                full,
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except RuntimeError:
            diagonal = full.diagonal()
            raise NotPositiveDefiniteError(int(np.argmin(diagonal))) from None
        pivots = self._lu.U.diagonal()
        worst = int(np.argmin(pivots / np.abs(full.diagonal()[self._lu.perm_c.argsort()])))
        if pivots[worst] <= 0:
            raise NotPositiveDefiniteError(int(self._lu.perm_c.argsort()[worst]))

    def solve(self, right_hand_sides: np.ndarray) -> np.ndarray:
        """Return K^-1 B for B (size, k). B in kN and kNm, the result in m and rad."""
        return self._lu.solve(np.ascontiguousarray(right_hand_sides))


def _open_cholmod(pattern: LowerPattern, values: np.ndarray) -> Factor:
    """Return the fastest Cholesky factor that is at hand."""
    if open_library() is not None:
        return CholmodFactor(pattern, values)
    try:
        return CvxoptFactor(pattern, values)
    except ImportError:
        return SuperLuFactor(pattern, values)


SOLVERS = {"cholmod": _open_cholmod, "superlu": SuperLuFactor}


def factorise(pattern: LowerPattern, values: np.ndarray, solver: str = "cholmod") -> Factor:
    """Factorise K, given by the nonzeros of its lower triangle.

    Raises
    ------
    NotPositiveDefiniteError
        for a mechanism or an unstable structure.
    KeyError
        for an unknown solver.

    values (nnz,) in kN/m, kN and kNm.
    """
    return SOLVERS[solver](pattern, values)
