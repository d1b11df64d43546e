"""Whether a sheet has folds, by the mean angle between its facets."""

from collections.abc import Mapping

import numpy as np

SHARP = np.radians(20)
"""Mean angle between neighbouring facets from which a sheet counts as folded."""

FLAT = np.radians(1)
"""Angle up to which two facets count as one plane."""


def is_folded(folded: Mapping[str, np.ndarray]) -> bool:
    """Tell whether a sheet has folds: arrays of folded.npz, vertices (V, 3) m, facets (F, 3)."""
    return measure_mean_fold(folded["vertices"], folded["facets"]) >= SHARP


def measure_mean_fold(vertices: np.ndarray, facets: np.ndarray) -> float:
    """Return the mean angle (rad) between neighbouring facets that are not one plane, 0 for none.

    A panel's own two facets and those of a flat sheet do not count.

    vertices (V, 3) m, facets (F, 3).
    """
    a, b, c = vertices[facets].swapaxes(0, 1)
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    edges = np.sort(facets[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    _, which, count = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
    order = np.argsort(which.ravel(), kind="stable")
    inner = order[count[which.ravel()[order]] == 2].reshape(-1, 2) // 3
    cosine = (normal[inner[:, 0]] * normal[inner[:, 1]]).sum(axis=1)
    angle = np.arccos(np.clip(cosine, -1, 1))
    bent = angle[angle > FLAT]
    return float(bent.mean()) if len(bent) else 0.0
