"""Sparse normal equations with one symbolic pattern for the whole solution."""

from collections.abc import Sequence

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from foldshell.files.blas_kernels import choose_kernels

try:
    from cvxopt import cholmod, matrix, spmatrix
except ImportError:  # the fallback is slower, not less exact
    cholmod = None

Rows = Sequence[tuple[np.ndarray, np.ndarray]]  # residual (m,), values (m, k) of each term


class NotPositiveDefinite(ArithmeticError):
    """The damped normal matrix could not be factorised."""


class NormalEquations:
    """A = sum_r J_r^T J_r, from the Jacobian rows of several terms.

    Where each product of two entries of a row goes in A is found once; afterwards assembling
    is one `bincount`. Only the lower triangle is kept, in compressed columns.
    """

    def __init__(self, columns: Sequence[np.ndarray], unknowns: int, solver: str = "") -> None:
        self.columns = [np.ascontiguousarray(c) for c in columns]
        self.unknowns = unknowns
        self.solver = solver or ("cholmod" if cholmod else "superlu")
        self._pairs = [np.tril_indices(c.shape[1]) for c in self.columns]
        keys = [self._keys(c, p) for c, p in zip(self.columns, self._pairs, strict=True)]
        diagonal = np.arange(unknowns, dtype=np.int64) * (unknowns + 1)
        self._entries, place = np.unique(np.concatenate([*keys, diagonal]), return_inverse=True)
        self._place = place[: len(place) - unknowns]
        self._diagonal = place[len(place) - unknowns :]
        self.column_of, self.row_of = np.divmod(self._entries, unknowns)
        self._factor = None
        if self.solver == "cholmod":
            self._prepare_cholmod()

    def _keys(self, columns: np.ndarray, pairs: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
        one, two = columns[:, pairs[0]], columns[:, pairs[1]]
        low, high = np.minimum(one, two).astype(np.int64), np.maximum(one, two)
        return (low * self.unknowns + high).ravel()

    def _prepare_cholmod(self) -> None:
        choose_kernels()
        rows, columns = (matrix(k.astype(np.int64)) for k in (self.row_of, self.column_of))
        # The diagonal makes the pattern factorisable; its values come later.
        values = np.where(self.row_of == self.column_of, 1.0, 1e-300)
        self._matrix = spmatrix(matrix(values), rows, columns, (self.unknowns,) * 2)
        self._factor = cholmod.symbolic(self._matrix)

    def assemble(self, rows: Rows) -> tuple[np.ndarray, np.ndarray]:
        """Values (nnz,) of the lower triangle of J^T J, and the gradient J^T r (n,).

        Units are those of the unknowns: cost/m2 and cost/m.
        """
        products, gradient = [], np.zeros(self.unknowns)
        for columns, pairs, (residual, values) in zip(self.columns, self._pairs, rows, strict=True):
            products.append((values[:, pairs[0]] * values[:, pairs[1]]).ravel())
            weighted = (values * residual[:, None]).ravel()
            gradient += np.bincount(columns.ravel(), weighted, self.unknowns)
        total = np.bincount(self._place, np.concatenate(products), len(self._entries))
        return total, gradient

    def diagonal(self, values: np.ndarray) -> np.ndarray:
        """Diagonal (n,) of A. In the unit of its values (nnz,)."""
        return values[self._diagonal]

    def solve(self, values: np.ndarray, shift: np.ndarray, right: np.ndarray) -> np.ndarray:
        """x of (A + diag(shift)) x = right; NotPositiveDefinite when it cannot be factorised.

        values (nnz,), shift, right and x (n,), in the units of A and J^T r.
        """
        shifted = values.copy()
        shifted[self._diagonal] += shift
        if self.solver == "cholmod":
            return self._solve_cholmod(shifted, right)
        return self._solve_superlu(shifted, right)

    def _solve_cholmod(self, values: np.ndarray, right: np.ndarray) -> np.ndarray:
        self._matrix.V = matrix(values)
        solution = matrix(right)
        try:
            cholmod.numeric(self._matrix, self._factor)
            cholmod.solve(self._factor, solution)
        except ArithmeticError as error:
            raise NotPositiveDefinite(str(error)) from None
        return np.array(solution).ravel()

    def _solve_superlu(self, values: np.ndarray, right: np.ndarray) -> np.ndarray:
        shape = (self.unknowns, self.unknowns)
        lower = sparse.coo_matrix((values, (self.row_of, self.column_of)), shape)
        strict = sparse.tril(lower, -1)
        try:
            factor = splu(
                (lower + strict.T).tocsc(),
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except RuntimeError as error:
            raise NotPositiveDefinite(str(error)) from None
        return factor.solve(right)
