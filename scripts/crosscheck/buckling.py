"""The lowest buckling factor of each combination by Lanczos iteration.

T = inverse(K) (-Kg) is self-adjoint in the inner product of K; its largest eigenvalue is one over
the lowest factor. K v is known for every basis vector without a product: K (T v) = -Kg v.
Source: Parlett, The Symmetric Eigenvalue Problem (1998), ch. 13.
"""

import numpy as np

from crosscheck.second_order import apply_geometric, compute_geometric_matrices
from crosscheck.system import Response, System, solve_vectors

STEPS = 60
TOLERANCE = 1e-5
"""Bound on the relative error of 1/f. At 1e-3 the search ended on a higher mode, 3 and 7 % up, in
two of 34 designs; at 1e-5 it takes 9 to 35 of the steps allowed."""


def compute_buckling_factors(system: System, first: Response, seed: int = 0) -> np.ndarray:
    """Smallest positive f with (K + f Kg) singular, for each column of `first`: (c,).

    Infinite where no multiple of the load buckles the shell.
    """
    matrices = compute_geometric_matrices(system, first.local)
    start = np.random.default_rng(seed).normal(size=first.local.shape)
    start[:, :, 3:] = 0.0  # forces: any consistent vector will do
    vector, image = solve_vectors(system, start), start
    basis, images = np.empty((2, STEPS, vector.shape[-1], vector[..., 0].size))
    diagonal: list[np.ndarray] = []
    beside: list[np.ndarray] = [np.sqrt(_dot(_flatten(vector), _flatten(image)))]
    for step in range(STEPS):
        basis[step] = _flatten(vector) / beside[-1][:, None]
        images[step] = _flatten(image) / beside[-1][:, None]
        image = -apply_geometric(system, matrices, vector / beside[-1])
        vector = solve_vectors(system, image)
        diagonal.append(_dot(_flatten(vector), images[step]))
        done = slice(step + 1)
        part = np.einsum("scn,cn->sc", images[done], _flatten(vector), optimize=True)
        vector -= _unflatten(np.einsum("sc,scn->cn", part, basis[done], optimize=True), vector)
        image -= _unflatten(np.einsum("sc,scn->cn", part, images[done], optimize=True), image)
        beside.append(np.sqrt(np.maximum(_dot(_flatten(vector), _flatten(image)), 0.0)))
        value, error = _find_largest(np.array(diagonal), np.array(beside[1:]))
        if (error <= TOLERANCE * np.abs(value)).all():
            break
    return np.where(value > 0, 1 / np.where(value > 0, value, 1.0), np.inf)


def _flatten(local: np.ndarray) -> np.ndarray:
    """Columns (F, R, 5, c) as rows (c, n)."""
    return np.ascontiguousarray(local.reshape(-1, local.shape[-1]).T)


def _unflatten(rows: np.ndarray, like: np.ndarray) -> np.ndarray:
    return rows.T.reshape(like.shape)


def _dot(vector: np.ndarray, force: np.ndarray) -> np.ndarray:
    """Work of facet forces on displacements, row by row: (c,)."""
    return np.einsum("cn,cn->c", vector, force)


def _find_largest(diagonal: np.ndarray, beside: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Largest eigenvalue of each column's tridiagonal matrix, and the bound on its error."""
    value, error = [], []
    for main, side in zip(diagonal.T, beside.T, strict=True):
        matrix = np.diag(main) + np.diag(side[:-1], 1) + np.diag(side[:-1], -1)
        values, vectors = np.linalg.eigh(matrix)
        value.append(values[-1])
        gap = values[-1] - values[-2] if len(values) > 1 else 0.0
        residual = side[-1] * abs(vectors[-1, -1])
        error.append(min(residual, residual**2 / gap) if gap > 0 else np.inf)
    return np.array(value), np.array(error)
