"""Correlation of two series of numbers, nan where one of them does not vary."""

import numpy as np


def rank_correlation(first: np.ndarray, second: np.ndarray) -> float:
    """Return Spearman's rank correlation."""
    from scipy.stats import rankdata

    return linear_correlation(rankdata(first), rankdata(second))


def linear_correlation(first: np.ndarray, second: np.ndarray) -> float:
    """Return Pearson's correlation."""
    if np.ptp(first) == 0 or np.ptp(second) == 0:
        return float("nan")
    return float(np.corrcoef(first, second)[0, 1])
