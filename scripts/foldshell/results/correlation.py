"""Correlation of two series of numbers, nan where one of them does not vary."""

import numpy as np


def rank_correlation(first: np.ndarray, second: np.ndarray) -> float:
    """Return Spearman's rank correlation; equal values share the mean of their ranks.

    first and second (N,) in any unit.
    """
    return linear_correlation(_rank(first), _rank(second))


def _rank(values: np.ndarray) -> np.ndarray:
    """Return the same as `scipy.stats.rankdata`, whose import takes longer than a chart."""
    _, place, count = np.unique(values, return_inverse=True, return_counts=True)
    return (np.cumsum(count) - (count - 1) / 2)[place]


def linear_correlation(first: np.ndarray, second: np.ndarray) -> float:
    """Return Pearson's correlation of first and second (N,), in any unit."""
    if np.ptp(first) == 0 or np.ptp(second) == 0:
        return float("nan")
    return float(np.corrcoef(first, second)[0, 1])
