"""Multifrontal Cholesky over a bisection of the facets: dense fronts, LAPACK inside.

K = L L^T for a matrix given as a sum of small dense ones. A tree halves the facets; at each
branch the unknowns that no facet outside it touches are eliminated from a dense front.
Source: Duff and Reid, ACM Trans. Math. Softw. 9 (1983) 302-325. On the dense couplings of
condensed facets it takes a tenth of the time of SuperLU, which stays as a check in the tests.

What two halves share and what ends there is found first, so that each half leaves its rows in the
order in which the front above takes them: adding two halves up is then a matter of slices.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg.blas import dsyrk, dtrsm
from scipy.linalg.lapack import dpotrf, dtrtri

from crosscheck.bisection import Tree, bisect

ROUNDING = 1e-13
"""A pivot that elimination shrinks to this part of its value is zero but for rounding."""

BLOCK = 64
BELOW = np.tri(BLOCK, k=-1, dtype=bool)


class NotPositiveDefinite(ValueError):
    """The matrix has a direction without positive stiffness: a mechanism, or buckled."""


@dataclass(frozen=True)
class Front:
    """One elimination: unknowns `inner` in terms of `outer`."""

    inner: np.ndarray
    outer: np.ndarray
    inverse: np.ndarray  # (i, i) inverse(L) of the front's inner block
    coupling: np.ndarray  # (i, o) inverse(L) Kio


@dataclass(frozen=True)
class Factor:
    """All fronts, children before parents."""

    size: int
    fronts: tuple[Front, ...]

    def solve(self, load: np.ndarray) -> np.ndarray:
        """x = inverse(K) b for b (size,) or (size, c)."""
        x = np.array(load, dtype=float)
        for front in self.fronts:
            part = front.inverse @ x[front.inner]
            x[front.inner] = part
            x[front.outer] -= front.coupling.T @ part
        for front in reversed(self.fronts):
            right = x[front.inner] - front.coupling @ x[front.outer]
            x[front.inner] = front.inverse.T @ right
        return x


@dataclass
class Branch:
    """A part of the facets before any number is known.

    `outer` are the equations left over, in the order in which they stand after the elimination;
    `sort` rearranges them to the order of the branch above. `only` (2,) and `shared` count those
    of one half and of both.
    """

    inner: np.ndarray
    outer: np.ndarray
    met: np.ndarray  # how often each of `outer` was met
    halves: tuple["Branch", ...] = ()
    facet: int = -1
    rows: np.ndarray | None = None  # of a facet: its rows, inner ones first
    only: tuple[int, int] = (0, 0)
    shared: int = 0
    sort: np.ndarray | None = None


def factor_sum(matrices: np.ndarray, place: np.ndarray, centres: np.ndarray, size: int) -> Factor:
    """Factor K = sum of `matrices` (F, n, n) at equations `place` (F, n), -1 for none.

    `centres` (F, 3) guide the bisection. Raises NotPositiveDefinite.
    """
    root = _plan(bisect(place, centres), place, _Counter(place, size))
    fronts: list[Front] = []
    _eliminate(root, matrices, fronts)
    return Factor(size, tuple(fronts))


class _Counter:
    """How many facets touch each equation, and a table to look equations up in."""

    def __init__(self, place: np.ndarray, size: int) -> None:
        self.uses = np.bincount(place[place >= 0], minlength=size)
        self.table = np.full(size, -1)

    def find(self, wanted: np.ndarray, among: np.ndarray) -> np.ndarray:
        """Position of each wanted equation among others, -1 for none."""
        self.table[among] = np.arange(len(among))
        found = self.table[wanted]
        self.table[among] = -1
        return found


def _plan(tree: Tree, place: np.ndarray, counter: _Counter) -> Branch:
    """Find what each part eliminates and leaves, without numbers."""
    if isinstance(tree, int):
        own = place[tree]
        ends = (own >= 0) & (counter.uses[own] == 1)
        stays = (own >= 0) & ~ends
        rows = np.concatenate([np.flatnonzero(ends), np.flatnonzero(stays)])
        met = np.ones(int(stays.sum()), int)
        return Branch(own[ends], own[stays], met, facet=tree, rows=rows)
    first, second = (_plan(half, place, counter) for half in tree)
    at = counter.find(second.outer, first.outer)  # in the first half
    back = np.flatnonzero(at >= 0)  # in the second half
    at = at[back]
    met = first.met[at] + second.met[back]
    ends = met == counter.uses[second.outer[back]]
    mine, yours = (
        np.setdiff1d(np.arange(len(half.outer)), taken, assume_unique=True)
        for half, taken in ((first, at), (second, back))
    )
    first.sort = np.concatenate([at[ends], mine, at[~ends]])
    second.sort = np.concatenate([back[ends], back[~ends], yours])
    outer = [first.outer[mine], first.outer[at[~ends]], second.outer[yours]]
    met = [first.met[mine], met[~ends], second.met[yours]]
    return Branch(
        first.outer[at[ends]],
        np.concatenate(outer),
        np.concatenate(met),
        (first, second),
        only=(len(mine), len(yours)),
        shared=int((~ends).sum()),
    )


def _eliminate(branch: Branch, matrices: np.ndarray, fronts: list[Front]) -> np.ndarray | None:
    """Eliminate a branch; append its fronts; return what is left, as the branch above takes it."""
    inner = len(branch.inner)
    if branch.facet >= 0:
        front = matrices[branch.facet][branch.rows[:, None], branch.rows]
        blocks = [front[:inner, :inner], front[:inner, inner:], front[inner:, inner:]]
    else:
        blocks = _add_halves(branch, [_eliminate(half, matrices, fronts) for half in branch.halves])
    pivot, coupling, rest = (np.ascontiguousarray(block) for block in blocks)
    if inner:
        fronts.append(_eliminate_front(branch, pivot, coupling, rest))
    if branch.sort is None:
        return None
    return np.take(np.take(rest, branch.sort, axis=0), branch.sort, axis=1)


def _add_halves(branch: Branch, halves: list[np.ndarray]) -> list[np.ndarray]:
    """Sum two halves into the blocks inner-inner, inner-outer and outer-outer."""
    (first, second), inner = halves, len(branch.inner)
    end = branch.only[0] + branch.shared
    size = end + branch.only[1]
    coupling, rest = np.empty((inner, size)), np.empty((size, size))
    coupling[:, :end] = first[:inner, inner:]
    coupling[:, end:] = 0.0
    coupling[:, branch.only[0] :] += second[:inner, inner:]
    rest[:end, :end] = first[inner:, inner:]
    rest[end:] = 0.0
    rest[:end, end:] = 0.0
    rest[branch.only[0] :, branch.only[0] :] += second[inner:, inner:]
    return [first[:inner, :inner] + second[:inner, :inner], coupling, rest]


def _eliminate_front(
    branch: Branch, pivot: np.ndarray, coupling: np.ndarray, rest: np.ndarray
) -> Front:
    """Eliminate the inner equations; `rest` becomes the Schur complement, `coupling` the factor."""
    diagonal = np.diag(pivot).copy()
    lower, failed = dpotrf(pivot.T, lower=1, clean=1, overwrite_a=1)
    if failed or (np.diag(lower) ** 2 <= ROUNDING * diagonal).any():
        raise NotPositiveDefinite("a direction has no positive stiffness")
    if coupling.size:
        # the transposes are in Fortran's order: all is done in place
        dtrsm(1.0, lower, coupling.T, side=1, lower=1, trans_a=1, overwrite_b=1)
        dsyrk(-1.0, coupling.T, 1.0, rest.T, lower=1, overwrite_c=1)
        _mirror(rest)
    inverse, _ = dtrtri(lower, lower=1, overwrite_c=1)
    return Front(branch.inner, branch.outer, inverse, coupling)


def _mirror(matrix: np.ndarray) -> None:
    """Copy the upper triangle onto the lower one, block by block."""
    for start in range(0, len(matrix), BLOCK):
        end = min(start + BLOCK, len(matrix))
        matrix[start:end, :start] = matrix[:start, start:end].T
        square = matrix[start:end, start:end]
        np.copyto(square, square.T, where=BELOW[: end - start, : end - start])
