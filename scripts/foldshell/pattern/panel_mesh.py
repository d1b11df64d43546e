"""Panels of any crease pattern or folded sheet: polygons, their creases, the states they have."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from foldshell.files.meshes.triangles import split_polygons
from foldshell.pattern.panel_graph import Ragged, find_sides, group_panels, trace_borders

ASSIGNMENTS = {
    "B": "border", "M": "mountain", "V": "valley", "F": "flat", "U": "not assigned",
    "C": "cut", "N": "cut inside a panel",
}  # fmt: skip
OBTUSE, TOO_OBTUSE = math.radians(145), math.radians(155)
"""Largest angle of a facet: from the first on buckling factors err, above the second grossly."""
WARPED = 0.005  # of a panel's diagonal: from there on it is said that a panel is cut into facets


@dataclass(frozen=True)
class PanelMesh:
    """Panels over shared vertices; coordinates (V, 3) in m as they stand in the file.

    `flat`, `rest` and `folded` are the states that are known, None where one is not. `edges`
    (E, 2) have `assignments` (E,), letters of ASSIGNMENTS as in FOLD, and `fold_angles` (E,) in
    rad, valley positive, nan where none is given. `labels` name integers of vertices, edges or
    panels, `sets` name rows; `notes` say what a reader mended or wants known.
    """

    panels: Ragged
    edges: np.ndarray
    assignments: np.ndarray
    fold_angles: np.ndarray
    flat: np.ndarray | None = None
    rest: np.ndarray | None = None
    folded: np.ndarray | None = None
    labels: Mapping[str, np.ndarray] = field(default_factory=dict)
    sets: Mapping[str, np.ndarray] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    @property
    def vertices(self) -> np.ndarray:
        """The state (V, 3) m that panels are measured in: folded, else rest, else flat."""
        for state in (self.folded, self.rest, self.flat):
            if state is not None:
                return state
        raise ValueError("a panel mesh without any state")

    @cached_property
    def _split(self) -> tuple[np.ndarray, np.ndarray]:
        return split_polygons(self.vertices, self.panels.starts, self.panels.corners)

    @property
    def facets(self) -> np.ndarray:
        """Triangles (F, 3) of all panels, cut along diagonals inside them.

        They are vertex numbers.
        """
        return self._split[0]

    @property
    def facet_panel(self) -> np.ndarray:
        """Panel (F,) of each facet. It is a number."""
        return self._split[1]

    @cached_property
    def edge_panels(self) -> np.ndarray:
        """Number of panels (E,) at each edge: 1 on the border."""
        sides, _, number = find_sides(self.panels)
        known = {tuple(side): count for side, count in zip(sides.tolist(), number, strict=True)}
        return np.array([known.get(tuple(sorted(edge)), 0) for edge in self.edges.tolist()])

    @cached_property
    def borders(self) -> list[np.ndarray]:
        """Border loops (k,) of vertex numbers, in the order of the panels' own turn."""
        return trace_borders(self.panels)

    @cached_property
    def components(self) -> np.ndarray:
        """Number of the part (P,) that each panel belongs to, joined over edges."""
        return group_panels(self.panels)

    def measure_warp(self) -> np.ndarray:
        """Largest distance of a corner to the panel's mean plane, over the diagonal (P,).

        The ratio has no unit.
        """
        return measure_warp(self.vertices, self.panels)


def measure_warp(vertices: np.ndarray, panels: Ragged) -> np.ndarray:
    """Largest distance of a corner to the mean plane of its panel, over its longest diagonal (P,).

    vertices (V, 3) m; the plane is that of least squares.
    """
    warp = np.zeros(len(panels))
    for k, corners in enumerate(panels):
        if len(corners) > 3:
            points = vertices[corners] - vertices[corners].mean(axis=0)
            normal = np.linalg.svd(points)[2][2]
            longest = np.linalg.norm(points[:, None] - points[None], axis=2).max()
            warp[k] = np.abs(points @ normal).max() / longest if longest > 0 else 0.0
    return warp


def measure_largest_angle(vertices: np.ndarray, facets: np.ndarray) -> np.ndarray:
    """Largest angle (F,) [rad] of triangles (F, 3)."""
    corners = vertices[facets]
    angles = []
    for k in range(3):
        one = corners[:, (k + 1) % 3] - corners[:, k]
        two = corners[:, (k + 2) % 3] - corners[:, k]
        sine = np.linalg.norm(np.cross(one, two), axis=1)
        angles.append(np.arctan2(sine, (one * two).sum(axis=1)))
    return np.max(angles, axis=0)
