"""Panels of folded.npz, those of a crease grid and those of any other sheet alike."""

import numpy as np

from foldshell.pattern.panel_graph import Ragged
from foldshell.records.sheet_arrays import FoldedArrays

KINDS = ("B", "M", "V", "F", "U")
"""Letters of the numbers that folded.npz gives sides of panels."""


def list_panels(folded: FoldedArrays) -> Ragged:
    """Return the vertices of all panels."""
    if folded.quads is not None:
        return Ragged(4 * np.arange(len(folded.quads) + 1), folded.quads.ravel())
    return Ragged(folded.panel_starts, folded.panel_corners)


def list_facet_panels(folded: FoldedArrays) -> np.ndarray:
    """Return the panel (T,) of each facet. They are numbers."""
    if folded.facet_panel is None:
        return np.repeat(np.arange(len(folded.quads)), 2)
    return folded.facet_panel


def measure_middles(folded: FoldedArrays) -> np.ndarray:
    """Return the mean (P, 3) m of the corners of each panel."""
    return average_corners(folded.vertices, list_panels(folded))


def average_corners(vertices: np.ndarray, panels: Ragged) -> np.ndarray:
    """Return the mean (P, 3) of the corners of each panel. vertices (V, 3) m."""
    total = np.add.reduceat(vertices[panels.corners], panels.starts[:-1], axis=0)
    return total / np.diff(panels.starts)[:, None]


def measure_panel_areas(folded: FoldedArrays) -> np.ndarray:
    """Return the area (P,) m2 of each panel, the sum of its facets."""
    corners = folded.vertices[folded.facets]
    double = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return np.bincount(list_facet_panels(folded), np.linalg.norm(double, axis=1) / 2)


def number_kinds(assignments: np.ndarray) -> np.ndarray:
    """Return the numbers (X,) of letters (X,) as in FOLD; cuts are borders."""
    letters = np.where(assignments == "C", "B", np.where(assignments == "N", "F", assignments))
    return np.argmax(letters[:, None] == np.array(KINDS), axis=1)
