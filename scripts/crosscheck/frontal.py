"""Multifrontal Cholesky over a bisection of the facets: dense fronts, LAPACK inside.

K = L L^T for a matrix given as a sum of small dense ones. A tree halves the facets; at each
branch the unknowns that no facet outside it touches are eliminated from a dense front.
Source: Duff and Reid, ACM Trans. Math. Softw. 9 (1983) 302-325. On the dense couplings of
condensed facets it takes a tenth of the time of SuperLU, which stays as a check in the tests.

Each half leaves its rows in the order in which the front above takes them (`ordering`): adding two
halves up is then a matter of slices. The matrices are taken one by one, so that they need not all
stand in memory.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from scipy.linalg.blas import dsyrk, dtrsm
from scipy.linalg.lapack import dpotrf, dtrtri

from crosscheck.ordering import Branch, Plan, Spans, Step, list_branches, plan_steps

ROUNDING = 1e-13
"""A pivot that elimination shrinks to this part of its value is zero but for rounding."""

BLOCK = 64
BELOW = np.tri(BLOCK, k=-1, dtype=bool)


class NotPositiveDefinite(ValueError):
    """The matrix has a direction without positive stiffness: a mechanism, or buckled."""


@dataclass(frozen=True)
class Front:
    """One elimination: unknowns `inner` in terms of `outer`, both by their turn in it.

    `back` (i, i + o) is L^-T [1 | -L^-1 Kio]: forward its transpose takes the inner load to what
    the inner unknowns keep and the outer ones are given, backward it takes both to the solution.
    """

    inner: slice
    outer: np.ndarray
    back: np.ndarray


@dataclass(frozen=True)
class Factor:
    """All fronts, children before parents; `order` are the equations as they are eliminated."""

    order: np.ndarray
    fronts: tuple[Front, ...]

    def solve(self, load: np.ndarray) -> np.ndarray:
        """x = inverse(K) b for b (size,) or (size, c). b in kN or kNm, x in m or rad."""
        # one product a front and direction; a row holds the cases of an unknown, which are few:
        # rows are gathered at the speed of memory, and long operands suit the product
        x = load[self.order].reshape(len(self.order), -1)
        for front in self.fronts:
            count = len(front.back)
            own = (x[front.inner].T @ front.back).T
            x[front.inner] = own[:count]
            outer = x.take(front.outer, axis=0)
            outer += own[count:]
            x[front.outer] = outer
        for front in reversed(self.fronts):
            both = np.concatenate([x[front.inner], x.take(front.outer, axis=0)])
            x[front.inner] = (both.T @ front.back.T).T
        result = np.empty_like(x)
        result[self.order] = x
        return result.reshape(load.shape)


def factor_sum(
    matrices: Iterable[np.ndarray], plan: Plan, place: np.ndarray, spans: Spans
) -> Factor:
    """Factor K = sum of matrices (n, n) at equations `place` (F, n), -1 for none.

    `matrices` come in the order of `plan.facets`; `spans` says which equations a group stands for,
    rising with the groups. Raises NotPositiveDefinite.

    Matrices in kN/m, kN and kNm.
    """
    branches = list(list_branches(plan.root))
    order = np.concatenate([spans.list_equations(branch.inner) for branch in branches])
    size = int(spans.count.sum())
    turn = np.full(size, -1)  # when an equation is eliminated: never, if no facet has it
    turn[order] = np.arange(len(order))
    # rows of a facet that end in it come first, as in its branch
    alone = np.bincount(place[place >= 0], minlength=size) == 1
    key = np.where(place < 0, -1, place + np.where(alone[place], 0, size))
    rows, none = np.argsort(key, axis=1), (place < 0).sum(axis=1)
    work = _Elimination(iter(matrices), plan_steps(branches, spans, turn), rows, none, [])
    work.eliminate(plan.root)
    return Factor(order, tuple(work.fronts))


@dataclass
class _Elimination:
    """What a factorisation needs at every branch, and the fronts that it leaves."""

    matrices: Iterator[np.ndarray]
    steps: Iterator[Step]  # halves before the whole
    rows: np.ndarray  # (F, n) rows of each facet, those without an equation first
    none: np.ndarray  # (F,) how many have none
    fronts: list[Front]

    def eliminate(self, branch: Branch) -> np.ndarray | None:
        """Eliminate a branch; append its fronts; return the rest, as the branch above takes it."""
        halves = [self.eliminate(half) for half in branch.halves]
        step = next(self.steps)
        inner = step.inner
        if branch.facet >= 0:
            rows = self.rows[branch.facet, self.none[branch.facet] :]
            matrix = next(self.matrices)
            if not inner and step.sort is not None:
                return _pick(matrix, rows[step.sort])
            front = _pick(matrix, rows)
            blocks = [front[:inner, :inner], front[:inner, inner:], front[inner:, inner:]]
        else:
            blocks = _add_halves(inner, step.sizes, halves)
        pivot, coupling, rest = (np.ascontiguousarray(block) for block in blocks)
        if inner:
            start = self.fronts[-1].inner.stop if self.fronts else 0
            back = _eliminate_front(pivot, coupling, rest)
            self.fronts.append(Front(slice(start, start + inner), step.outer, back))
        return None if step.sort is None else _pick(rest, step.sort)


def _pick(matrix: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Some rows of a matrix, and the same columns."""
    return matrix.take(rows, axis=0).take(rows, axis=1)


def _add_halves(
    inner: int, sizes: tuple[int, int, int], halves: list[np.ndarray]
) -> list[np.ndarray]:
    """Sum two halves into the blocks inner-inner, inner-outer and outer-outer.

    `sizes` are the outer equations of the first half only, of both, and of the second only.
    """
    first, second = halves
    only, end, size = np.cumsum(sizes).tolist()
    coupling, rest = np.empty((inner, size)), np.empty((size, size))
    coupling[:, :end] = first[:inner, inner:]
    coupling[:, end:] = 0.0
    coupling[:, only:] += second[:inner, inner:]
    rest[:end, :end] = first[inner:, inner:]
    rest[end:] = 0.0
    rest[:end, end:] = 0.0
    rest[only:, only:] += second[inner:, inner:]
    return [first[:inner, :inner] + second[:inner, :inner], coupling, rest]


def _eliminate_front(pivot: np.ndarray, coupling: np.ndarray, rest: np.ndarray) -> np.ndarray:
    """Eliminate the inner equations: `back` of the front. `rest` becomes the Schur complement."""
    diagonal, inner = np.diag(pivot).copy(), len(pivot)
    lower, failed = dpotrf(pivot.T, lower=1, clean=1, overwrite_a=1)
    if failed or (np.diag(lower) ** 2 <= ROUNDING * diagonal).any():
        raise NotPositiveDefinite("a direction has no positive stiffness")
    back = np.empty((inner, inner + coupling.shape[1]))
    if coupling.size:
        # the transposes are in Fortran's order: all is done in place
        dtrsm(1.0, lower, coupling.T, side=1, lower=1, trans_a=1, overwrite_b=1)
        dsyrk(-1.0, coupling.T, 1.0, rest.T, lower=1, overwrite_c=1)
        _mirror(rest)
        dtrsm(-1.0, lower, coupling.T, side=1, lower=1, overwrite_b=1)
        back[:, inner:] = coupling
    inverse, _ = dtrtri(lower, lower=1, overwrite_c=1)
    back[:, :inner] = inverse.T
    return back


def _mirror(matrix: np.ndarray) -> None:
    """Copy the upper triangle onto the lower one, block by block."""
    for start in range(0, len(matrix), BLOCK):
        end = min(start + BLOCK, len(matrix))
        matrix[start:end, :start] = matrix[:start, start:end].T
        square = matrix[start:end, start:end]
        np.copyto(square, square.T, where=BELOW[: end - start, : end - start])
