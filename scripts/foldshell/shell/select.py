"""What a text of the table of supports names on a sheet: edges, and vertices that stand alone."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from foldshell.pattern.regions import mask_region
from foldshell.settings.where import (
    BORDER,
    CORNERS,
    EDGES,
    FIRST,
    LABEL,
    LAST,
    LEVEL,
    POINT,
    REGION,
    SIDE,
    SIDES,
    VERTICES,
    Term,
    read_where,
)
from foldshell.shell.border import Border, panel_sides

ON_SIDE = 0.3
"""Distance of a border edge to a side of the outline, over the mean side of panels, up to which it
stands for it: short sides of a cut are collapsed for analysis."""


@dataclass(frozen=True)
class HeldSheet:
    """What supports may name: triangles (F, 3) with panels (F,) on vertices (V, 3) m.

    `labels` number vertices (V,) by name; `outline` (K, 2) m is the polygon that the sheet was cut
    by, None without one.
    """

    vertices: np.ndarray
    facets: np.ndarray
    facet_panel: np.ndarray
    labels: Mapping[str, np.ndarray] = field(default_factory=dict)
    outline: np.ndarray | None = None

    @cached_property
    def border(self) -> Border:
        """Its border."""
        return Border(self.vertices, self.facets, self.facet_panel)

    @cached_property
    def sides(self) -> np.ndarray:
        """Sides of panels (C, 2), the lower vertex first. They are vertex numbers."""
        return panel_sides(self.facets, self.facet_panel)


@dataclass(frozen=True)
class Selection:
    """Masks of what is named: sides of panels (C,) and vertices (V,)."""

    edges: np.ndarray
    vertices: np.ndarray


def select(sheet: HeldSheet, text: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the edges (K, 2) that a text names, and those of its vertices (Q,) on none of them.

    Raises `ValueError` for what this sheet does not have. All are numbers of vertices.
    """
    edges = np.zeros(len(sheet.sides), dtype=bool)
    points = np.zeros(len(sheet.vertices), dtype=bool)
    for terms in read_where(text):
        found = [_select_term(sheet, term) for term in terms]
        edges |= np.all([one.edges for one in found], axis=0)
        points |= np.all([one.vertices for one in found], axis=0)
    pairs = sheet.sides[edges]
    points[pairs.ravel()] = False
    return pairs, np.flatnonzero(points)


def _select_term(sheet: HeldSheet, term: Term) -> Selection:
    if term.kind == REGION:
        return _within(sheet, mask_region(sheet.vertices, term.region))
    if term.kind == LEVEL:
        low, high = term.numbers[0]
        height, slack = sheet.vertices[:, 2], 1e-9 * np.abs(sheet.vertices).max()
        return _within(sheet, (height >= low - slack) & (height <= high + slack))
    if term.kind == LABEL:
        return _within(sheet, _mask_label(sheet, term))
    if term.kind in (BORDER, SIDE, EDGES):
        pairs = {BORDER: _border, SIDE: _side, EDGES: _edges}[term.kind](sheet, term)
        return _along(sheet, pairs)
    numbers = {CORNERS: _corners, VERTICES: _vertices, POINT: _nearest}[term.kind](sheet, term)
    chosen = np.zeros(len(sheet.vertices), dtype=bool)
    chosen[numbers] = True
    return Selection(np.zeros(len(sheet.sides), dtype=bool), chosen)


def _within(sheet: HeldSheet, inside: np.ndarray) -> Selection:
    used = np.zeros(len(sheet.vertices), dtype=bool)
    used[sheet.facets.ravel()] = True
    return Selection(inside[sheet.sides].all(axis=1), inside & used)


def _along(sheet: HeldSheet, pairs: np.ndarray) -> Selection:
    width = len(sheet.vertices)
    chosen = np.isin(sheet.sides @ [width, 1], np.sort(pairs, axis=1) @ [width, 1])
    points = np.zeros(width, dtype=bool)
    points[pairs.ravel()] = True
    return Selection(chosen, points)


def _mask_label(sheet: HeldSheet, term: Term) -> np.ndarray:
    if term.name not in sheet.labels:
        known = ", ".join(sheet.labels) or "it has none"
        raise ValueError(f"this sheet has no label {term.name} ({known})")
    values = sheet.labels[term.name]
    ends = {FIRST: values[values >= 0].min(), LAST: values.max()}
    number = ends[term.place] if term.place in ends else int(term.place)
    if number > ends[LAST]:
        raise ValueError(f"{term.name}={number}: the last one is {ends[LAST]}")
    return values == number


def _border(sheet: HeldSheet, _term: Term) -> np.ndarray:
    return sheet.border.edges


def _side(sheet: HeldSheet, term: Term) -> np.ndarray:
    if term.place not in SIDES:
        return _outline_side(sheet, int(term.place))
    corners = sheet.border.find_plan_corners()
    number = {"y_min": 0, "x_max": 1, "y_max": 2, "x_min": 3}[term.place]
    return sheet.border.walk(int(corners[number]), int(corners[(number + 1) % 4]))


def _outline_side(sheet: HeldSheet, number: int) -> np.ndarray:
    """Return the border edges of a side of the outline, counted from 1: those that lie nearer to
    it than to any other."""
    if sheet.outline is None:
        raise ValueError(f"side={number}: the design has no outline: {', '.join(SIDES)} are there")
    if number > len(sheet.outline):
        raise ValueError(f"side={number}: the outline has {len(sheet.outline)} sides")
    edges = sheet.border.edges
    corners = zip(sheet.outline, np.roll(sheet.outline, -1, axis=0), strict=True)
    ends = sheet.vertices[edges][:, :, :2]
    points = np.stack([ends[:, 0], ends.mean(axis=1), ends[:, 1]], axis=1)
    away = np.array([_measure_distance(points, a, b) for a, b in corners])
    lengths = np.diff(sheet.vertices[sheet.sides], axis=1)[:, 0]
    near = away[number - 1].max(axis=1) <= ON_SIDE * np.linalg.norm(lengths, axis=1).mean()
    return edges[near & (away[:, :, 1].argmin(axis=0) == number - 1)]


def _measure_distance(points: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the distance (N, k) m of points (N, k, 2) in plan from a side a-b."""
    along = b - a
    share = np.clip((points - a) @ along / (along @ along), 0, 1)
    return np.linalg.norm(points - a - share[..., None] * along, axis=2)


def _edges(sheet: HeldSheet, term: Term) -> np.ndarray:
    pairs = np.sort(np.array(term.numbers, dtype=np.int64), axis=1)
    known = {tuple(side) for side in sheet.sides.tolist()}
    for pair in pairs.tolist():
        if tuple(pair) not in known:
            raise ValueError(f"{pair[0]}-{pair[1]} is no side of a panel")
    return pairs


def _corners(sheet: HeldSheet, _term: Term) -> np.ndarray:
    if sheet.outline is not None:
        return sheet.border.find_corners(sheet.outline)
    return sheet.border.find_plan_corners()


def _vertices(sheet: HeldSheet, term: Term) -> np.ndarray:
    numbers = np.array(term.numbers, dtype=np.int64).ravel()
    wrong = numbers[~np.isin(numbers, sheet.facets)]
    if len(wrong):
        raise ValueError(f"{wrong[0]} is no vertex of a panel")
    return numbers


def _nearest(sheet: HeldSheet, term: Term) -> np.ndarray:
    used = np.unique(sheet.facets)
    found = []
    for point in term.numbers:
        away = sheet.vertices[used, : len(point)] - np.array(point)
        found.append(used[np.linalg.norm(away, axis=1).argmin()])
    return np.array(found)
