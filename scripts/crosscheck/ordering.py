"""The order in which a multifrontal elimination takes the unknowns of a bisected shell.

It is planned with groups of unknowns (a vertex, the inside of an edge), which are the same on every
mesh of a shell: one plan serves them all. What two halves share and what ends there is known before
any number.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from crosscheck.bisection import Tree, bisect


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


def list_branches(branch: Branch) -> Iterator[Branch]:
    """All branches, halves before the whole."""
    for half in branch.halves:
        yield from list_branches(half)
    yield branch


@dataclass(frozen=True)
class Step:
    """A branch by equations: how many it eliminates, how many of those left over the first half
    alone has, both, and the second alone; the turns of these, and `sort` of the branch."""

    inner: int
    sizes: tuple[int, int, int]
    outer: np.ndarray
    sort: np.ndarray | None


def plan_steps(branches: list[Branch], spans: Spans, turn: np.ndarray) -> Iterator[Step]:
    """The steps of all branches, one after the other; `turn` (size,) are numbers of equations.

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
        yield Step(
            spans.count_equations(branch.inner),
            (cuts[1] - cuts[0], cuts[2] - cuts[1], cuts[3] - cuts[2]),
            outer[cuts[0] : cuts[3]],
            None if branch.sort is None else sort[ends[k] : ends[k + 1]],
        )
