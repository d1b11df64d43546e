"""Multifrontal Cholesky over a bisection of the facets: dense fronts, LAPACK inside.

K = L L^T for a matrix given as a sum of small dense ones. A tree halves the facets; at each
branch the unknowns that no facet outside it touches are eliminated from a dense front.
Source: Duff and Reid, ACM Trans. Math. Softw. 9 (1983) 302-325. On the dense couplings of
condensed facets it takes a tenth of the time of SuperLU, which stays as a check in the tests.

The order is planned with groups of unknowns (a vertex, the inside of an edge), which are the same
on every mesh of a shell: one plan serves them all. What two halves share and what ends there is
known before any number, so that each half leaves its rows in the order in which the front above
takes them: adding two halves up is then a matter of slices. The matrices are taken one by one, so
that they need not all stand in memory.
"""

from collections.abc import Iterable, Iterator
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


@dataclass
class Branch:
    """A part of the facets, by groups of unknowns.

    `outer` are the groups left over, in the order in which they stand after the elimination;
    `sort` rearranges them to the order of the branch above. `only` and `shared` count those of
    one half and of both.
    """

    inner: list[int]
    outer: list[int]
    met: dict[int, int]  # how many facets of the part touch each of `outer`
    halves: tuple["Branch", ...] = ()
    facet: int = -1
    only: tuple[int, int] = (0, 0)
    shared: int = 0
    sort: list[int] | None = None


@dataclass(frozen=True)
class Plan:
    """The order of elimination: the tree's root, and the facets in the order they are needed."""

    root: Branch
    facets: np.ndarray  # (F,)


@dataclass(frozen=True)
class Spans:
    """The equations of each group: `count` of them, from `start`; both (G,)."""

    start: np.ndarray
    count: np.ndarray

    def list_equations(self, groups: list[int]) -> np.ndarray:
        """The equations (n,) of some groups, one group after the other, as numbers."""
        return _list_ranges(self.start[groups], self.count[groups])

    def count_equations(self, groups: list[int]) -> int:
        """How many those are."""
        return int(self.count[groups].sum())


def _list_ranges(start: np.ndarray, count: np.ndarray) -> np.ndarray:
    """start, start + 1, ... of each range, one range after the other."""
    end = np.cumsum(count)
    return np.repeat(start - end + count, count) + np.arange(end[-1] if len(end) else 0)


def plan_elimination(groups: np.ndarray, links: np.ndarray, centres: np.ndarray) -> Plan:
    """Plan for facets with `groups` (F, g); each stands in a facet once.

    Those in `links` (F, l), -1 for none, and `centres` (F, 3) guide the bisection.

    `groups` and `links` are numbers, `centres` are m.
    """
    tree = bisect(links, centres)
    uses = np.bincount(groups.ravel()).tolist()
    facets: list[int] = []
    root = _plan(tree, np.sort(groups, axis=1).tolist(), uses, facets)
    return Plan(root, np.array(facets))


def _plan(tree: Tree, groups: list[list[int]], uses: list[int], facets: list[int]) -> Branch:
    """Find what each part eliminates and leaves; append its facets."""
    if isinstance(tree, int):
        facets.append(tree)
        inner = [g for g in groups[tree] if uses[g] == 1]
        outer = [g for g in groups[tree] if uses[g] > 1]
        return Branch(inner, outer, dict.fromkeys(outer, 1), facet=tree)
    first, second = (_plan(half, groups, uses, facets) for half in tree)
    at = {group: k for k, group in enumerate(first.outer)}
    met = first.met | second.met
    ends: list[tuple[int, int]] = []  # places in the first and in the second half
    stays: list[tuple[int, int]] = []
    for k, group in enumerate(second.outer):
        if group in at:
            met[group] = first.met[group] + second.met[group]
            (ends if met[group] == uses[group] else stays).append((at[group], k))
    mine = [k for k, group in enumerate(first.outer) if group not in second.met]
    yours = [k for k, group in enumerate(second.outer) if group not in at]
    first.sort = [k for k, _ in ends] + mine + [k for k, _ in stays]
    second.sort = [k for _, k in ends] + [k for _, k in stays] + yours
    inner = [first.outer[k] for k, _ in ends]
    outer = [first.outer[k] for k in first.sort[len(ends) :]] + [second.outer[k] for k in yours]
    return Branch(
        inner,
        outer,
        {group: met[group] for group in outer},
        (first, second),
        only=(len(mine), len(yours)),
        shared=len(stays),
    )


def factor_sum(
    matrices: Iterable[np.ndarray], plan: Plan, place: np.ndarray, spans: Spans
) -> Factor:
    """Factor K = sum of matrices (n, n) at equations `place` (F, n), -1 for none.

    `matrices` come in the order of `plan.facets`; `spans` says which equations a group stands for,
    rising with the groups. Raises NotPositiveDefinite.

    Matrices in kN/m, kN and kNm.
    """
    branches = list(_list_branches(plan.root))
    order = np.concatenate([spans.list_equations(branch.inner) for branch in branches])
    size = int(spans.count.sum())
    turn = np.full(size, -1)  # when an equation is eliminated: never, if no facet has it
    turn[order] = np.arange(len(order))
    # rows of a facet that end in it come first, as in its branch
    alone = np.bincount(place[place >= 0], minlength=size) == 1
    key = np.where(place < 0, -1, place + np.where(alone[place], 0, size))
    rows, none = np.argsort(key, axis=1), (place < 0).sum(axis=1)
    work = _Elimination(iter(matrices), _plan_steps(branches, spans, turn), rows, none, [])
    work.eliminate(plan.root)
    return Factor(order, tuple(work.fronts))


def _list_branches(branch: Branch) -> Iterator[Branch]:
    """All branches, halves before the whole."""
    for half in branch.halves:
        yield from _list_branches(half)
    yield branch


@dataclass(frozen=True)
class _Step:
    """A branch by equations: how many it eliminates, how many of those left over the first half
    alone has, both, and the second alone; the turns of these, and `sort` of the branch."""

    inner: int
    sizes: tuple[int, int, int]
    outer: np.ndarray
    sort: np.ndarray | None


def _plan_steps(branches: list[Branch], spans: Spans, turn: np.ndarray) -> Iterator[_Step]:
    """The steps of all branches, one after the other; `turn` (size,) of the equations.

    Lists of all branches are made at once: one by one they took longer than small fronts.
    """
    groups = np.array([group for branch in branches for group in branch.outer], dtype=np.int64)
    first = np.cumsum([0] + [len(branch.outer) for branch in branches])
    count = spans.count[groups]
    end = np.concatenate([[0], np.cumsum(count)])  # equations before each group
    outer = turn[spans.list_equations(groups)]
    sorts = [np.array(branch.sort or [], dtype=np.int64) for branch in branches]
    places = np.concatenate([place + at for place, at in zip(sorts, first, strict=False)])
    sizes = count[places]
    base = np.repeat(end[first[:-1]], [len(place) for place in sorts])
    sort = _list_ranges(end[places] - base, sizes)
    ends = np.concatenate([[0], np.cumsum(sizes)])[np.cumsum([0] + [len(one) for one in sorts])]
    for k, branch in enumerate(branches):
        only, low, high = branch.only[0], first[k], first[k + 1]
        cuts = end[[low, low + only, low + only + branch.shared, high]].tolist()
        yield _Step(
            spans.count_equations(branch.inner),
            (cuts[1] - cuts[0], cuts[2] - cuts[1], cuts[3] - cuts[2]),
            outer[cuts[0] : cuts[3]],
            None if branch.sort is None else sort[ends[k] : ends[k + 1]],
        )


@dataclass
class _Elimination:
    """What a factorisation needs at every branch, and the fronts that it leaves."""

    matrices: Iterator[np.ndarray]
    steps: Iterator[_Step]  # halves before the whole
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
