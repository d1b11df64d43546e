"""Where a stiffness that is not positive definite gives way: its near-null vector."""

from collections.abc import Callable

import numpy as np

from foldshell.shell.assembly import LowerPattern
from foldshell.shell.linear_solver import NotPositiveDefiniteError, factorise

SEED = 2018
SHIFTS = (1e-10, 1e-8, 1e-6, 1e-4, 1e-2)
"""Multiples of the diagonal that are added until a factor exists."""

SINGULAR = 1e-13
"""Least eigenvalue of D^-1/2 K D^-1/2 below which K counts as singular. Round-off leaves 1e-16 of
a mechanism; shells of 28 m span and 0.2 mm thickness still have 2e-10."""


def is_singular(solve: Callable[[np.ndarray], np.ndarray], diagonal: np.ndarray) -> bool:
    """Tell whether a factor that exists is one of round-off: a mechanism that Cholesky missed.

    The least eigenvalue is bounded by inverse iteration, further steps only where the first
    bound is suspiciously low.

    diagonal (size,) of K in kN/m, kN and kNm; `solve` takes and gives (size, k).
    """
    diagonal = diagonal[:, None]
    vector = np.random.default_rng(SEED).standard_normal((len(diagonal), 1))
    for bound in (1e4 * SINGULAR, SINGULAR, SINGULAR):
        before = np.sqrt((diagonal * vector**2).sum())
        vector = solve(diagonal * vector)
        after = np.sqrt((diagonal * vector**2).sum())
        if before > bound * after:
            return False
        vector /= after
    return True


def find_near_null_vector(
    pattern: LowerPattern, values: np.ndarray, solver: str = "cholmod", iterations: int = 6
) -> np.ndarray | None:
    """Return the eigenvector (size,) of the least eigenvalue of D^-1/2 K D^-1/2, D = diag K.

    By inverse iteration on K + s D with the least s of `SHIFTS` that has a factor; None if none
    has. It tells the place of a mechanism; pivots tell only where elimination met it.

    values (nnz,) in kN/m, kN and kNm; the vector has no unit.
    """
    diagonal = values[pattern.indptr[:-1]]
    weight = np.where(diagonal > 0, diagonal, np.abs(diagonal).max() or 1.0)
    for shift in SHIFTS:
        moved = values.copy()
        moved[pattern.indptr[:-1]] += shift * weight
        try:
            factor = factorise(pattern, moved, solver)
        except NotPositiveDefiniteError:
            continue
        vector = np.random.default_rng(SEED).standard_normal((pattern.size, 1))
        for _ in range(iterations):
            vector = factor.solve(weight[:, None] * vector)
            vector /= np.abs(vector).max()
        return vector[:, 0]
    return None
