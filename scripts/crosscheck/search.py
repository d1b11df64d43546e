"""Iterations that share one sweep through the factor.

A solve takes the time in which the factor is read from memory, nearly the same for six cases as
for two. Each iteration is a generator: it yields local forces (F, R, 5, c), is sent their
`Solution`, and returns what it finds or raises NotSettled.
"""

from collections.abc import Generator
from dataclasses import replace

import numpy as np

from crosscheck.system import Solution, System, solve_facets

Steps = Generator[np.ndarray, Solution, object]


class NotSettled(ValueError):
    """The iteration found no state: the load is beyond buckling, or next to it."""


class Search:
    """An iteration under way: `request` are the forces it waits for, None at its end.

    Then `result` is what it returned, None where it did not settle, with `error`.
    """

    def __init__(self, steps: Steps) -> None:
        self.steps = steps
        self.result = self.error = None
        self.advance(None)

    def advance(self, solution: Solution | None) -> None:
        """Hand over the answer to the last request."""
        self.request = None
        try:
            self.request = self.steps.send(solution)
        except StopIteration as end:
            self.result = end.value
        except NotSettled as error:
            self.error = error


def solve_together(system: System, *searches: Search) -> None:
    """Solve for the requests of all searches at once, and let each go one step on."""
    waiting = [search for search in searches if search.request is not None]
    ends = np.cumsum([search.request.shape[-1] for search in waiting])
    forces = [search.request for search in waiting]
    whole = solve_facets(system, np.concatenate(forces, axis=-1) if len(forces) > 1 else forces[0])
    for search, end in zip(waiting, ends, strict=True):
        part = slice(end - search.request.shape[-1], end)
        search.advance(_pick_cases(whole, part))


def _pick_cases(whole: Solution, part: slice) -> Solution:
    """Some columns; all are left as they are."""
    if part == slice(0, whole.local.shape[-1]):
        return whole
    local = np.ascontiguousarray(whole.local[..., part])
    return replace(whole, local=local, found=whole.found[..., part], load=whole.load[..., part])


def run_alone(system: System, steps: Steps) -> object:
    """What one iteration finds by itself. Raises NotSettled."""
    search = Search(steps)
    while search.request is not None:
        solve_together(system, search)
    if search.error is not None:
        raise search.error
    return search.result
