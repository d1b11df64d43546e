"""Parts of one large piece of work, as many at once as this process has threads for.

Which parts there are is for the caller to say, from the work alone: results have the same bytes
whatever the number of threads. Threads gain where the parts are long calls of compiled code.
"""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from itertools import pairwise
from typing import TypeVar

import numpy as np

Part, Result = TypeVar("Part"), TypeVar("Result")

MOST = 2
"""Threads that a job uses at most: more are starved by the memory they share."""

LARGE = 100_000
"""Freedoms from which on work is divided; smaller work is done whole."""

_USED = [1]


def count_threads() -> int:
    """Return how many parts this process works on at once."""
    return _USED[0]


def use_threads(count: int) -> None:
    """Let this process work on `count` parts at once, from 1 to `MOST`."""
    _USED[0] = max(1, min(int(count), MOST))


def run_parts(task: Callable[[Part], Result], parts: Sequence[Part]) -> Iterator[Result]:
    """Yield the results of parts in their order."""
    if _USED[0] == 1 or len(parts) < 2:
        yield from map(task, parts)
        return
    yield from _open_pool(_USED[0]).map(task, parts)


def divide(count: int, size: int, least: int = 1) -> list[slice]:
    """Return slices of `count` rows or columns: one, or two of `size` freedoms from `LARGE` on.

    Neither of two has fewer than `least`.
    """
    if size < LARGE or count < 2 * least:
        return [slice(0, count)]
    return [slice(0, count // 2), slice(count // 2, count)]


def divide_rows(count: int, size: int, length: int = 1 << 16) -> list[slice]:
    """Return slices of `count` rows: one, or of `length` each for `LARGE` freedoms or more."""
    if size < LARGE:
        return [slice(0, count)]
    ends = np.append(np.arange(0, count, length), count).tolist()
    return [slice(a, b) for a, b in pairwise(ends)]


@lru_cache(maxsize=1)
def _open_pool(count: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(count)
