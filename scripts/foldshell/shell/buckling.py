"""Buckling factors of all load combinations from one growing subspace.

(K + lambda K_g(N_c)) x = 0 for the least positive lambda of every combination c. K_g is linear in
the load cases, so a subspace in which each case is projected once serves all combinations. It is
enlarged by K^-1 K_g x of every mode x that is not yet accurate: a block Davidson method (Davidson
1975) whose preconditioner is the factor of K that is at hand anyway.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np

from foldshell.shell.effort import NEAR, USUAL, Effort
from foldshell.shell.subspace import Products, Subspace

GROWTH = 10.0
"""Multiple of the square of a change by which 1/factor may still grow: that of a gap of a tenth."""

LARGEST_FACTOR = 1e8
"""A larger factor is taken for none at all."""

SEARCH_ITERATIONS = 12
"""Iterations after which a structure without a positive factor counts as free of compression."""

START_SEED = 2018
"""Seed of the start vectors, fixed so that reruns agree to the last bit."""


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

    Factors without unit.
    """
    search = BucklingSearch(solve, _Cases(apply_cases), factors, size)
    return search.run(effort, start, iterations_max)


@dataclass(frozen=True)
class _Cases:
    """Products by a function that gives those of one case after the other."""

    apply: Callable[[np.ndarray], Iterable[np.ndarray]]

    def mix(self, vectors: np.ndarray, factors: np.ndarray) -> np.ndarray:
        """Return the products of the combination of each column."""
        pairs = zip(self.apply(vectors), factors, strict=True)
        return sum(own * share for own, share in pairs)

    def project(self, vectors: np.ndarray, chosen: slice) -> np.ndarray:
        """Return the projected products of all vectors with the chosen ones."""
        return np.stack([vectors @ own for own in self.apply(vectors[chosen].T)])


class BucklingSearch:
    """The search of one stiffness, which a second run takes up where the first one left it.

    Parameters are those of `find_buckling_factors`, `products` in place of a function.
    """

    def __init__(self, solve, products: Products, factors: np.ndarray, size: int) -> None:
        self._first, self._which, self._ratio = _proportional_columns(factors)
        self._factors = factors[:, self._first]
        self._space = Subspace(solve, products, len(factors), size)
        self._random, self._change = 0, np.empty((0, len(self._first)))

    def run(
        self, effort: Effort, start: np.ndarray | None = None, iterations_max: int = 60
    ) -> BucklingResult:
        """Return the least positive factor of each combination.

        start (size, c) are modes of a similar structure, without unit.
        """
        self._begin(effort, None if start is None else start[:, self._first])
        found = self._find(effort, iterations_max)
        which, ratio = self._which, self._ratio
        with np.errstate(divide="ignore"):
            values = np.where(ratio > 0, found.factors[which] / ratio, np.inf)
        return replace(found, factors=values, modes=found.modes[:, which],
                       change=found.change[which])  # fmt: skip

    def _begin(self, effort: Effort, start: np.ndarray | None) -> None:
        """Add the vectors with which the search begins; old changes then say nothing any more."""
        space = self._space
        asked = effort.random_vectors if start is not None or space.count else 1
        asked = max(asked, effort.random_vectors) - self._random
        forces = []
        if asked > 0:
            forces.append(np.random.default_rng(START_SEED).standard_normal((space.size, asked)))
            self._random += asked
        if start is not None and not space.count:
            forces.append(-space.products.mix(start, self._factors))
        if forces:
            space.extend(np.hstack(forces))
            self._change = self._change[:0]

    def _find(self, effort: Effort, iterations_max: int) -> BucklingResult:
        """Find the factors of combinations none of which is a multiple of another."""
        space, factors = self._space, self._factors
        pairs = min(max(effort.pairs, -(-effort.followed // factors.shape[1])), space.size)
        change = np.full((pairs, factors.shape[1]), np.inf)
        change[: len(self._change)] = self._change[:pairs]
        before = np.zeros_like(change)
        for number in range(iterations_max):
            values, vectors = space.largest(factors, pairs)
            if effort.watch_growth:
                change = np.maximum(change, _expect_more(before, values))
            before = values
            searching = values * LARGEST_FACTOR > 1
            searching |= (number < SEARCH_ITERATIONS) & (values != 0)
            limit = _limits(values, effort)
            pair, column = np.nonzero((change > limit) & searching)
            if not len(pair):
                break
            images = space.images(vectors[pair, :, column].T, factors[:, column])
            better = space.extend(images)
            energy = (better * images).sum(axis=0) / values[pair, column] ** 2
            change[pair, column] = np.sqrt(np.maximum(energy - 1, 0))
        self._change = change
        return self._report(change[0], effort)

    def _report(self, change: np.ndarray, effort: Effort) -> BucklingResult:
        space = self._space
        values, vectors = space.largest(self._factors, 1)
        compressed = values[0] * LARGEST_FACTOR > 1
        result = np.where(compressed, 1 / np.where(compressed, values[0], 1.0), np.inf)
        done = bool(((change <= _limits(values, effort)[0]) | ~compressed).all())
        return BucklingResult(result, space.combine(vectors[0]), change, space.solves, done)


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
    largest = values[0].max()
    near = values[0] * NEAR >= largest
    limit[0] = np.where(near, effort.near_tolerance, effort.far_tolerance)
    if np.isfinite(effort.ample) and largest * effort.ample < 1:
        rough = np.maximum(limit, effort.ample_tolerance)
        rough[0] = np.where(near, rough[0], np.inf)
        limit = np.where(values > 0, rough, limit)
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
