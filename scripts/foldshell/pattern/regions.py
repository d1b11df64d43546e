"""Which points lie in a region of the plan: a box or a simple polygon, its border included."""

import numpy as np

from foldshell.settings.regions import Region

TOLERANCE = 1e-9
"""Distance from the border, relative to the region's size, at which a point counts as inside."""


def mask_region(points: np.ndarray, region: Region) -> np.ndarray:
    """Return whether each point lies in a region, (...,) bool.

    Parameters
    ----------
    points : (..., 2) or (..., 3) m, of which x and y are looked at
    region : see `read_region`
    """
    return mask_polygon(points, np.array(region.corners))


def mask_box(points: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """low <= point <= high in x and y, (...,) bool.

    points (..., 2) or (..., 3), low and high (2,) m. A point is inside up to `TOLERANCE` of the
    box's longer side beyond its border.
    """
    low, high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    beyond = TOLERANCE * np.abs(high - low).max()
    plan = np.asarray(points)[..., :2]
    return ((plan >= low - beyond) & (plan <= high + beyond)).all(axis=-1)


def mask_polygon(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Return whether points lie in a simple polygon, convex or not, (...,) bool.

    A ray along +x crosses its sides an odd number of times from inside (even-odd rule). A point
    within `TOLERANCE` of the size of the polygon from a side counts as inside, so that it is found
    whichever way the polygon is turned.

    Parameters
    ----------
    points : (..., 2) or (..., 3) m, of which x and y are looked at
    corners : (K, 2) m, in either sense
    """
    corners = np.asarray(corners, dtype=float)
    origin = corners.mean(axis=0)
    plan = np.asarray(points, dtype=float)[..., :2] - origin
    first = corners - origin
    second = np.roll(first, -1, axis=0)
    beyond = TOLERANCE * np.ptp(first, axis=0).max()
    inside, near = np.zeros(plan.shape[:-1], dtype=bool), np.zeros(plan.shape[:-1], dtype=bool)
    for a, b in zip(first, second, strict=True):
        inside ^= _crosses(plan, a, b)
        near |= _distance(plan, a, b) <= beyond
    return inside | near


def _crosses(points: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Tell whether rays along +x from points (..., 2) cross a side, its lower end included."""
    low, high = (a, b) if a[1] <= b[1] else (b, a)
    between = (points[..., 1] >= low[1]) & (points[..., 1] < high[1])
    side = (high[0] - low[0]) * (points[..., 1] - low[1])
    side -= (high[1] - low[1]) * (points[..., 0] - low[0])
    return between & (side > 0)


def _distance(points: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the distance of points (..., 2) from the side a-b, (...,) m."""
    along = b - a
    share = np.clip((points - a) @ along / (along @ along), 0, 1)
    return np.linalg.norm(points - a - share[..., None] * along, axis=-1)
