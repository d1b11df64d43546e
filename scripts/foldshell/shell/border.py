"""The border of a sheet in plan: its loop, corners, sides and straight runs."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foldshell.pattern.panel_graph import make_ragged, measure_area, trace_borders
from foldshell.shell.reference import EDGES

STRAIGHT = np.cos(np.radians(2))
"""Cosine of the angle in plan up to which two border edges are one straight run."""

THERE, NEAR = 1e-3, 0.2
"""Shares of the plan's diagonal: a vertex so near to a corner stands there; one so near may stand
for it."""


@dataclass(frozen=True)
class Border:
    """All border loops of triangles `facets` (F, 3) with panels (F,) on `vertices` (V, 3) m."""

    vertices: np.ndarray
    facets: np.ndarray
    facet_panel: np.ndarray

    @cached_property
    def loops(self) -> list[np.ndarray]:
        """Loops (k,) of vertex numbers, that of the largest area in plan first."""
        found = trace_borders(make_ragged(self.facets))
        area = [abs(measure_area(self.vertices[loop, :2])) for loop in found]
        return [found[k] for k in np.argsort(area)[::-1]]

    @cached_property
    def outer(self) -> np.ndarray:
        """The outer loop (k,), counter-clockwise in plan. It holds vertex numbers."""
        loop = self.loops[0]
        return loop if measure_area(self.vertices[loop, :2]) > 0 else loop[::-1]

    @cached_property
    def edges(self) -> np.ndarray:
        """All border edges (B, 2), the lower vertex first. They are vertex numbers."""
        rows = [np.column_stack([loop, np.roll(loop, -1)]) for loop in self.loops]
        return np.sort(np.concatenate(rows), axis=1)

    @cached_property
    def panels_at(self) -> np.ndarray:
        """Number of panels (V,) that meet at each vertex."""
        pairs = np.unique(
            np.column_stack([self.facets.ravel(), np.repeat(self.facet_panel, 3)]), axis=0
        )
        return np.bincount(pairs[:, 0], minlength=len(self.vertices))

    def find_corners(self, points: np.ndarray) -> np.ndarray:
        """Return the border vertex (K,) that stands for each corner (K, 2) m of an outline.

        A vertex that stands there is it. Else it is the nearest one with one panel, since a corner
        of the sheet may lie farther from it than the next vertex; where none is nearer than a fifth
        of the plan, the nearest of all.
        """
        loop = self.outer
        away = np.linalg.norm(self.vertices[loop, :2] - points[:, None], axis=2)
        single = np.where(self.panels_at[loop] == 1, away, np.inf)
        size = np.linalg.norm(np.ptp(self.vertices[loop, :2], axis=0))
        there, near = away.min(axis=1) <= THERE * size, single.min(axis=1) <= NEAR * size
        return loop[np.where(near & ~there, single.argmin(axis=1), away.argmin(axis=1))]

    def find_plan_corners(self) -> np.ndarray:
        """Return the numbers (4,) of the vertices at the corners of the plan's box, m.

        They run counter-clockwise from the least x and y; raises `ValueError` where they are no
        four in this order.
        """
        low, high = self.vertices[self.outer, :2].min(0), self.vertices[self.outer, :2].max(0)
        box = np.array([low, (high[0], low[1]), high, (low[0], high[1])])
        corners = self.find_corners(box)
        place = [int(np.flatnonzero(self.outer == corner)[0]) for corner in corners]
        steps = np.diff([*place, place[0]]) % len(self.outer)
        if len(set(place)) < 4 or steps.sum() != len(self.outer):
            raise ValueError("the border has no four corners")
        return corners

    def walk(self, start: int, end: int) -> np.ndarray:
        """Return the outer border's edges (k, 2) from one vertex to another, counter-clockwise.

        They are vertex numbers.
        """
        loop = np.roll(self.outer, -int(np.flatnonzero(self.outer == start)[0]))
        count = int(np.flatnonzero(loop == end)[0])
        return np.sort(np.column_stack([loop[:count], loop[1 : count + 1]]), axis=1)

    def find_runs(self) -> np.ndarray:
        """Number the straight run in plan that each border edge belongs to, (B,) as `edges`."""
        run, count = [], 0
        for loop in self.loops:
            step = self.vertices[np.roll(loop, -1), :2] - self.vertices[loop, :2]
            length = np.linalg.norm(step, axis=1)
            along = step / np.where(length > 0, length, 1)[:, None]
            straight = (along * np.roll(along, 1, axis=0)).sum(axis=1) >= STRAIGHT
            own = np.cumsum(~straight)
            if straight[0]:
                own[own == own[-1]] = own[0]
            run.append(own + count)
            count += len(loop) + 1
        return np.concatenate(run)


def panel_sides(facets: np.ndarray, facet_panel: np.ndarray) -> np.ndarray:
    """Return the sides of panels (C, 2), the lower vertex first: no cuts inside a panel.

    facets (F, 3) are vertices, facet_panel (F,) numbers.
    """
    edges = np.sort(facets[:, EDGES].reshape(-1, 2), axis=1)
    panel = np.repeat(facet_panel, 3)
    known, which, count = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
    low, high = np.full(len(known), panel.max() + 1), np.full(len(known), -1)
    np.minimum.at(low, which.ravel(), panel)
    np.maximum.at(high, which.ravel(), panel)
    return known[(count == 1) | (low != high)]
