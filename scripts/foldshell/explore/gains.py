"""What a design may gain: expected improvement of one aim, of the dominated area of two.

Expected improvement: Jones, Schonlau and Welch (1998), Efficient global optimization of expensive
black-box functions, eq. 15; area: Emmerich, Deutz and Klinkenberg (2011), Hypervolume-based
expected improvement: monotonicity properties and exact computation.
"""

import numpy as np


def expect_improvement(mean: np.ndarray, deviation: np.ndarray, best: float) -> np.ndarray:
    """EI = s (z Phi(z) + phi(z)), z = (best - mean) / s: of a value that is to be small.

    mean, deviation (k,) in the unit of `best`
    """
    from scipy.special import ndtr

    deviation = np.maximum(deviation, 1e-12)
    z = (best - mean) / deviation
    return deviation * (z * ndtr(z) + np.exp(-z * z / 2) / np.sqrt(2 * np.pi))


def hypervolume(front: np.ndarray, corner: np.ndarray) -> float:
    """Area (of the unit of both aims) that points (k, 2) dominate below a corner (2,)."""
    kept = front[(front < corner).all(axis=1)]
    area, height = 0.0, corner[1]
    for x, y in kept[np.argsort(kept[:, 0], kind="stable")]:
        if y < height:
            area += (corner[0] - x) * (height - y)
            height = y
    return area


def expect_front_gain(
    first: tuple[np.ndarray, np.ndarray],
    second: tuple[np.ndarray, np.ndarray],
    front: np.ndarray,
    corner: np.ndarray,
) -> np.ndarray:
    """E H = sum_i (EI1(x_i+1) - EI1(x_i)) EI2(y_i): expected gain (k,) of the dominated area.

    The area that a point (a, b) adds is that of all (x, y) above it that no point of the front
    dominates; strip by strip between the front's x, the integral of P(a < x) P(b < y) splits into
    two expected improvements (Emmerich, Deutz and Klinkenberg 2011). No unit.

    first, second : mean and deviation (k,) of either aim; front (n, 2); corner (2,) bounds the area
    """
    steps = _list_steps(front, corner)
    gain = np.zeros(len(first[0]))
    left = np.zeros(len(first[0]))
    for place, (_, height) in enumerate(steps):
        end = steps[place + 1][0] if place + 1 < len(steps) else corner[0]
        right = expect_improvement(*first, end)
        gain += (right - left) * expect_improvement(*second, height)
        left = right
    return gain


def _list_steps(front: np.ndarray, corner: np.ndarray) -> list[tuple[float, float]]:
    """Return where the strips beside a front (n, 2) begin, and up to where each is free."""
    steps = [(-np.inf, float(corner[1]))]
    for x, y in front[np.lexsort((front[:, 1], front[:, 0]))]:
        if x < corner[0] and y < steps[-1][1]:
            steps.append((float(x), float(y)))
    return steps
