"""The subspace in which modes are sought: K-orthonormal, with every load case projected on it."""

from functools import reduce
from typing import Protocol

import numpy as np

from foldshell.files.threads import divide, divide_rows, run_parts

DEPENDENT = 1e-22
"""Share of a vector's energy that is left beside the basis when it lies within it: rounding."""

ROOM = 96
"""Vectors for which memory is set aside at first."""

LEAST_COLUMNS = 2
"""Vectors of a part that is worked on alone on a large mesh."""


class Products(Protocol):
    """K_g of the load cases times vectors, in kN/m times the unit of these."""

    def mix(self, vectors: np.ndarray, factors: np.ndarray) -> np.ndarray:
        """Return K_g of the combination (cases, k) of each column (size, k) times it.

        Factors without unit, the result in kN/m times the unit of the vectors.
        """

    def project(self, vectors: np.ndarray, chosen: slice) -> np.ndarray:
        """Return v_i^T K_g v_j of rows (k, size), all i and the chosen j: (cases, k, chosen).

        In kN/m times the square of the unit of the vectors.
        """


class Subspace:
    """A K-orthonormal basis with K_g of every load case projected on it."""

    def __init__(self, solve, products: Products, cases: int, size: int) -> None:
        self._solve, self.products, self.size = solve, products, size
        # room for more vectors than most searches need, one vector per row: basis, and K times it
        self._room = np.empty((2, ROOM, size))
        self.count = 0
        self._projected = np.empty((cases, 0, 0))
        self.solves = 0

    def combine(self, coefficients: np.ndarray) -> np.ndarray:
        """Return the vectors (size, n) that have coefficients (k, n) in the basis.

        Coefficients without unit, vectors in that of the basis.
        """
        return (coefficients.T @ self._room[0, : self.count]).T

    def images(self, coefficients: np.ndarray, factors: np.ndarray) -> np.ndarray:
        """Return -K_g(N) x (size, n) of vectors with coefficients (k, n), factors (cases, n).

        Coefficients and factors without unit, results in kN/m times the unit of the basis.
        """

        def apply(part: slice) -> np.ndarray:
            """Return the images of some of the vectors."""
            return -self.products.mix(self.combine(coefficients[:, part]), factors[:, part])

        parts = divide(coefficients.shape[1], self.size, LEAST_COLUMNS)
        return _join(list(run_parts(apply, parts)), axis=1)

    def extend(self, forces: np.ndarray) -> np.ndarray:
        """Add Z = K^-1 forces (size, k) to the basis; return Z as solved.

        Forces in kN and kNm, the result in m and rad.
        """
        solved = self._solve(forces)
        self.solves += forces.shape[1]
        old = self.count
        basis, own_forces = self._room[:2, :old]
        # rows hold vectors: products of long rows are several times as fast as of long columns
        vectors, forces = np.array(solved.T, order="C"), np.array(forces.T, order="C")
        for _ in range(2):
            energy = _measure_energy(vectors, forces)
            _take_away(vectors, forces, basis, own_forces)
            # what is left of a vector of the basis is rounding: made a unit vector it spoils all
            left = _measure_energy(vectors, forces) > DEPENDENT * energy
            if not left.all():
                vectors, forces = vectors[left], forces[left]
            vectors, forces = _orthonormalise(vectors, forces)
        if not len(vectors):
            return solved
        new = old + len(vectors)
        while new > self._room.shape[1]:
            self._room = np.concatenate([self._room, np.empty_like(self._room)], axis=1)
        self._room[0, old:new], self._room[1, old:new] = vectors, forces
        self.count = new
        added = self._project(old)
        grown = np.zeros((len(self._projected), new, new))
        grown[:, :old, :old] = self._projected
        grown[:, :, old:] = added
        grown[:, old:, :old] = added[:, :old].transpose(0, 2, 1)
        self._projected = grown
        return solved

    def _project(self, begin: int) -> np.ndarray:
        """Return K_g of every case between all and the vectors from `begin` on: (cases, k, n)."""
        basis = self._room[0, : self.count]

        def project(part: slice) -> np.ndarray:
            """Return the products of all vectors with some of the new ones."""
            return self.products.project(basis, slice(begin + part.start, begin + part.stop))

        parts = divide(self.count - begin, self.size, LEAST_COLUMNS)
        return _join(list(run_parts(project, parts)), axis=2)

    def largest(self, factors: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
        """Return the largest mu = 1 / lambda (count, c) and their coefficients (count, k, c)."""
        matrices = -np.einsum("akn,ac->ckn", self._projected, factors)
        values, vectors = np.linalg.eigh((matrices + matrices.transpose(0, 2, 1)) / 2)
        count = min(count, values.shape[1])
        return values[:, : -count - 1 : -1].T, vectors[:, :, : -count - 1 : -1].transpose(2, 1, 0)


def _join(parts: list[np.ndarray], axis: int) -> np.ndarray:
    return parts[0] if len(parts) == 1 else np.concatenate(parts, axis=axis)


def _measure_energy(vectors: np.ndarray, forces: np.ndarray) -> np.ndarray:
    """Return the products (k,) of the long rows of two arrays (k, size)."""

    def measure(part: slice) -> np.ndarray:
        """Return the products of some columns."""
        return np.einsum("ks,ks->k", vectors[:, part], forces[:, part])

    return reduce(np.add, run_parts(measure, divide_rows(vectors.shape[1], vectors.shape[1])))


def _multiply(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return one other^T (k, n) of long rows; those of large meshes are summed part by part."""
    parts = divide_rows(one.shape[1], one.shape[1])
    return reduce(np.add, run_parts(lambda part: one[:, part] @ other[:, part].T, parts))


def _take_away(vectors, forces, basis, own_forces) -> None:
    """Take from vectors and forces (k, size) what they have of the basis, in place."""
    overlap = _multiply(vectors, own_forces)

    def subtract(part: slice) -> None:
        """Take it from some entries of every vector."""
        vectors[:, part] -= overlap @ basis[:, part]
        forces[:, part] -= overlap @ own_forces[:, part]

    list(run_parts(subtract, divide_rows(vectors.shape[1], vectors.shape[1])))


def _orthonormalise(vectors: np.ndarray, forces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Make vectors forces^T (= Z K Z^T, rows Z) the identity, leaving out dependent directions.

    In place: what was handed over is not to be used again.
    """
    gram = _multiply(vectors, forces)
    scale = 1 / np.sqrt(np.maximum(np.diag(gram), 1e-300))
    values, rotation = np.linalg.eigh((gram + gram.T) / 2 * scale * scale[:, None])
    keep = values > 1e-12
    mix = (scale[:, None] * rotation[:, keep] / np.sqrt(values[keep])).T
    kept = len(mix)

    def turn(part: slice) -> None:
        """Mix the vectors in some of their entries."""
        vectors[:kept, part] = mix @ vectors[:, part]
        forces[:kept, part] = mix @ forces[:, part]

    list(run_parts(turn, divide_rows(vectors.shape[1], vectors.shape[1])))
    return vectors[:kept], forces[:kept]
