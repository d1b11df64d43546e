"""Angles of facets, and which of them can be analysed."""

import numpy as np

from foldshell.files.errors import InputError

ANGLES = np.radians([4.0, 155.0])
"""Least and largest angle of a facet that can be analysed."""


def measure_angles(vertices: np.ndarray, facets: np.ndarray) -> np.ndarray:
    """Return the angles (F, 3) [rad] of facets (F, 3); vertices (V, 3) m."""
    corners = vertices[facets]
    one = np.roll(corners, -1, axis=1) - corners
    two = np.roll(corners, 1, axis=1) - corners
    sine = np.linalg.norm(np.cross(one, two), axis=2)
    return np.arctan2(sine, (one * two).sum(axis=2))


def find_bad_facets(vertices: np.ndarray, facets: np.ndarray) -> np.ndarray:
    """Tell which facets (F, 3) have an angle outside `ANGLES`, (F,) bool; vertices (V, 3) m."""
    angles = measure_angles(vertices, facets)
    return (angles.min(axis=1) < ANGLES[0]) | (angles.max(axis=1) > ANGLES[1])


def refuse_bad_facets(vertices: np.ndarray, facets: np.ndarray) -> None:
    """Raise `InputError` that names the worst facet (F, 3) outside `ANGLES`; vertices (V, 3) m."""
    bad = np.flatnonzero(find_bad_facets(vertices, facets))
    if not len(bad):
        return
    angles = np.degrees(measure_angles(vertices, facets[bad]))
    worst = int(np.maximum(angles.max(axis=1) - 155, 4 - angles.min(axis=1)).argmax())
    place = ", ".join(f"{value:.3f}" for value in vertices[facets[bad[worst]]].mean(axis=0))
    low, high = np.degrees(ANGLES)
    raise InputError(
        f"outline: it leaves {len(bad)} facets with angles below {low:g} or above {high:g} deg, "
        f"the worst from {angles[worst].min():.1f} to {angles[worst].max():.1f} deg about "
        f"({place}) m: move the outline a little there"
    )
