"""One interface to sparse symmetric factorisations; the ordering is kept for a geometry."""

from typing import Protocol

import numpy as np

from foldshell.shell.assembly import LowerPattern
from foldshell.shell.cholmod_block import open_block_solver


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
        """Factorise new values of the same pattern; raises `NotPositiveDefiniteError`."""

    def solve(self, right_hand_sides: np.ndarray) -> np.ndarray:
        """Return K^-1 B for B (size, k)."""


class CholmodFactor:
    """Supernodal Cholesky by CHOLMOD, from the wheel of cvxopt (Chen et al. 2008)."""

    def __init__(self, pattern: LowerPattern, values: np.ndarray) -> None:
        from cvxopt import cholmod, matrix, spmatrix

        cholmod.options["supernodal"] = 2
        cholmod.options["print"] = -1
        self._cholmod, self._matrix = cholmod, matrix
        columns = np.repeat(np.arange(pattern.size), np.diff(pattern.indptr))
        size = (pattern.size, pattern.size)
        self._lower = spmatrix(matrix(values), pattern.indices, columns, size)
        self._factor = cholmod.symbolic(self._lower)
        self._block_solve = open_block_solver(self._factor)
        self._numeric()

    def refactor(self, values: np.ndarray) -> None:
        self._lower.V = self._matrix(values)
        self._numeric()

    def solve(self, right_hand_sides: np.ndarray) -> np.ndarray:
        if self._block_solve is not None:
            return self._block_solve(right_hand_sides)
        block = self._matrix(np.asfortranarray(right_hand_sides, dtype=float))
        self._cholmod.solve(self._factor, block)
        return np.array(block).reshape(right_hand_sides.shape)

    def _numeric(self) -> None:
        try:
            self._cholmod.numeric(self._lower, self._factor)
        except ArithmeticError as error:
            raise NotPositiveDefiniteError(int(error.args[0])) from None


class SuperLuFactor:
    """LU by scipy's SuperLU with a symmetric ordering: slower, but always at hand."""

    def __init__(self, pattern: LowerPattern, values: np.ndarray) -> None:
        self._pattern = pattern
        self.refactor(values)

    def refactor(self, values: np.ndarray) -> None:
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
        return self._lu.solve(np.ascontiguousarray(right_hand_sides))


SOLVERS = {"cholmod": CholmodFactor, "superlu": SuperLuFactor}


def factorise(pattern: LowerPattern, values: np.ndarray, solver: str = "cholmod") -> Factor:
    """Factorise K, given by the nonzeros of its lower triangle.

    Raises
    ------
    NotPositiveDefiniteError
        for a mechanism or an unstable structure.
    KeyError
        for an unknown solver.
    """
    return SOLVERS[solver](pattern, values)
