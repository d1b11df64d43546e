"""Second-order theory (Th.II): equilibrium in which each combination's own forces act on it.

(K + K_g(N(u_c))) u_c = F_c with small displacements. One factor of K serves all combinations:
u <- K^-1 (F - K_g(N(u)) u), accelerated by Anderson's method (Walker & Ni 2011).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from foldshell.files.threads import run_parts

DEPTH = 6
"""Steps that Anderson's method remembers."""


@dataclass(frozen=True)
class SecondOrderResult:
    """Displacements (free, c), most iterations of a column, the relative change of each column (c,)
    that one more iteration is expected to bring, and whether every column met the tolerance."""

    displacement: np.ndarray
    iterations: int
    residual: np.ndarray
    converged: bool


def solve_second_order(
    first_order: np.ndarray,
    correction: Callable[[np.ndarray, np.ndarray], np.ndarray],
    tolerance: float = 1e-8,
    iterations_max: int = 60,
    start: np.ndarray | None = None,
) -> SecondOrderResult:
    """Find u = u_linear + correction(u) for all columns at once.

    Parameters
    ----------
    first_order : (free, c) first-order displacements
    correction : maps (u (free, k), numbers of the k columns) to -K^-1 K_g(N(u)) u, (free, k)
    tolerance : largest expected change, relative to the largest displacement of the column: the
        last change times the greater of the last two rates at which changes fell
    iterations_max : limit on evaluations of `correction`
    start : (free, c) displacements near the answer to begin with, by default those of first order
    """
    search = SecondOrderSearch(first_order, correction, start=start)
    return search.run(tolerance, iterations_max)


class SecondOrderSearch:
    """The iteration of `solve_second_order`, which a second run takes up where the first left it.

    `begin` (free, c) is the correction of the first-order state, None where it is not known yet;
    `start` (free, c) where it begins, None for the first-order state.
    """

    def __init__(
        self,
        first_order,
        correction,
        begin: np.ndarray | None = None,
        start: np.ndarray | None = None,
    ) -> None:
        self._correction, count = correction, first_order.shape[1]
        # displacements stand in rows: sums over long columns of an array would skip through it
        self._first = np.array(first_order.T, order="C")
        self._begin = None if begin is None else begin.T
        self._current = self._first.copy() if start is None else np.array(start.T, order="C")
        self._changes = np.full((3, count), np.inf)
        self._memory = [_AndersonColumn() for _ in range(count)]
        self._iterations = np.zeros(count, dtype=int)

    def run(
        self, tolerance: float, iterations_max: int = 60, rates: np.ndarray | None = None
    ) -> SecondOrderResult:
        """Iterate until every column meets the tolerance, each as often as it would alone.

        `rates` (c,) without unit are those at which changes are known to fall; they stand in for
        rates that have not been seen yet.
        """
        residual = self._expect(rates)
        while np.isfinite(self._current).all():
            active = ~(residual <= tolerance) & (self._iterations < iterations_max)
            if not active.any():
                break
            self._advance(np.flatnonzero(active))
            residual = self._expect(rates)
        met = bool((residual <= tolerance).all())
        times = int(self._iterations.max(initial=0))
        return SecondOrderResult(self._current.T.copy(), times, residual, met)

    def _advance(self, active: np.ndarray) -> None:
        """Take one step of the active columns (k,), numbers of columns."""
        if self._begin is None:
            image = self._correction(self._current[active].T, active).T
        else:
            image, self._begin = self._begin[active], None
        image = self._first[active] + image
        self._iterations[active] += 1
        list(run_parts(self._take_step, list(zip(active, image, strict=True))))

    def _take_step(self, one: tuple[int, np.ndarray]) -> None:
        """Go from the state of a column towards its image (free,)."""
        column, image = one
        current = self._current[column]
        step = image - current
        scale = np.abs(image).max() or 1.0
        self._changes[:, column] = [*self._changes[1:, column], np.abs(step).max() / scale]
        self._current[column] = self._memory[column].advance(current, step)

    def _expect(self, rates: np.ndarray | None) -> np.ndarray:
        """Return the changes (c,) that one more iteration would bring."""
        every = np.full(len(self._first), np.nan) if rates is None else rates
        pairs = zip(self._changes.T.tolist(), every.tolist(), strict=True)
        return np.array([_expect_change(*changes, rate) for changes, rate in pairs])


def _expect_change(first: float, second: float, third: float, rate: float) -> float:
    """Return the change that follows three others.

    While fewer are known it is the last one, or that times the known rate where there is one.
    """
    if third == 0 or not np.isfinite(third):
        return third
    if np.isfinite(first):
        return third * min(1.0, max(second / first, third / second))
    if not np.isfinite(rate):
        return third
    return third * min(1.0, max(rate, third / second if np.isfinite(second) else 0.0))


class _AndersonColumn:
    """Anderson's update of one column from the differences of its last steps."""

    def __init__(self) -> None:
        self._point: np.ndarray | None = None
        self._step: np.ndarray | None = None
        self._step_change: list[np.ndarray] = []
        self._image_change: list[np.ndarray] = []

    def advance(self, point: np.ndarray, step: np.ndarray) -> np.ndarray:
        """Return the next point from this one and its fixed-point step."""
        if self._point is not None:
            change = step - self._step
            self._step_change = [*self._step_change[1 - DEPTH :], change]
            change = point - self._point + change
            self._image_change = [*self._image_change[1 - DEPTH :], change]
        self._point, self._step = point.copy(), step
        if not self._step_change:
            return point + step
        step_change = np.array(self._step_change)
        gram = step_change @ step_change.T
        gram[np.diag_indices_from(gram)] *= 1 + 1e-12
        weights = np.linalg.lstsq(gram, step_change @ step, rcond=1e-14)[0]
        return point + step - weights @ np.array(self._image_change)
