"""Buckling factors of all load combinations from one growing subspace.

(K + lambda K_g(N_c)) x = 0 for the least positive lambda of every combination c. K_g is linear in
the load cases, so a subspace in which each case is projected once serves all combinations. It is
enlarged by K^-1 K_g x of every mode x that is not yet accurate: a block Davidson method (Davidson
1975) whose preconditioner is the factor of K that is at hand anyway.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import reduce

import numpy as np

from foldshell.files.threads import divide, divide_rows, run_parts
from foldshell.shell.effort import NEAR, USUAL, Effort

GROWTH = 10.0
"""Multiple of the square of a change by which 1/factor may still grow: that of a gap of a tenth."""

LARGEST_FACTOR = 1e8
"""A larger factor is taken for none at all."""

SEARCH_ITERATIONS = 12
"""Iterations after which a structure without a positive factor counts as free of compression."""

START_SEED = 2018
"""Seed of the start vectors, fixed so that reruns agree to the last bit."""

DEPENDENT = 1e-22
"""Share of a vector's energy that is left beside the basis when it lies within it: rounding."""

ROOM = 96
"""Vectors for which memory is set aside at first."""

LEAST_COLUMNS = 2
"""Vectors of a part that is worked on alone on a large mesh."""


@dataclass(frozen=True)
class BucklingResult:
    """Least positive factors (c,), inf where no compression acts, and their modes (size, c).

    `change` (c,) is the K-norm of x - K^-1 (-K_g x) / mu for modes of unit K-norm; its square
    bounds the relative error of the factor up to the gap to the next one. `solves` counts
    right-hand sides.
    """

    factors: np.ndarray
    modes: np.ndarray
    change: np.ndarray
    solves: int
    converged: bool


def find_buckling_factors(
    solve: Callable[[np.ndarray], np.ndarray],
    apply_cases: Callable[[np.ndarray], Iterable[np.ndarray]],
    factors: np.ndarray,
    size: int,
    start: np.ndarray | None = None,
    effort: Effort = USUAL,
    iterations_max: int = 60,
    apply_mixed: Callable[[np.ndarray, np.ndarray], np.ndarray] | None = None,
) -> BucklingResult:
    """Find the least positive buckling factor of each combination.

    Parameters
    ----------
    solve : K^-1 on (size, k)
    apply_cases : maps (size, k) to K_g of each load case times it, (size, k) of one after the
        other
    factors : (cases, c) combination factors
    start : (size, c) modes of a similar structure to begin with
    effort : how it begins and when it ends; without random vectors only if there is a `start`
    apply_mixed : maps (size, k) and combination factors (cases, k) to K_g of each column's own
        combination times it, (size, k); by default by `apply_cases`

    Factors without unit.
    """
    first, which, ratio = _proportional_columns(factors)
    begin = None if start is None else start[:, first]
    cases = factors[:, first]
    mixed = apply_mixed or _mix_cases(apply_cases)
    space = _Subspace(solve, apply_cases, mixed, len(cases), size)
    found = _find_distinct(space, cases, begin, effort, iterations_max)
    with np.errstate(divide="ignore"):
        values = np.where(ratio > 0, found.factors[which] / ratio, np.inf)
    return replace(found, factors=values, modes=found.modes[:, which], change=found.change[which])


def _mix_cases(apply_cases) -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
    return lambda vectors, factors: sum(
        own * share for own, share in zip(apply_cases(vectors), factors, strict=True)
    )


def _find_distinct(space, factors, start, effort: Effort, iterations_max) -> BucklingResult:
    """Find the factors of combinations none of which is a multiple of another."""
    space.extend(_begin(space, factors, start, effort))
    pairs = min(max(effort.pairs, -(-effort.followed // factors.shape[1])), space.size)
    change = np.full((pairs, factors.shape[1]), np.inf)
    before = np.zeros_like(change)
    for number in range(iterations_max):
        values, vectors = space.largest(factors, pairs)
        if effort.watch_growth:
            change = np.maximum(change, _expect_more(before, values))
        before = values
        searching = (values * LARGEST_FACTOR > 1) | ((number < SEARCH_ITERATIONS) & (values != 0))
        limit = _limits(values, effort)
        pair, column = np.nonzero((change > limit) & searching)
        if not len(pair):
            break
        images = space.images(vectors[pair, :, column].T, factors[:, column])
        better = space.extend(images)
        energy = (better * images).sum(axis=0) / values[pair, column] ** 2
        change[pair, column] = np.sqrt(np.maximum(energy - 1, 0))
    values, vectors = space.largest(factors, 1)
    compressed = values[0] * LARGEST_FACTOR > 1
    result = np.where(compressed, 1 / np.where(compressed, values[0], 1.0), np.inf)
    done = bool(((change[0] <= _limits(values, effort)[0]) | ~compressed).all())
    modes = space.combine(vectors[0])
    return BucklingResult(result, modes, change[0], space.solves, done)


def _begin(space, factors, start, effort: Effort) -> np.ndarray:
    """Return the forces (size, k) with which the search begins."""
    count = effort.random_vectors if start is not None else max(effort.random_vectors, 1)
    begin = np.random.default_rng(START_SEED).standard_normal((space.size, count))
    return begin if start is None else np.hstack([begin, -space.apply_mixed(start, factors)])


def _expect_more(before: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return the least change (pairs, c) of modes whose 1/factor grew from `before` to `values`.

    A mode that stands exactly on a higher one hardly changes, whatever is below: a factor that
    falls once the space has grown shows it.
    """
    known = (before > 0) & (values > before)
    growth = np.where(known, values / np.where(known, before, 1.0) - 1, 0.0)
    return np.sqrt(growth / GROWTH)


def _limits(values: np.ndarray, effort: Effort) -> np.ndarray:
    """Return the change (pairs, c) at which each mode is known well enough; values are 1/factor."""
    limit = np.full(values.shape, effort.neighbour_tolerance)
    near = values[0] * NEAR >= values[0].max()
    limit[0] = np.where(near, effort.near_tolerance, effort.far_tolerance)
    return limit


def _proportional_columns(factors: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the distinct combinations, which of them each one is a multiple of, and the multiple.

    Proportional combinations share their mode.
    """
    length = np.linalg.norm(factors, axis=0)
    direction = factors / np.where(length > 0, length, 1)
    same = (np.abs(direction[:, :, None] - direction[:, None]) < 1e-13).all(axis=0)
    first = same.argmax(axis=1)
    distinct, which = np.unique(first, return_inverse=True)
    return distinct, which, length / np.where(length[first] > 0, length[first], 1)


class _Subspace:
    """A K-orthonormal basis with K_g of every load case projected on it."""

    def __init__(self, solve, apply_cases, apply_mixed, cases: int, size: int) -> None:
        self._solve, self._apply, self.apply_mixed, self.size = (
            solve, apply_cases, apply_mixed, size
        )  # fmt: skip
        # room for more vectors than most searches need, one vector per row: basis, and K times it
        self._room = np.empty((2, ROOM, size))
        self._count = 0
        self._projected = np.empty((cases, 0, 0))
        self.solves = 0

    def combine(self, coefficients: np.ndarray) -> np.ndarray:
        """Return the vectors (size, n) that have coefficients (k, n) in the basis."""
        return (coefficients.T @ self._room[0, : self._count]).T

    def images(self, coefficients: np.ndarray, factors: np.ndarray) -> np.ndarray:
        """Return -K_g(N) x (size, n) of vectors with coefficients (k, n), factors (cases, n)."""

        def apply(part: slice) -> np.ndarray:
            return -self.apply_mixed(self.combine(coefficients[:, part]), factors[:, part])

        parts = divide(coefficients.shape[1], self.size, LEAST_COLUMNS)
        return _join(list(run_parts(apply, parts)), axis=1)

    def extend(self, forces: np.ndarray) -> np.ndarray:
        """Add Z = K^-1 forces to the basis; return Z as solved."""
        solved = self._solve(forces)
        self.solves += forces.shape[1]
        old = self._count
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
        self._count = new
        added = self._project(vectors)
        grown = np.zeros((len(self._projected), new, new))
        grown[:, :old, :old] = self._projected
        grown[:, :, old:] = added
        grown[:, old:, :old] = added[:, :old].transpose(0, 2, 1)
        self._projected = grown
        return solved

    def _project(self, vectors: np.ndarray) -> np.ndarray:
        """Return K_g of every case between the basis and vectors (k, size): (cases, basis, k)."""
        basis = self._room[0, : self._count]

        def project(part: slice) -> np.ndarray:
            return np.stack([basis @ applied for applied in self._apply(vectors[part].T)])

        parts = divide(len(vectors), self.size, LEAST_COLUMNS)
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
        vectors[:kept, part] = mix @ vectors[:, part]
        forces[:kept, part] = mix @ forces[:, part]

    list(run_parts(turn, divide_rows(vectors.shape[1], vectors.shape[1])))
    return vectors[:kept], forces[:kept]
