"""Panels and creases from facets: boundary loops, planarity, fold angles, for any panel mesh."""

from dataclasses import dataclass

import numpy as np

from foldshell.pattern.angles import measure_hinges

FLAT = np.radians(0.01)
"""An edge between panels that folds less counts as flat."""


@dataclass(frozen=True)
class Edges:
    """Edges of a facet mesh: `ends` (E, 2), facets `left` and `right` (E,) of the direction first
    to second, -1 for none, and fold `angle` (E,) rad, valley positive, nan with one facet."""

    ends: np.ndarray
    left: np.ndarray
    right: np.ndarray
    angle: np.ndarray


def find_edges(vertices: np.ndarray, facets: np.ndarray) -> Edges:
    """Find the edges of facets (F, 3) that agree in their sense of rotation.

    Each edge runs as in its first facet, which is on its left. An edge of more than two facets is
    left once for each further one, with that facet alone on its left.

    vertices (V, 3) m.
    """
    start, end = facets.ravel(), np.roll(facets, -1, axis=1).ravel()
    opposite = np.roll(facets, -2, axis=1).ravel()
    owner = np.repeat(np.arange(len(facets)), 3)
    seen: dict[tuple[int, int], int] = {}
    ends, left, right, across = [], [], [], []
    for a, b, c, facet in zip(start.tolist(), end.tolist(), opposite, owner, strict=True):
        row = seen.pop((b, a), None)
        if row is None:
            seen[a, b] = len(ends)
            ends.append((a, b))
            left.append(facet)
            right.append(-1)
            across.append((c, -1))
        else:
            right[row] = facet
            across[row] = (across[row][0], c)
    ends, across = np.array(ends), np.array(across)
    two = across[:, 1] >= 0
    angle = np.full(len(ends), np.nan)
    angle[two] = measure_hinges(vertices, np.column_stack([ends, across])[two])
    return Edges(ends, np.array(left), np.array(right), angle)


def find_loops(edges: Edges, facet_panel: np.ndarray) -> dict[int, np.ndarray]:
    """Return the corners (k,) of each panel, counter-clockwise: its edges one after the other.

    As numbers of vertices.
    """
    left, right = facet_panel[edges.left], np.where(edges.right < 0, -1, facet_panel[edges.right])
    follow: dict[int, dict[int, int]] = {}
    for (a, b), one, two in zip(edges.ends.tolist(), left.tolist(), right.tolist(), strict=True):
        if one == two:
            continue
        follow.setdefault(one, {})[a] = b
        if two >= 0:
            follow.setdefault(two, {})[b] = a
    loops = {}
    for panel, after in follow.items():
        first = min(after)
        corners = [first]
        while (step := after[corners[-1]]) != first and len(corners) <= len(after):
            corners.append(step)
        loops[panel] = np.array(corners)
    return loops


def fit_plane(points: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """Return centre, unit normal and largest distance (m) of the best plane through (k, 3)."""
    centre = points.mean(axis=0)
    _, _, axes = np.linalg.svd(points - centre)
    return centre, axes[2], float(np.abs((points - centre) @ axes[2]).max())


def classify(angle: float) -> str:
    """Return M, V, F (flat) or B for a fold angle in rad, nan on the border."""
    if np.isnan(angle):
        return "B"
    if abs(angle) < FLAT:
        return "F"
    return "V" if angle > 0 else "M"
