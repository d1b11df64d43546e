"""Weights of a planar patch's corners for a place in plan."""

import numpy as np

ON_SIDE = 1e-9
"""Distance in plan (m) up to which a place lies on a side."""


def find_weights(space: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Return weights (k,) of a planar patch's corners (k, 3) m for a place (2,) m in plan.

    They sum to one; on a side those of its ends alone are not 0.
    """
    plan = space[:, :2]
    following = np.roll(plan, -1, axis=0)
    along = following - plan
    squared = (along**2).sum(axis=1)
    share = np.clip(((place - plan) * along).sum(axis=1) / np.where(squared > 0, squared, 1), 0, 1)
    away = np.linalg.norm(plan + share[:, None] * along - place, axis=1)
    weights = np.zeros(len(plan))
    k = int(away.argmin())
    if away[k] <= ON_SIDE:
        weights[k], weights[(k + 1) % len(plan)] = 1 - share[k], share[k]
        return weights
    best = max(range(1, len(plan) - 1), key=lambda m: _least_weight(plan, m, place))
    weights[[0, best, best + 1]] = _barycentric(plan[[0, best, best + 1]], place)
    return weights


def _barycentric(plan: np.ndarray, place: np.ndarray) -> np.ndarray:
    matrix = np.vstack([plan.T, np.ones(3)])
    return np.linalg.solve(matrix, np.append(place, 1.0))


def _least_weight(plan: np.ndarray, m: int, place: np.ndarray) -> float:
    corners = plan[[0, m, m + 1]]
    one, two = corners[1] - corners[0], corners[2] - corners[0]
    if abs(one[0] * two[1] - one[1] * two[0]) < 1e-12 * (one @ one + two @ two):
        return -np.inf
    return float(_barycentric(corners, place).min())
