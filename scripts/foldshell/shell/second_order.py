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
    """Displacements (free, c), iterations, the relative change of each column (c,) that one more
    iteration is expected to bring, and whether every column met the tolerance."""

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
    current = (first_order if start is None else start).copy()
    residual = np.full(first_order.shape[1], np.inf)
    changes = np.full((3, first_order.shape[1]), np.inf)
    memory = [_AndersonColumn() for _ in range(first_order.shape[1])]
    iterations = 0

    def advance(one: tuple[int, np.ndarray]) -> None:
        """Take the step to the image (free,) of a column."""
        column, image = one
        step = image - current[:, column]
        scale = np.abs(image).max() or 1.0
        changes[:, column] = [*changes[1:, column], np.abs(step).max() / scale]
        residual[column] = _expect_change(*changes[:, column])
        current[:, column] = memory[column].advance(current[:, column], step)

    while iterations < iterations_max:
        active = np.flatnonzero(~(residual <= tolerance))
        if not len(active) or not np.isfinite(current).all():
            break
        image = first_order[:, active] + correction(current[:, active], active)
        iterations += 1
        list(run_parts(advance, list(zip(active, image.T, strict=True))))
    return SecondOrderResult(current, iterations, residual, bool((residual <= tolerance).all()))


def _expect_change(first: float, second: float, third: float) -> float:
    """Return the change that follows three others; the last one while fewer are known."""
    if not np.isfinite(first) or third == 0:
        return third
    return third * min(1.0, max(second / first, third / second))


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
