"""The lowest buckling factor of each combination by block Lanczos iteration.

T = inverse(K) (-Kg) is self-adjoint in the inner product of K; its largest eigenvalue is one over
the lowest factor. K (T v) = -Kg v is known without a product, and it acts on translations alone:
inner products need the translations of one vector and the forces of the other, nothing else.
Two vectors per combination are iterated side by side: a step reads the factor as often as with one,
they need two thirds of its steps where modes are close together, and see both modes of a pair.
Starts are random on every mesh: from the mode of a coarser one the search could end on its like,
where another mode has become the lowest.
Source: Parlett, The Symmetric Eigenvalue Problem (1998), ch. 13.
"""

from dataclasses import dataclass

import numpy as np

from crosscheck.search import Steps, run_alone
from crosscheck.second_order import (
    apply_geometric,
    assemble_geometric,
    compute_geometric_matrices,
)
from crosscheck.system import Response, System

BLOCK = 2
STEPS = 60
TOLERANCE = 2e-6
"""Bound on the relative error of 1/f. At 1e-3 the search ended on a higher mode, 3 and 7 % up, in
two of 34 designs, one vector per combination; at 2e-6 two vectors take 7 to 25 steps on ten, and
the factors are those of ARPACK to 1e-6."""
PART = 4096
"""Entries of a vector that are multiplied with all others at a time."""
DEPENDENT = 1e-20
"""What is left of a squared length at right angles to the basis, where it is rounding alone."""


@dataclass(frozen=True)
class Buckling:
    """The lowest factor of each combination (c,), whether it has settled (c,), steps taken."""

    factor: np.ndarray
    settled: np.ndarray
    steps: int


def compute_buckling_factors(
    system: System, first: Response, seed: int = 0, tolerance: float = TOLERANCE
) -> Buckling:
    """Find the factors by `search_factors` alone."""
    return run_alone(system, search_factors(system, first, seed, tolerance))


def search_factors(
    system: System, first: Response, seed: int = 0, tolerance: float = TOLERANCE
) -> Steps:
    """Smallest positive f with (K + f Kg) singular, for each column of `first`.

    Infinite where no multiple of the load buckles the shell. A factor that is not settled after
    all steps is an upper bound. Returns a Buckling.
    """
    matrices = compute_geometric_matrices(system, first.local)
    operators = assemble_geometric(system.grid, matrices)
    cases = first.local.shape[-1]
    image = np.random.default_rng(seed).normal(size=(*first.local.shape[:3], cases * BLOCK))
    image[:, :, 3:] = 0.0  # forces: any consistent vectors will do
    vector = (yield image).local
    rows, forces = _flatten(vector, cases), _flatten(image, cases)
    gram = rows @ np.swapaxes(forces, -1, -2)
    length = np.linalg.norm(gram, axis=(1, 2))
    basis = np.empty((cases, STEPS * BLOCK, rows.shape[-1]))
    projected = np.zeros((cases, STEPS * BLOCK, STEPS * BLOCK))
    for step in range(STEPS):
        new, done = slice(step * BLOCK, (step + 1) * BLOCK), slice((step + 1) * BLOCK)
        basis[:, new] = _orthonormalise(gram, length) @ rows
        image = -apply_geometric(operators, _unflatten(basis[:, new], image))
        forces = _flatten(image, cases)
        part = _multiply(basis[:, done], forces)
        projected[:, done, new] = part
        projected[:, new, done] = np.swapaxes(part, -1, -2)
        rows = _flatten((yield image).local, cases)
        rows -= np.swapaxes(part, -1, -2) @ basis[:, done]
        # what is left is at right angles to the basis: its forces need no such correction
        gram = rows @ np.swapaxes(forces, -1, -2)
        length = (part**2).sum(axis=(1, 2))
        value, error = _find_largest(projected[:, done, done], gram)
        settled = error <= tolerance * np.abs(value)
        if settled.all():
            break
    factor = np.where(value > 0, 1 / np.where(value > 0, value, 1.0), np.inf)
    return Buckling(factor, settled, step + 1)


def _flatten(local: np.ndarray, cases: int) -> np.ndarray:
    """Translations of columns (F, R, 5, c b) as rows (c, b, n)."""
    columns = local[:, :, :3].reshape(-1, local.shape[-1])
    return np.ascontiguousarray(columns.T).reshape(cases, -1, len(columns))


def _unflatten(rows: np.ndarray, like: np.ndarray) -> np.ndarray:
    """Columns (F, R, 5, c b) from rows of translations (c, b, n); rotations are zero."""
    local = np.zeros_like(like)
    columns = rows.reshape(-1, rows.shape[-1]).T
    local[:, :, :3] = columns.reshape(*like.shape[:2], 3, -1)
    return local


def _multiply(basis: np.ndarray, forces: np.ndarray) -> np.ndarray:
    """Products (c, k, b) of rows (c, k, n) with rows (c, b, n), a part of n after the other: what
    is read once then stays near the processor."""
    total = np.zeros((*basis.shape[:2], forces.shape[1]))
    for start in range(0, basis.shape[-1], PART):
        part = slice(start, start + PART)
        total += basis[..., part] @ np.swapaxes(forces[..., part], -1, -2)
    return total


def _orthonormalise(gram: np.ndarray, length: np.ndarray) -> np.ndarray:
    """Combinations (c, b, b) of b vectors with products `gram` (c, b, b) that are orthonormal.

    Zero for a direction of which nothing is left, measured by the squared `length` (c,) before:
    it takes no part in what follows.
    """
    value, vector = np.linalg.eigh((gram + np.swapaxes(gram, -1, -2)) / 2)
    usable = value > DEPENDENT * length[:, None]
    scale = np.where(usable, 1 / np.sqrt(np.where(usable, value, 1.0)), 0.0)
    return scale[..., None] * np.swapaxes(vector, -1, -2)


def _find_largest(projected: np.ndarray, gram: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Largest eigenvalue of each projected matrix (c, n, n), and the bound on its error.

    `gram` (c, b, b) are the products of the vectors that the last block leaves.
    """
    values, vectors = np.linalg.eigh(projected)
    last = vectors[:, -gram.shape[-1] :, -1]
    square = np.maximum(np.einsum("ci,cij,cj->c", last, gram, last), 0.0)
    gap = values[:, -1] - values[:, -2]
    error = np.minimum(np.sqrt(square), square / np.where(gap > 0, gap, 1.0))
    return values[:, -1], np.where(gap > 0, error, np.inf)
